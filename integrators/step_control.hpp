// How long the next step is: the elementary controller, and Hairer's guess for the first step. Powers are products of
// repeated square roots, so that step sequences are the same to the bit everywhere.
// Cites: [HairerNorsettWanner1993]
#pragma once

#include "integrators/stepper.hpp"

namespace xpr {

/// x^(-1/p) for p up to 5 as x^(-3/16), above as x^(-1/8): never more than the exact power asks, so that the
/// controller is a little more sluggish than the textbook's for p = 5 and exact for p = 8.
[[nodiscard]] double inverse_root(double x, int p);

/// By what to multiply a step whose error was error_norm tolerances, between 1/5 and 5 (a tenth after a step that gave
/// no number).
[[nodiscard]] double step_factor(double error_norm, int error_power);

/// A first step: the length over which an explicit Euler step and its second-order term stay within a hundredth of
/// the scale. `rate` is flow(y). Infinite where nothing changes.
[[nodiscard]] double initial_step(const Flow& flow, const ErrorScale& scale, const PhaseState<double>& y,
                                  const PhaseState<double>& rate, int error_power);

}  // namespace xpr
