#include "integrators/tao.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace xpr {

TaoStepper::TaoStepper(const MethodCard& card, Flow flow, double omega)
    : FlowStepper(card, std::move(flow)), omega_(omega) {
  if (!(omega > 0.0)) throw std::invalid_argument(fmt::format("tao omega = {}, needs a positive number", omega));
}

StepOutcome TaoStepper::step(const PhaseState<double>& y, double h) {
  begin_step(y, h);
  DoubledState<double> z = copies_.at(y, {y, y});
  if (card().order == 2) {
    tao::step2(counted_flow(), z, omega_, h);
  } else {
    tao::step4(counted_flow(), z, omega_, h);
  }
  StepOutcome out;
  out.y = z.mean();
  copies_.set_end(out.y, z);
  end_step(out.y);
  return out;
}

}  // namespace xpr
