#include "validation/papers/flow_light.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "validation/bundle.hpp"

namespace xpr::papers {

const std::vector<FixedSteps>& flow_routes() {
  static const std::vector<FixedSteps> routes{{"dop853", 400}, {"gl6", 1500}};
  return routes;
}

PhaseState<double> follow(const FixedSteps& how, const Flow& flow, const PhaseState<double>& start, double span) {
  const Walk end = walk(*make_stepper(how.method, flow, {}), start, span, how.steps);
  if (!end.converged) throw std::runtime_error(fmt::format("{}: a step did not converge", how.method));
  return end.y;
}

PhaseState<double> follow_until(const FixedSteps& how, const Flow& flow, const PhaseState<double>& start, double guess,
                                const std::function<double(const PhaseState<double>&)>& g,
                                const std::function<double(const PhaseState<double>&)>& rate) {
  PhaseState<double> y = follow(how, flow, start, guess);
  for (int i = 0; i < 12; ++i) {
    const double step = -g(y) / rate(y);
    y = follow({how.method, std::max<std::int64_t>(8, how.steps / 10)}, flow, y, step);
    if (std::abs(step) < 1e-15 * (1.0 + std::abs(guess))) break;
  }
  return y;
}

Flow medium_flow(std::function<Index(double x, double y)> index) {
  return [index = std::move(index)](const PhaseState<double>& y) {
    const Index n = index(y[1], y[2]);
    PhaseState<double> rate;
    rate[0] = n.squared;
    rate[1] = y[5], rate[2] = y[6], rate[3] = 0.0;
    rate[4] = 0.0, rate[5] = 0.5 * n.along_x, rate[6] = 0.5 * n.along_y, rate[7] = 0.0;
    return rate;
  };
}

std::string route_name(const FixedSteps& how) {
  return fmt::format("{}, {} steps, equations written here", how.method, how.steps);
}

Series path_of(const Flow& flow, const PhaseState<double>& start, double span, int points) {
  Series path{"", Look::line, {start[1]}, {start[2]}};
  PhaseState<double> y = start;
  for (int k = 0; k < points; ++k) {
    y = follow({"dop853", 4}, flow, y, span / points);
    path.x.push_back(y[1]), path.y.push_back(y[2]);
  }
  return path;
}

}  // namespace xpr::papers
