// Quadrature for the papers' integrals: a route of its own beside closed forms and traced rays.
#pragma once

#include <functional>

namespace xpr::papers {

/// An integral, kept in long double for what is subtracted from it; `error` is absolute.
struct Integral {
  long double value = 0.0L;
  double error = 0.0;
};

/// The integral of a smooth f over a finite interval: Gauss-Legendre with 30 points in long double, in twice as many
/// panels until it stands still. `error` is the last change and the rounding. Singular ends are the caller's to
/// transform away.
[[nodiscard]] Integral integral(const std::function<long double(long double)>& f, long double from, long double to);

/// A zero of f between two points where its signs differ, by Alefeld, Potra and Shi's bracketing method to two units
/// of long double. Throws std::domain_error where they do not differ.
[[nodiscard]] long double zero_of(const std::function<long double(long double)>& f, long double from, long double to);

}  // namespace xpr::papers
