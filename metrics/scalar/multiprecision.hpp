// Real50: 50 decimal digits by MPFR, as one more scalar that physics runs over: the truth that double is graded with.
//
// boost::multiprecision brings its own sin, sqrt, atan2, floor, ..., found by argument-dependent look-up; select,
// sincos, square, min, max and value_of are the templates of scalar.hpp. Link xpr_mpfr.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>

#include "metrics/scalar/dual.hpp"

namespace xpr {

/// A 50-digit real number; converts from double exactly and implicitly. Expression templates are off, so that
/// `auto` and template arguments are numbers; its digits lie in the object, not on the heap.
using Real50 =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

template <>
struct Constants<Real50> {
  [[nodiscard]] static Real50 pi() { return boost::math::constants::pi<Real50>(); }
};

/// The double nearest to x, without derivatives.
template <class T>
[[nodiscard]] double to_double(const T& x) {
  return static_cast<double>(value_of(x));
}

}  // namespace xpr
