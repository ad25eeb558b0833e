#include "metrics/fields/profile_table.hpp"

namespace xpr {

namespace {

/// Chebyshev coefficients of f on [from, to], from its values at the zeros of T_n.
template <std::size_t n>
std::array<double, n> coefficients(const std::function<double(double)>& f, double from, double to) {
  // cos(m pi / 2n), m reduced by hand: the cosine of a rounded large angle would be off by the angle's rounding.
  const auto cosine = [](std::size_t m) {
    return xpr::cos(static_cast<double>(m % (4 * n)) * (pi<double>() / static_cast<double>(2 * n)));
  };
  std::array<double, n> values{}, out{};
  for (std::size_t j = 0; j < n; ++j) values[j] = f(0.5 * (from + to) + 0.5 * (to - from) * cosine(2 * j + 1));
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n; ++j) sum += values[j] * cosine(k * (2 * j + 1));
    out[k] = (k == 0 ? 1.0 : 2.0) * sum / static_cast<double>(n);
  }
  return out;
}

}  // namespace

ProfileTable::ProfileTable(const std::function<double(double)>& f, std::span<const double> breaks) {
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    first_.push_back(panels_.size());
    refine(f, breaks[k], breaks[k + 1], 0);
  }
  first_.push_back(panels_.size());
  integrate();
}

void ProfileTable::refine(const std::function<double(double)>& f, double from, double to, int depth) {
  const std::array<double, terms> c = coefficients<terms>(f, from, to);
  // What a series leaves out is about its last term. Curves are of order one, their values good to a few ulps; forty
  // halvings towards a power's end leave nothing of it.
  constexpr double round_off = 1e-15;
  constexpr int deepest = 40;
  const double tail = xpr::max(xpr::abs(c[terms - 1]), xpr::abs(c[terms - 2]));
  if (tail > round_off * xpr::max(1.0, xpr::abs(c[0])) && depth < deepest) {
    const double half = 0.5 * (from + to);
    refine(f, from, half, depth + 1);
    refine(f, half, to, depth + 1);
    return;
  }
  Panel panel{};
  panel[middle] = 0.5 * (from + to);
  panel[inverse_half] = 2.0 / (to - from);
  for (std::size_t k = 0; k < terms; ++k) panel[curve + k] = c[k];
  panels_.push_back(panel);
  edges_.push_back(from);
}

/// F = integral_u^1 f, panel by panel from the right: each series' own integral and the value at its right end.
void ProfileTable::integrate() {
  double beyond = 0.0;
  for (std::size_t p = panels_.size(); p-- > 0;) {
    Panel& panel = panels_[p];
    const double half = 1.0 / panel[inverse_half];
    const auto c = [&](std::size_t k) { return k < terms ? panel[curve + k] : 0.0; };
    // The integral of sum c_k T_k has the coefficients (c_{k-1} - c_{k+1}) / 2k, c_0 counting twice.
    double at_right = 0.0, at_left = 0.0;
    for (std::size_t k = terms; k > 0; --k) {
      const double b = half * ((k == 1 ? 2.0 : 1.0) * c(k - 1) - c(k + 1)) / (2.0 * static_cast<double>(k));
      panel[primitive + k] = -b;
      at_right += b;
      at_left += k % 2 == 0 ? b : -b;
    }
    panel[primitive] = beyond + at_right;
    beyond = beyond + (at_right - at_left);
  }
}

}  // namespace xpr
