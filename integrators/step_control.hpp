// How long the next step is: the elementary controller, and Hairer's guess for the first step. Powers are products of
// repeated square roots, so that step sequences are the same to the bit everywhere.
// Cites: [Gustafsson1994] [HairerNorsettWanner1993]
#pragma once

#include "integrators/stepper.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

/// x^(-1/p) for p up to 5 as x^(-3/16), above as x^(-1/8): never more than the exact power asks, so that the
/// controller is a little more sluggish than the textbook's for p = 5 and exact for p = 8.
template <class T>
[[nodiscard]] constexpr T inverse_root(const T& x, int p) {
  const T eighth = sqrt(sqrt(sqrt(x)));
  return 1.0 / (p > 5 ? eighth : eighth * sqrt(eighth));
}

/// By what to multiply a step whose error was error_norm tolerances, between 1/5 and 5 (a tenth after a step that gave
/// no number).
template <class T>
[[nodiscard]] constexpr T step_factor(const T& error_norm, int error_power) {
  constexpr double safety = 0.9;
  constexpr double least = 0.2;
  constexpr double most = 5.0;
  const T factor = safety * inverse_root(error_norm, error_power);
  const T bounded = select(factor < least, T(least), select(factor > most, T(most), factor));
  // An error this small gives the largest factor under either power: 5 < 0.9 (1e-7)^(-1/8).
  return select(isfinite(error_norm), select(error_norm < 1e-7, T(most), bounded), T(0.1));
}

/// The last good step, from which the next is foreseen: its length and its error in tolerances, at least `least_error`.
template <class T>
struct StepMemory {
  static constexpr double least_error = 1e-3;
  T h = T(0.0);  ///< 0: none yet
  T error = T(least_error);

  /// After a good step.
  [[nodiscard]] static constexpr StepMemory of(const T& h, const T& error_norm) {
    return {h, max(error_norm, T(least_error))};
  }
};

/// By what to multiply a good step. Where errors have grown from step to step, as towards a hole, Gustafsson's
/// predictive controller foresees that they go on to: the next step is no longer than that allows.
template <class T>
[[nodiscard]] constexpr T step_factor_foreseen(const T& h, const T& error_norm, const StepMemory<T>& last,
                                               int error_power) {
  const T plain = step_factor(error_norm, error_power);
  const T trend = step_factor(square(error_norm) / last.error, error_power) * (h / last.h);
  return select(last.h > 0.0, select(trend < plain, max(trend, T(0.2)), plain), plain);
}

/// A first step: the length over which an explicit Euler step and its second-order term stay within a hundredth of
/// the scale. `rate` is flow(y). Infinite where nothing changes.
[[nodiscard]] double initial_step(const Flow& flow, const ErrorScale& scale, const PhaseState<double>& y,
                                  const PhaseState<double>& rate, int error_power);

}  // namespace xpr
