// What a sweep measures: seeded rays of a metric, and where they truly end.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "integrators/tracer.hpp"
#include "metrics/spacetime.hpp"
#include "validation/result.hpp"
#include "validation/sweep.hpp"

namespace xpr {

/// What came of one ray.
struct Measured {
  std::vector<double> error;  ///< signed, one for each component measured; NaN where the ray ended elsewhere
  double truth_error = 0.0;
  RayEnd end = {};
  double seconds = 0.0;  ///< of the tracing alone
};

/// Rays, what is measured on them, and against what.
struct Subject {
  std::string quantity;
  std::string unit = "1";
  TruthRank rank = TruthRank::closed_form;
  std::shared_ptr<const Spacetime> chart = {};
  int rays = 0;
  double length_unit = 1.0;
  double size = 1.0;  ///< of the quantity: its round-off is epsilon times that, a step
  std::function<Measured(std::size_t ray, TraceSettings settings)> measure = {};
};

/// The quantities that are measured in the metric. Throws std::invalid_argument for a metric without rays or truth, and
/// for parameters and charts that it does not have.
[[nodiscard]] std::vector<Subject> sweep_subjects(const SweepRequest& request);

}  // namespace xpr
