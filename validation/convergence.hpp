// Convergence as numbers: norms over a bundle of rays, observed orders, Richardson's estimate and the class of a
// ladder.
//
// A ladder is one method at finer and finer settings (steps, or tolerances). Orders are read from norms over many rays,
// because a single component can cross zero and show any order. The class and the error estimate use no truth: they
// come from the differences of solutions on neighbouring rungs. Cites: [Roache1998]
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace xpr {

/// What was measured at one setting: one number for each ray, or for each ray and component, always in the same order.
struct Rung {
  double setting = 0.0;        ///< step or tolerance
  std::vector<double> values;  ///< same length on every rung
};

/// Root mean square; 0 for no values.
[[nodiscard]] double root_mean_square(std::span<const double> values);

/// Root mean square of a - b.
[[nodiscard]] double distance(std::span<const double> a, std::span<const double> b);

/// The value below which a fraction q of the values lies, by the nearest rank: quantile(v, 0.5) is a median,
/// quantile(v, 1) the largest. NaN for no values.
[[nodiscard]] double quantile(std::vector<double> values, double q);

/// log(e1/e2) / log(h1/h2): the order between two settings. NaN where an error is zero.
[[nodiscard]] double order_between(double setting1, double error1, double setting2, double error2);

/// Slope of log(error) against log(setting) by least squares.
[[nodiscard]] double fitted_slope(std::span<const double> settings, std::span<const double> errors);

/// How the solutions of three neighbouring rungs approach each other.
enum class ConvergenceClass {
  unknown,      ///< fewer than three rungs, or one of them is no number
  monotone,     ///< each change is a fraction of the one before, in its direction
  oscillatory,  ///< a fraction of it, in the other direction
  divergent,    ///< larger than the one before
  round_off,    ///< the last change is round-off: nothing can be said, and nothing more be gained
};
[[nodiscard]] std::string_view to_string(ConvergenceClass kind);  ///< "" for unknown

/// The class of the rung `last` (and its two predecessors), from the norms of the two changes and from their scalar
/// product over all values; a change whose root mean square is below `round_off` is not read.
[[nodiscard]] ConvergenceClass convergence_class(std::span<const Rung> ladder, std::size_t last, double round_off);

/// Grid convergence index of rung `last`: 1.25 times Richardson's estimate |f_last - f_before| / (r^p - 1), with r the
/// ratio of the two settings and p the order expected. NaN at the first rung.
[[nodiscard]] double richardson_error(std::span<const Rung> ladder, std::size_t last, double order);

/// The order where a ladder is clean: between its two finest rungs whose errors both stand clear of round-off.
struct CleanOrder {
  double order;   ///< NaN where fewer than two rungs are clean
  double change;  ///< against the pair of rungs before: how settled it is; NaN where there is none
  double setting1, setting2;
};

/// `floors[i]` is the round-off that may be in errors[i]; a rung is clean where its error is at least 100 times that,
/// so that an order read with a ratio of 2 is disturbed by less than 0.02.
[[nodiscard]] CleanOrder clean_order(std::span<const double> settings, std::span<const double> errors,
                                     std::span<const double> floors);

}  // namespace xpr
