// A curve f(u) on [0, 1] and F(u) = integral_u^1 f where no closed form is at hand: Chebyshev series in panels, to
// round-off. Arithmetic of our own only, so that the table has the same bits everywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// The number that a scalar holds without its derivatives: double or a pack.
template <class T>
using PlainOf = std::remove_cvref_t<decltype(value_of(std::declval<const T&>()))>;

/// A curve and its integral from u to 1.
template <class T>
struct CurveAndIntegral {
  T f;
  T integral;
};

class ProfileTable {
 public:
  ProfileTable() = default;
  /// `breaks` ascend from 0 to 1; between two of them f is smooth, but for a power of the distance at an end.
  ProfileTable(const std::function<double(double)>& f, std::span<const double> breaks);

  /// The series that hold between breaks[piece] and breaks[piece + 1], continued past both.
  template <class T>
  [[nodiscard]] CurveAndIntegral<T> in_piece(const T& u, const PlainOf<T>& piece) const {
    using P = PlainOf<T>;
    std::array<std::size_t, static_cast<std::size_t>(lanes<T>)> panel{};
    const P plain = value_of(u);
    for (int i = 0; i < lanes<T>; ++i) {
      panel[static_cast<std::size_t>(i)] = panel_of(lane(plain, i), lane(piece, i));
    }
    const auto gathered = [&](std::size_t k) {
      P out{};
      for (int i = 0; i < lanes<T>; ++i) set_lane(out, i, panels_[panel[static_cast<std::size_t>(i)]][k]);
      return out;
    };
    const T x = (u - gathered(middle)) * gathered(inverse_half);
    return {series(x, gathered, curve, terms), series(x, gathered, primitive, terms + 1)};
  }

  [[nodiscard]] std::size_t size() const { return panels_.size(); }

 private:
  static constexpr std::size_t terms = 16;
  // A panel: where it is, the series of f, and the series of F.
  static constexpr std::size_t middle = 0, inverse_half = 1, curve = 2, primitive = curve + terms;
  using Panel = std::array<double, primitive + terms + 1>;

  void refine(const std::function<double(double)>& f, double from, double to, int depth);
  void integrate();
  [[nodiscard]] std::size_t panel_of(double u, double piece) const {
    const auto k = static_cast<std::size_t>(std::clamp(piece, 0.0, static_cast<double>(first_.size() - 2)));
    const auto begin = edges_.begin() + static_cast<std::ptrdiff_t>(first_[k]);
    const auto end = edges_.begin() + static_cast<std::ptrdiff_t>(first_[k + 1]);
    const auto above = std::upper_bound(begin, end, u);  // edges_ holds each panel's left end
    return static_cast<std::size_t>((above == begin ? begin : above - 1) - edges_.begin());
  }
  /// Clenshaw's sum of the n coefficients from `from` on.
  template <class T, class Gathered>
  [[nodiscard]] static T series(const T& x, const Gathered& coefficient, std::size_t from, std::size_t n) {
    T last = T(0.0), before = T(0.0);
    for (std::size_t k = n - 1; k > 0; --k) {
      const T next = 2.0 * x * last - before + coefficient(from + k);
      before = last;
      last = next;
    }
    return x * last - before + coefficient(from);
  }

  std::vector<Panel> panels_;
  std::vector<double> edges_;
  std::vector<std::size_t> first_;  ///< panel with which each piece begins, and their number
};

}  // namespace xpr
