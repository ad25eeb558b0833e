#include "validation/papers/quadrature.hpp"

#include <fmt/format.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <stdexcept>

namespace xpr::papers {

Integral integral(const std::function<long double(long double)>& f, long double from, long double to) {
  using Rule = boost::math::quadrature::gauss<long double, 30>;
  constexpr int most_panels = 128;
  long double value = Rule::integrate(f, from, to), change = 0.0L;
  for (int panels = 2; panels <= most_panels; panels *= 2) {
    const long double width = (to - from) / panels;
    long double sum = 0.0L;
    for (int k = 0; k < panels; ++k) sum += Rule::integrate(f, from + k * width, from + (k + 1) * width);
    change = std::abs(sum - value);
    value = sum;
    if (change <= 1e-17L * std::abs(value)) break;
  }
  return {value, static_cast<double>(change + 1e-18L * std::abs(value))};
}

long double zero_of(const std::function<long double(long double)>& f, long double from, long double to) {
  if (from > to) return zero_of(f, to, from);
  const long double at_from = f(from), at_to = f(to);
  if (at_from == 0.0L) return from;
  if (at_to == 0.0L) return to;
  if ((at_from > 0.0L) == (at_to > 0.0L)) {
    throw std::domain_error(
        fmt::format("no change of sign between {} and {}", static_cast<double>(from), static_cast<double>(to)));
  }
  boost::uintmax_t evaluations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      f, from, to, at_from, at_to, boost::math::tools::eps_tolerance<long double>(62), evaluations);
  return 0.5L * (bracket.first + bracket.second);
}

}  // namespace xpr::papers
