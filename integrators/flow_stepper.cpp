#include "integrators/flow_stepper.hpp"

#include "metrics/scalar/elementary.hpp"

namespace xpr {

PhaseState<double> hermite_cubic(const PhaseState<double>& y0, const PhaseState<double>& rate0,
                                 const PhaseState<double>& y1, const PhaseState<double>& rate1, double h,
                                 double theta) {
  // Written around the end that is nearer, so that both ends come out to the bit.
  const double rest = 1.0 - theta;
  PhaseState<double> y;
  for (std::size_t i = 0; i < 8; ++i) {
    const double chord = y1[i] - y0[i];
    const double bend0 = h * rate0[i] - chord;
    const double bend1 = h * rate1[i] - chord;
    const double bend = theta * rest * (rest * bend0 - theta * bend1);
    y[i] = theta < 0.5 ? y0[i] + (theta * chord + bend) : y1[i] - (rest * chord - bend);
  }
  return y;
}

void FlowStepper::begin_step(const PhaseState<double>& y, double h) {
  h_ = h;
  if (stepped_ && y.c == begin_.c) {
    end_rate_known_ = false;
    return;
  }
  begin_rate_known_ = stepped_ && end_rate_known_ && y.c == end_.c;
  if (begin_rate_known_) begin_rate_ = end_rate_;
  begin_ = y;
  end_rate_known_ = false;
  stepped_ = true;
}

const PhaseState<double>& FlowStepper::begin_rate() {
  if (!begin_rate_known_) {
    begin_rate_ = rate(begin_);
    begin_rate_known_ = true;
  }
  return begin_rate_;
}

const PhaseState<double>& FlowStepper::end_rate() {
  if (!end_rate_known_) {
    end_rate_ = rate(end_);
    end_rate_known_ = true;
  }
  return end_rate_;
}

PhaseState<double> FlowStepper::hermite(double theta) {
  return hermite_cubic(begin_, begin_rate(), end_, end_rate(), h_, theta);
}

}  // namespace xpr
