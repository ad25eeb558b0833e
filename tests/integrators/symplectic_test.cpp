// Symplecticity of the step maps, from Jacobians by dual numbers, and what it is good for: no energy drift.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "integrators/dop853.hpp"
#include "integrators/explicit_rk.hpp"
#include "integrators/gauss_legendre.hpp"
#include "integrators/tao.hpp"
#include "integrators/verlet.hpp"
#include "test_flows.hpp"

namespace xpr {
namespace {

using test::Kepler;
using test::NotSeparable;

using Dual8 = Dual<double, 8>;
using State8 = PhaseState<Dual8>;

State8 seeded(const PhaseState<double>& y) {
  State8 out;
  for (std::size_t i = 0; i < 8; ++i) out[i] = variable<8>(y[i], static_cast<int>(i));
  return out;
}

/// J^T Omega J - Omega for a map of n positions followed by n momenta: its largest entry.
template <class State>
double symplectic_defect(const State& image, std::size_t n, const std::vector<std::size_t>& position,
                         const std::vector<std::size_t>& momentum) {
  const auto omega = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < n; ++k) {
      if (a == position[k] && b == momentum[k]) return 1.0;
      if (a == momentum[k] && b == position[k]) return -1.0;
    }
    return 0.0;
  };
  double largest = 0.0;
  for (std::size_t a = 0; a < 2 * n; ++a) {
    for (std::size_t b = 0; b < 2 * n; ++b) {
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        sum += image[position[k]].derivative[a] * image[momentum[k]].derivative[b] -
               image[momentum[k]].derivative[a] * image[position[k]].derivative[b];
      }
      largest = std::max(largest, std::abs(sum - omega(a, b)));
    }
  }
  return largest;
}

double defect(const State8& image) { return symplectic_defect(image, 4, {0, 1, 2, 3}, {4, 5, 6, 7}); }

/// Start with moderate numbers, off every axis.
const PhaseState<double> start{{0.0, 0.7, -0.4, 0.3}, {-1.0, 0.5, 0.6, -0.2}};
constexpr double h = 0.1;

// Each entry of J^T Omega J is a sum of eight products of numbers of size 1: ten roundings or so.
constexpr double round_off = 4e-15;

template <std::size_t S, class FlowT>
double gauss_defect(const GaussCoefficients<S>& method, const FlowT& flow) {
  State8 rest, image;
  const State8 y = seeded(start);
  EXPECT_TRUE(gauss::step(method, flow, y, flow(y), h, 200, rest, image));
  return defect(image);
}

TEST(Symplecticity, holds_for_gauss_legendre_with_any_hamiltonian) {
  EXPECT_LT(gauss_defect(gauss::one_stage, Kepler{}), round_off);
  EXPECT_LT(gauss_defect(gauss::two_stages, Kepler{}), round_off);
  EXPECT_LT(gauss_defect(gauss::three_stages, Kepler{}), round_off);
  EXPECT_LT(gauss_defect(gauss::one_stage, NotSeparable{}), round_off);
  EXPECT_LT(gauss_defect(gauss::two_stages, NotSeparable{}), round_off);
  EXPECT_LT(gauss_defect(gauss::three_stages, NotSeparable{}), round_off);
}

TEST(Symplecticity, is_lost_when_the_iteration_stops_early) {
  State8 rest, image;
  const State8 y = seeded(start);
  EXPECT_FALSE(gauss::step(gauss::two_stages, Kepler{}, y, Kepler{}(y), h, 3, rest, image));
  EXPECT_GT(defect(image), 1e-9);
}

TEST(Symplecticity, holds_for_verlet_where_the_hamiltonian_separates_and_only_there) {
  const auto verlet_defect = [](const auto& flow) {
    State8 rest;
    const State8 y = seeded(start);
    return defect(verlet::step(flow, y, flow(y), h, rest));
  };
  EXPECT_LT(verlet_defect(Kepler{}), round_off);
  EXPECT_GT(verlet_defect(NotSeparable{}), 1e-3);
}

TEST(Symplecticity, holds_for_tao_in_the_doubled_space_and_not_for_its_mean) {
  using Dual16 = Dual<double, 16>;
  for (const bool fourth : {false, true}) {
    DoubledState<Dual16> z;
    for (std::size_t i = 0; i < 8; ++i) {
      z.first[i] = variable<16>(start[i], static_cast<int>(i));
      z.second[i] = variable<16>(start[i] + 0.01, static_cast<int>(8 + i));
    }
    if (fourth) {
      tao::step4(NotSeparable{}, z, 3.0, h);
    } else {
      tao::step2(NotSeparable{}, z, 3.0, h);
    }
    std::array<Dual16, 16> image;
    for (std::size_t i = 0; i < 8; ++i) {
      image[i] = z.first[i];
      image[8 + i] = z.second[i];
    }
    EXPECT_LT(symplectic_defect(image, 8, {0, 1, 2, 3, 8, 9, 10, 11}, {4, 5, 6, 7, 12, 13, 14, 15}), 2 * round_off);

    DoubledState<Dual8> equal{seeded(start), seeded(start)};
    tao::step2(NotSeparable{}, equal, 3.0, h);
    EXPECT_GT(defect(equal.mean()), 1e-9);
  }
}

TEST(Symplecticity, fails_for_explicit_runge_kutta) {
  const auto rk_defect = [](const ButcherTableau& tableau) {
    RkStages<Dual8> k;
    const State8 y = seeded(start);
    k[0] = Kepler{}(y);
    return defect(explicit_rk_step(RkCoefficients(tableau), Kepler{}, y, 2 * h, k));
  };
  EXPECT_GT(rk_defect(tableaux::rk4), 1e-6);
  EXPECT_GT(rk_defect(tableaux::dopri54), 1e-8);
  dop853::Stages<Dual8> k;
  const State8 y = seeded(start);
  k[0] = Kepler{}(y);
  EXPECT_GT(defect(dop853::step(Kepler{}, y, 3 * h, k)), 1e-12);
}

TEST(StepMaps, have_the_same_value_on_duals_as_on_doubles) {
  const auto expect_same = [](const State8& dual, const PhaseState<double>& plain) {
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(dual[i].value, plain[i]) << i;
  };
  StepperSettings settings = test::settings_with_tolerance(1e-8);
  const State8 y = seeded(start);
  State8 rest;
  expect_same(verlet::step(Kepler{}, y, Kepler{}(y), h, rest),
              make_stepper("verlet", Kepler{}, settings)->step(start, h).y);
  RkStages<Dual8> k;
  k[0] = Kepler{}(y);
  expect_same(explicit_rk_step(RkCoefficients(tableaux::dopri54), Kepler{}, y, h, k),
              make_stepper("dopri54", Kepler{}, settings)->step(start, h).y);
}

struct EnergyHistory {
  double early = 0.0;  ///< largest |E - E_0| over the first tenth
  double late = 0.0;   ///< over the last tenth
  double trend = 0.0;  ///< mean of E over the last tenth less that over the first
};

template <class FlowT>
EnergyHistory energy_history(std::string_view id, const FlowT& flow, const PhaseState<double>& y0, double step,
                             int steps) {
  const auto stepper = make_stepper(id, flow, test::settings_with_tolerance(1e-8));
  const double energy = FlowT::energy(y0);
  PhaseState<double> y = y0;
  EnergyHistory out;
  for (int i = 0; i < steps; ++i) {
    y = stepper->step(y, step).y;
    const double error = std::abs(FlowT::energy(y) - energy);
    if (i < steps / 10) {
      out.early = std::max(out.early, error);
      out.trend -= (FlowT::energy(y) - energy) / (steps / 10);
    }
    if (i >= steps - steps / 10) {
      out.late = std::max(out.late, error);
      out.trend += (FlowT::energy(y) - energy) / (steps / 10);
    }
  }
  return out;
}

// 1000 orbits of 60 steps: truncation is far above round-off here, so bounded means the same at both ends.
constexpr int steps_per_orbit = 60;
constexpr int orbit_count = 1000;
const double orbit_step = 2.0 * std::numbers::pi / steps_per_orbit;

TEST(EnergyOverAThousandOrbits, stays_bounded_for_symplectic_methods) {
  for (const char* id : {"verlet", "implicit-midpoint", "gl4", "tao2", "tao4"}) {
    const EnergyHistory e =
        energy_history(id, Kepler{}, test::orbits[1].at(0.0), orbit_step, steps_per_orbit * orbit_count);
    EXPECT_GT(e.early, 1e-12) << id << ": the test must see truncation, not round-off";
    EXPECT_LT(e.late, 1.2 * e.early) << id;
  }
}

TEST(EnergyOverAThousandOrbits, drifts_linearly_for_others) {
  for (const char* id : {"rk4", "dopri54"}) {
    const EnergyHistory e =
        energy_history(id, Kepler{}, test::orbits[1].at(0.0), orbit_step, steps_per_orbit * orbit_count);
    EXPECT_GT(e.late, 5.0 * e.early) << id;
  }
}

TEST(EnergyOverAThousandOrbits, walks_as_round_off_does_where_truncation_is_below_it) {
  const int steps = steps_per_orbit * orbit_count;
  const EnergyHistory e = energy_history("gl6", Kepler{}, test::orbits[0].at(0.0), 0.3 * orbit_step, steps);
  // Truncation at this step is bounded by 5e-14. What grows is a random walk of roundings of E = 1/2: sqrt(N) of them.
  EXPECT_LT(e.early, 5e-14);
  EXPECT_LT(std::abs(e.trend), 0.55e-16 * std::sqrt(steps));
}

}  // namespace
}  // namespace xpr
