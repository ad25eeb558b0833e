// Light whose equations a paper writes down itself, stepped by our integrators: for media and metrics that need no
// module, and as a route beside those that have one.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "integrators/stepper.hpp"
#include "validation/paper.hpp"

namespace xpr::papers {

/// A method with a fixed number of steps: what is stepped here is smooth, and needs no control.
struct FixedSteps {
  std::string_view method;
  std::int64_t steps;
};

/// Two methods that share nothing: Dormand and Prince's eighth order, and Gauss's collocation of sixth order.
[[nodiscard]] const std::vector<FixedSteps>& flow_routes();

/// y after a span of the flow's parameter. Throws std::runtime_error where an implicit step does not converge.
[[nodiscard]] PhaseState<double> follow(const FixedSteps& how, const Flow& flow, const PhaseState<double>& start,
                                        double span);

/// y where g(y) = 0, near a guess of the parameter; `rate` is dg/d(parameter) along the flow. Newton's steps.
[[nodiscard]] PhaseState<double> follow_until(const FixedSteps& how, const Flow& flow, const PhaseState<double>& start,
                                              double guess, const std::function<double(const PhaseState<double>&)>& g,
                                              const std::function<double(const PhaseState<double>&)>& rate);

/// n^2 of a static medium and its gradient over x and y.
struct Index {
  double squared, along_x, along_y;
};
/// H = (p^2 - n^2)/2 in the plane: dx = p, dp = grad(n^2)/2, dt = n^2 per unit of the parameter.
[[nodiscard]] Flow medium_flow(std::function<Index(double x, double y)> index);

/// "dop853, 400 steps, equations written here".
[[nodiscard]] std::string route_name(const FixedSteps& how);

/// x and y of a path of the flow, for figures.
[[nodiscard]] Series path_of(const Flow& flow, const PhaseState<double>& start, double span, int points);

}  // namespace xpr::papers
