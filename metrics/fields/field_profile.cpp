#include "metrics/fields/field_profile.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace xpr {

namespace {

[[noreturn]] void refuse(const FieldSource& source, const std::string& what) {
  throw std::invalid_argument(fmt::format("field '{}': {}", source.name, what));
}

void require_finite(const FieldSource& source, std::string_view what, double value) {
  if (!xpr::isfinite(value)) refuse(source, fmt::format("{} = {}, needs a finite number", what, value));
}

void check_curve(const FieldSource& source) {
  for (const auto& [what, value] :
       {std::pair<std::string_view, double>{"a", source.a}, {"b", source.b}, {"c", source.c}}) {
    require_finite(source, what, value);
  }
  switch (source.curve) {
    case FieldCurve::power:
      if (!(source.a > -1.0)) {
        refuse(source, fmt::format("power a = {}, needs a > -1: the index has no bound at the edge", source.a));
      }
      return;
    case FieldCurve::exponential:
      if (!(source.a >= 0.0)) refuse(source, fmt::format("decay a = {}, needs a >= 0", source.a));
      return;
    case FieldCurve::gaussian:
      if (!(source.a > 0.0)) refuse(source, fmt::format("width a = {}, needs a > 0", source.a));
      return;
    case FieldCurve::custom: {
      const std::size_t n = source.table.size();
      if (n < 2 || n > 256) {
        refuse(source, fmt::format("its custom curve has a table of {} values, needs 2 to 256", n));
      }
      for (std::size_t k = 0; k < n; ++k) {
        if (!(source.table[k] >= 0.0 && source.table[k] <= 1.0)) {
          refuse(source, fmt::format("table[{}] = {}, needs a value in [0, 1]", k, source.table[k]));
        }
      }
      return;
    }
    default:
      return;
  }
}

void check(const FieldSource& source, double bending) {
  if (!(source.r_inner >= 0.0 && source.r_inner < source.r_outer && xpr::isfinite(source.r_outer))) {
    refuse(source,
           fmt::format("r_inner = {}, r_outer = {}, needs 0 <= r_inner < r_outer", source.r_inner, source.r_outer));
  }
  if (!(source.edge_softness >= 0.0 && source.edge_softness <= 1.0)) {
    refuse(source, fmt::format("edge_softness = {}, needs a value in [0, 1]", source.edge_softness));
  }
  require_finite(source, "amplitude with its gains", bending);
  check_curve(source);
}

double clamped(double f) { return f < 0.0 ? 0.0 : f > 1.0 ? 1.0 : f; }

/// From 0 at t = 0 to 1 at t = 1, and 0 and 1 beyond.
double smoothstep(double t) {
  const double inside = clamped(t);
  return inside * inside * (3.0 - 2.0 * inside);
}

/// Below this softness there is no ramp.
constexpr double no_softness = 1e-6;
/// Decays below this are tabulated: (exp(-a u) - exp(-a)) / a cancels.
constexpr double slow_decay = 0.25;

}  // namespace

FieldProfile::FieldProfile(const FieldSource& source, double bending)
    : curve_(source.curve),
      a_(source.a),
      b_(source.b),
      c_(source.c),
      values_(source.table),
      softness_(source.edge_softness),
      r_inner_(source.r_inner),
      r_outer_(source.r_outer),
      inverse_span_(1.0 / (source.r_outer - source.r_inner)),
      bending_(bending),
      scale_(bending * (source.r_outer - source.r_inner)),
      has_core_(source.r_inner > 0.0) {
  check(source, bending);
  const std::vector<double> kinks = breaks();
  tabulated_ = curve_ == FieldCurve::gaussian || curve_ == FieldCurve::custom || softness_ > no_softness ||
               kinks.size() > 2 || (curve_ == FieldCurve::exponential && a_ < slow_decay);
  constexpr double largest_whole = 16.0;
  if (curve_ == FieldCurve::power && a_ >= 0.0 && a_ <= largest_whole && xpr::rint(a_) == a_) {
    whole_power_ = static_cast<int>(a_);
  }
  if (tabulated_) table_ = ProfileTable([this](double u) { return curve(u); }, kinks);
  f_at_edge_ = curve(1.0);
  const CurveAndIntegral<double> centre = curve_at(0.0, 0.0);
  f_at_core_ = centre.f;
  integral_at_core_ = centre.integral;
  if (has_core_) seams_.push_back(r_inner_);
  for (std::size_t k = 1; k + 1 < kinks.size(); ++k) seams_.push_back(r_inner_ + kinks[k] / inverse_span_);
  seams_.push_back(r_outer_);
}

double FieldProfile::bare_curve(double u) const {
  const double w = 1.0 - u;
  switch (curve_) {
    case FieldCurve::linear:
      return w;
    case FieldCurve::power:
      return a_ == 0.0 ? 1.0 : w > 0.0 ? xpr::pow(w, a_) : 0.0;
    case FieldCurve::polynomial:
      return clamped(a_ + u * (b_ + u * c_));
    case FieldCurve::exponential:
      return xpr::exp(-a_ * u);
    case FieldCurve::gaussian:
      return xpr::exp(-square(u / a_));
    case FieldCurve::custom: {
      const double place = u * static_cast<double>(values_.size() - 1);
      const double below = xpr::min(xpr::floor(place), static_cast<double>(values_.size() - 2));
      const auto k = static_cast<std::size_t>(below);
      return values_[k] + (place - below) * (values_[k + 1] - values_[k]);
    }
  }
  return 0.0;
}

double FieldProfile::curve(double u) const {
  u = clamped(u);
  const double f = bare_curve(u);
  if (softness_ <= no_softness) return f;
  return f * smoothstep(u / softness_) * smoothstep((1.0 - u) / softness_);  // 1 - s(1 - t) = s(t)
}

/// Where f or a derivative of it jumps, with both ends: the edges of ramps, a table's entries, and where a polynomial
/// runs into its bounds.
std::vector<double> FieldProfile::breaks() const {
  std::vector<double> at{0.0, 1.0};
  const auto add = [&](double u) {
    if (u > 0.0 && u < 1.0) at.push_back(u);
  };
  if (softness_ > no_softness) {
    add(softness_);
    add(1.0 - softness_);
  }
  if (curve_ == FieldCurve::custom) {
    const auto n = static_cast<double>(values_.size() - 1);
    for (std::size_t k = 1; k + 1 < values_.size(); ++k) add(static_cast<double>(k) / n);
  }
  if (curve_ == FieldCurve::polynomial) {
    for (const double bound : {0.0, 1.0}) {
      // c u^2 + b u + (a - bound) = 0, both roots without cancellation
      const double constant = a_ - bound;
      const double discriminant = b_ * b_ - 4.0 * c_ * constant;
      if (!(discriminant > 0.0)) continue;  // a double root touches and does not cross
      const double q = -0.5 * (b_ + xpr::copysign(xpr::sqrt(discriminant), b_));
      if (q != 0.0) add(constant / q);
      if (c_ != 0.0) add(q / c_);
    }
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

double FieldProfile::most(double low, double high) const {
  low = clamped(low);
  high = clamped(high);
  double largest = xpr::max(bare_curve(low), bare_curve(high));  // of monotone curves; a ramp only lowers them
  if (curve_ == FieldCurve::power && a_ < 0.0) {
    largest = high < 1.0 ? bare_curve(high) : unbounded_curve;
  } else if (curve_ == FieldCurve::polynomial && c_ != 0.0) {
    const double top = -0.5 * b_ / c_;
    if (top > low && top < high) largest = xpr::max(largest, bare_curve(top));
  } else if (curve_ == FieldCurve::custom) {
    const auto n = static_cast<double>(values_.size() - 1);
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const double u = static_cast<double>(k) / n;
      if (u >= low && u <= high) largest = xpr::max(largest, values_[k]);
    }
  }
  return largest;
}

}  // namespace xpr
