// Observed orders: halving the step must divide the error by 2^p, p being the order on the method's card.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "validation/bundle.hpp"
#include "validation/convergence.hpp"
#include "validation/families/numerical.hpp"
#include "validation/kit.hpp"

namespace xpr::numerical {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Where a method's ladder begins: the number of steps over the ray.
struct Ladder {
  std::string_view method;
  std::int64_t first;
  int rungs;
};

struct LadderResult {
  std::vector<Rung> rungs;
  std::vector<double> settings, errors, floors;
  std::int64_t evaluations = 0;
  int formal = 0;
  bool converged = true;
};

/// Walks every ray at first, 2 first, 4 first, ... steps.
LadderResult climb(const Lab& lab, const Bundle& bundle, const Ladder& ladder) {
  LadderResult out;
  const std::vector<double> truth = spatial_components(bundle.ends);
  const double size = root_mean_square(truth);
  std::int64_t steps = ladder.first;
  for (int k = 0; k < ladder.rungs; ++k, steps *= 2) {
    std::vector<PhaseState<double>> ends;
    for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
      const std::unique_ptr<Stepper> stepper = lab.stepper(ladder.method, bundle.flow(), {});
      const Walk walked = walk(*stepper, bundle.starts[i], bundle.spans[i], steps);
      ends.push_back(walked.y);
      out.converged = out.converged && walked.converged;
      out.evaluations += stepper->evaluations();
      out.formal = stepper->card().order;
    }
    out.rungs.push_back({1.0 / static_cast<double>(steps), spatial_components(ends)});
    out.settings.push_back(out.rungs.back().setting);
    out.errors.push_back(distance(out.rungs.back().values, truth));
    // Each step rounds once; the roundings add up like a random walk.
    out.floors.push_back(bundle.truth_error + epsilon * size * std::sqrt(static_cast<double>(steps)));
  }
  return out;
}

Tolerance order_tolerance(int formal) {
  if (formal <= 4) {
    return {0.05,
            "low orders have room for steps so short that the next term of the error series is below 3.5 % "
            "(2^0.05 = 1.035), with errors still 100 times above round-off"};
  }
  if (formal < 8) {
    return {0.1,
            "to 0.1 where the regime is clean: errors 100 times above round-off, the next term of their series "
            "below 7 % (2^0.1 = 1.07)"};
  }
  return {0.25,
          "order 8 falls into round-off within two halvings: the next term of its error series still makes up to "
          "19 % (2^0.25 = 1.19)"};
}

Row order_row(const Lab& lab, const Bundle& bundle, const Ladder& ladder) {
  const LadderResult result = climb(lab, bundle, ladder);
  const CleanOrder clean = clean_order(result.settings, result.errors, result.floors);
  Row row = make_row(fmt::format("observed order of {}", ladder.method), *bundle.chart,
                     {std::string(ladder.method), clean.setting2, Projection::none},
                     {{"rays", static_cast<double>(bundle.starts.size()), "1"}});
  row.evaluations = result.evaluations;
  const std::size_t last = result.rungs.size() - 1;
  row.note = fmt::format("errors {:.2e} to {:.2e}; order changed by {:.3f} on the last halving; {}",
                         result.errors.front(), result.errors.back(), clean.change,
                         to_string(convergence_class(result.rungs, last, result.floors[last])));
  grade(row, clean.order, {static_cast<double>(result.formal), 0.0}, order_tolerance(result.formal));
  return row;
}

// Begun where the error stands near 1e-6 or the series of error terms has settled, whichever is finer.
constexpr Ladder fisheye_ladders[] = {
    {"euler", 16384, 3}, {"midpoint", 2048, 3},     {"heun2", 2048, 3},
    {"rk4", 1024, 3},    {"rkf45", 1024, 3},        {"dopri54", 512, 4},
    {"dop853", 96, 4},   {"verlet", 2048, 3},       {"implicit-midpoint", 1024, 3},
    {"gl4", 256, 3},     {"gl6", 128, 3},           {"tao2", 2048, 3},
    {"tao4", 1024, 3},   {"odeint:dopri5", 512, 4},
};
// Without Dormand and Prince's methods: their leading error terms are so small here that the next ones show until
// round-off takes over.
constexpr Ladder kerr_ladders[] = {
    {"euler", 8192, 3}, {"midpoint", 512, 3}, {"heun2", 512, 3},
    {"rk4", 128, 4},    {"rkf45", 64, 4},     {"implicit-midpoint", 512, 3},
    {"gl4", 64, 4},     {"gl6", 32, 4},       {"tao2", 512, 3},
    {"tao4", 256, 3},
};

std::vector<Row> order_rows(const Lab& lab, const Bundle& bundle, std::span<const Ladder> ladders) {
  std::vector<Row> rows;
  for (const Ladder& ladder : ladders) rows.push_back(order_row(lab, bundle, ladder));
  return rows;
}

}  // namespace

std::vector<Case> order_cases() {
  const auto fisheye = [](const Lab& lab) {
    return order_rows(lab, fisheye_orbits(lab, lab.full() ? 32 : 16, FisheyePath::arc), fisheye_ladders);
  };
  const auto kerr = [](const Lab& lab) {
    return order_rows(lab, kerr_scattering(lab, lab.full() ? 32 : 16), kerr_ladders);
  };
  return {
      {.info = info(
           "order-fisheye", "the error of every method falls as the step to the power of its formal order",
           "Light in Maxwell's fish-eye follows its circle over 0.45 turns (in lambda) in N equal steps; the error is "
           "the root mean square distance in (x, p) over all rays; the order is that between the two finest "
           "step numbers that are clear of round-off.",
           "great circles in stereographic projection with their affine length: closed form", TruthRank::closed_form,
           "Maxwell1854 HairerNorsettWanner1993 Roache1998", "numerical_order.cpp"),
       .run = fisheye},
      {.info = info("order-kerr-scattering",
                    "the same orders hold for light that passes a Kerr hole off the equator, where H does not separate",
                    "The same measurement over rays in the Kerr-Schild chart from 15 M past the hole.",
                    "the same flow integrated by DOP853 with far finer steps", TruthRank::self_convergence,
                    "HairerNorsettWanner1993 Roache1998", "numerical_order.cpp"),
       .run = kerr},
  };
}

}  // namespace xpr::numerical
