// Every elementary function over every scalar of the transport path, for check_no_libm.py to look for calls into libm.
#include "metrics/scalar/dual.hpp"

namespace xpr {

template <class T>
T probe(const T& x, const T& y) {
  const auto both = sincos(x);
  const T angles = sin(x) + cos(y) + tan(x) + atan(x) + atan2(y, x) + asin(x) + acos(x);
  const T growth = exp(x) + log(x) + pow(x, y) + pow(x, 2.5) + pow(x, 3) + sinh(x) + cosh(x) + tanh(x);
  const T pieces = abs(x) + floor(x) + rint(x) + copysign(x, y) + min(x, y) + max(x, y) + select(x < y, x, y);
  return both.sin * both.cos + sqrt(x) + angles + growth + pieces + pi<T>();
}

template double probe(const double&, const double&);
template Pack<1> probe(const Pack<1>&, const Pack<1>&);
template Pack<2> probe(const Pack<2>&, const Pack<2>&);
template Pack<4> probe(const Pack<4>&, const Pack<4>&);
template Pack<8> probe(const Pack<8>&, const Pack<8>&);
template Dual<double, 4> probe(const Dual<double, 4>&, const Dual<double, 4>&);
template Dual<Pack<4>, 4> probe(const Dual<Pack<4>, 4>&, const Dual<Pack<4>, 4>&);

}  // namespace xpr
