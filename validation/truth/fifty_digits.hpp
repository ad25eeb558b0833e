// The same metric sources at 50 digits: the truth of steppers, rank `same source`.
//
// Gragg's midpoint rule, whose error has only even powers of the step, extrapolated to order 2 k [Gragg1965]
// [BulirschStoer1966] [HairerNorsettWanner1993]: Taylor's series would need each metric's recurrences, this needs rates
// alone. The flow is the one that follows from inverse_metric, never a hand-written one; and as it comes from the same
// source as the doubles that are graded, it says nothing about whether that source is right.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "metrics/scalar/multiprecision.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// dy/dlambda of an autonomous system; `rate` has the size of `y`.
using Rates50 = std::function<void(const std::vector<Real50>& y, std::vector<Real50>& rate)>;

struct ExtrapolationSettings {
  int columns = 16;    ///< k: the rule with 2, 4, ..., 2 k steps, order 2 k
  double tol = 1e-42;  ///< of a step's change between the last two columns, relative to 1 + |y|
};

/// Where an integration ends.
struct Path50 {
  std::vector<Real50> y;
  Real50 at;  ///< the independent variable
  int steps = 0;
  std::int64_t evaluations = 0;
};

/// Integrates from 0 to `until` (either sign). Throws std::runtime_error where the step falls below 1e-12 of `until` or
/// numbers cease to be finite.
[[nodiscard]] Path50 integrate50(const Rates50& rates, std::vector<Real50> start, const Real50& until,
                                 const ExtrapolationSettings& settings = {});

/// Integrates until surface(y) passes through zero with the sign of `direction` (+1 rising), and puts the end there by
/// secants on the last step, to `settings.tol`. Throws std::runtime_error where it does not within `most`.
[[nodiscard]] Path50 integrate50_to(const Rates50& rates, std::vector<Real50> start,
                                    const std::function<Real50(const std::vector<Real50>& y)>& surface, int direction,
                                    const Real50& first_step, const Real50& most,
                                    const ExtrapolationSettings& settings = {});

/// An end by two integrations: at the default settings, and at order 28 with a tolerance a tenth as large, so that
/// steps and truncation differ. What they differ by is the error.
struct Twice50 {
  std::vector<Real50> y, again;
};
[[nodiscard]] Twice50 integrate50_twice(const Rates50& rates, const std::vector<Real50>& start, const Real50& until);

/// The derived flow of a chart of the catalogue with these parameters, over (x^mu, p_mu). Throws std::invalid_argument
/// for a chart that is not in this build's list of modules.
[[nodiscard]] Rates50 flow50(std::string_view metric, std::string_view chart, std::span<const NamedValue> values = {});

}  // namespace xpr
