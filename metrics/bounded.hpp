// The numbers inside the closed forms: 113 bits wide, because doubles lose digits near a photon orbit, and rounded once
// at the end. Included by the closed forms' sources only.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "metrics/exact_value.hpp"

namespace xpr {

using Quad = boost::multiprecision::cpp_bin_float_quad;

/// Boost's logarithm asks for the limits of Quad's variant with expression templates, whose epsilon is made on first
/// use without a lock, and not at start as that of Quad itself is (Boost 1.74): two threads at once could meet it half
/// made. It is made here before there are threads.
inline const bool quad_limits_are_made = [] {
  using Variant = boost::multiprecision::number<Quad::backend_type, boost::multiprecision::et_on>;
  return std::numeric_limits<Variant>::epsilon() > 0;
}();

/// A value with an absolute error bound, before the last rounding.
struct Bounded {
  Quad value = 0;
  Quad error = 0;
};

/// The value as a double. 2^-53 of it for the rounding; 2^-52 also covers that the bound itself is rounded.
[[nodiscard]] inline ExactValue rounded(const Bounded& x) {
  const auto value = static_cast<double>(x.value);
  return {value, static_cast<double>(x.error) + std::abs(value) * std::numeric_limits<double>::epsilon()};
}

/// A value whose 113-bit evaluation loses less than eleven bits: below any double's rounding.
[[nodiscard]] inline ExactValue rounded(const Quad& x) {
  return rounded(Bounded{x, 1024 * std::numeric_limits<Quad>::epsilon() * abs(x)});
}

}  // namespace xpr
