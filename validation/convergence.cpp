#include "validation/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "metrics/scalar/elementary.hpp"

namespace xpr {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double root_mean_square(std::span<const double> values) {
  if (values.empty()) return 0.0;
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double distance(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) throw std::invalid_argument("distance of solutions of different length");
  if (a.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return nan;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(q * static_cast<double>(values.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  return values[std::min(index, values.size() - 1)];
}

double order_between(double setting1, double error1, double setting2, double error2) {
  if (!(error1 > 0.0 && error2 > 0.0)) return nan;
  return log(error1 / error2) / log(setting1 / setting2);
}

double fitted_slope(std::span<const double> settings, std::span<const double> errors) {
  const auto n = static_cast<double>(settings.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const double x = log(settings[i]);
    const double y = log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

std::string_view to_string(ConvergenceClass kind) {
  switch (kind) {
    case ConvergenceClass::unknown:
      return "";
    case ConvergenceClass::monotone:
      return "monotone";
    case ConvergenceClass::oscillatory:
      return "oscillatory";
    case ConvergenceClass::divergent:
      return "divergent";
    case ConvergenceClass::round_off:
      return "round-off";
  }
  return "";
}

ConvergenceClass convergence_class(std::span<const Rung> ladder, std::size_t last, double round_off) {
  if (last < 2) return ConvergenceClass::unknown;
  const std::vector<double>& f0 = ladder[last - 2].values;
  const std::vector<double>& f1 = ladder[last - 1].values;
  const std::vector<double>& f2 = ladder[last].values;
  if (distance(f1, f2) <= round_off) return ConvergenceClass::round_off;
  double along = 0.0;
  for (std::size_t i = 0; i < f0.size(); ++i) along += (f2[i] - f1[i]) * (f1[i] - f0[i]);
  if (!std::isfinite(along)) return ConvergenceClass::unknown;  // a rung lost rays
  if (distance(f1, f2) >= distance(f0, f1)) return ConvergenceClass::divergent;
  return along >= 0.0 ? ConvergenceClass::monotone : ConvergenceClass::oscillatory;
}

double richardson_error(std::span<const Rung> ladder, std::size_t last, double order) {
  if (last < 1) return nan;
  constexpr double safety = 1.25;  // Roache's factor for an order that was observed
  const double ratio = ladder[last - 1].setting / ladder[last].setting;
  return safety * distance(ladder[last - 1].values, ladder[last].values) / (pow(ratio, order) - 1.0);
}

CleanOrder clean_order(std::span<const double> settings, std::span<const double> errors,
                       std::span<const double> floors) {
  std::size_t clean = 0;
  while (clean < errors.size() && errors[clean] >= 100.0 * floors[clean]) ++clean;
  if (clean < 2) return {nan, nan, nan, nan};
  const std::size_t i = clean - 1;
  const double order = order_between(settings[i - 1], errors[i - 1], settings[i], errors[i]);
  const double before = clean < 3 ? nan : order_between(settings[i - 2], errors[i - 2], settings[i - 1], errors[i - 1]);
  return {order, order - before, settings[i - 1], settings[i]};
}

}  // namespace xpr
