#include "validation/papers/quadrature.hpp"

#include <fmt/format.h>

#include <boost/math/quadrature/gauss.hpp>
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
  long double low = from, high = to;
  const bool rises = f(high) > 0.0L;
  if ((f(low) > 0.0L) == rises) {
    throw std::domain_error(
        fmt::format("no change of sign between {} and {}", static_cast<double>(from), static_cast<double>(to)));
  }
  for (int i = 0; i < 200; ++i) {
    const long double middle = 0.5L * (low + high);
    if (middle == low || middle == high) break;
    ((f(middle) > 0.0L) == rises ? high : low) = middle;
  }
  return 0.5L * (low + high);
}

}  // namespace xpr::papers
