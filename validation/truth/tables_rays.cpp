// Tables of whole rays at 50 digits: Kerr by two formulations that agree, and every chart from its own source.
#include <fmt/format.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "core/io/csv.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/null_cone.hpp"
#include "validation/truth/fifty_digits.hpp"
#include "validation/truth/kerr_first_integrals.hpp"
#include "validation/truth/tables.hpp"

namespace xpr {

namespace {

/// x to so many significant digits.
std::string digits_of(const Real50& x, int digits) {
  std::array<char, 128> text{};
  mpfr_snprintf(text.data(), text.size(), "%.*Re", digits - 1, x.backend().data());
  return text.data();
}

/// The digits in which two computations agree; throws std::runtime_error where they are fewer than `digits`, the last
/// one rounded either way.
std::string agreed(const Real50& x, const Real50& other, int digits, std::string_view what) {
  const Real50 allowed = abs(x) * pow(Real50(10), -digits - 2);
  if (!(abs(x - other) <= allowed)) {
    throw std::runtime_error(fmt::format("{}: two computations give {} and {}", what, digits_of(x, digits + 5),
                                         digits_of(other, digits + 5)));
  }
  return digits_of(x, digits);
}

/// Where a ray of the table starts in a chart, and how far it goes.
struct Start {
  PhaseState<double> y;
  double lambda;
};

/// Light that passes what there is to pass, off every plane of symmetry: around 8 length units out, well inside a
/// lens, on the surface of an ellipsoid. Nothing where the chart has no such point.
std::optional<Start> start_in(const Spacetime& spacetime) {
  const auto& coordinates = spacetime.card().coordinates;
  Start start;
  Vec4<double> x, p;
  if (coordinates[1].kind == CoordinateKind::latitude) {
    x = {0.0, 0.3, 0.2, 0.0}, p = {-1.0, 0.6, 0.5, 0.0};
    start.lambda = 2.0;
  } else if (coordinates[2].kind == CoordinateKind::polar_angle) {
    x = {0.0, 8.0, 1.1, 0.4}, p = {-1.0, -0.7, 3.0, 5.0};
    start.lambda = 12.0;
  } else {
    const std::optional<double> rim = spacetime.interface_radius();
    const double scale = rim ? 0.06 * *rim : 1.0;
    x = {0.0, 7.0 * scale, 2.5 * scale, 1.5 * scale}, p = {-1.0, -0.6, 0.5, 0.5};
    start.lambda = rim ? 0.5 * *rim : 12.0;
  }
  if (!spacetime.inside_domain(x)) return std::nullopt;
  const std::optional<Vec4<double>> light = null_momentum(spacetime, x, p, 1.0);
  if (!light) return std::nullopt;
  start.y = PhaseState<double>(x, *light);
  return start;
}

std::string parameters_text(const std::vector<NamedValue>& parameters) {
  std::string text;
  for (const NamedValue& p : parameters) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", p.name, number_text(p.value));
  }
  return text.empty() ? "none" : text;
}

}  // namespace

ReferenceTable make_fifty_digit_rays() {
  constexpr int digits = 35;
  ReferenceTable table{
      .name = "fifty_digit_rays",
      .quantity = "light through every chart of the catalogue: where a ray is after a given affine parameter",
      .units = "as the chart's; lambda for the p given",
      .origin = "computed",
      .method =
          "Gragg's midpoint rule extrapolated to order 32 at 50 digits over the flow derived from inverse_metric; "
          "a second integration at order 28 with other steps agrees in two digits more than are printed",
      .digits = digits,
      .rank = std::string(to_string(TruthRank::same_source)),
      .cites = "Gragg1965 BulirschStoer1966 HairerNorsettWanner1993",
      .maker = "xprimeray reference --regenerate fifty_digit_rays",
      .columns = {"metric", "chart",  "parameters", "x0",     "x1",     "x2",     "x3",
                  "p0",     "p1",     "p2",         "p3",     "lambda", "end_x0", "end_x1",
                  "end_x2", "end_x3", "end_p0",     "end_p1", "end_p2", "end_p3"},
      .rows = {}};
  for (const CatalogueEntry& entry : catalogue()) {
    const std::unique_ptr<Spacetime> spacetime = entry.make({});
    const std::optional<Start> start = start_in(*spacetime);
    if (!start) continue;
    const std::vector<NamedValue> parameters = spacetime->parameters();
    const Rates50 flow = flow50(entry.card->metric, entry.card->chart, parameters);
    const std::vector<Real50> y(start->y.c.begin(), start->y.c.end());
    const Twice50 end = integrate50_twice(flow, y, Real50(start->lambda));
    std::vector<std::string> row = {std::string(entry.card->metric), std::string(entry.card->chart),
                                    parameters_text(parameters)};
    for (const double c : start->y.c) row.push_back(number_text(c));
    row.push_back(number_text(start->lambda));
    for (std::size_t i = 0; i < 8; ++i) {
      row.push_back(agreed(end.y[i], end.again[i], digits, fmt::format("{} {}, component {}", row[0], row[1], i)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReferenceTable make_kerr_rays() {
  constexpr int digits = 30;
  ReferenceTable table{
      .name = "kerr_rays",
      .quantity = "light about Kerr (M = 1) with E = 1 from (r, theta) inward, with t = phi = 0, until r_end",
      .units = "lengths and affine M; theta and phi rad; mino 1/M; L and p_theta M",
      .origin = "computed",
      .method =
          "Carter's first integrals in Mino time at 50 digits, written apart from the metric modules; Hamilton's "
          "equations of the module in Boyer-Lindquist coordinates, at 50 digits, agree in every digit",
      .digits = digits,
      .rank = std::string(to_string(TruthRank::high_precision)),
      .cites = "Carter1968 GrallaLupsasca2020Geodesics",
      .maker = "xprimeray reference --regenerate kerr_rays",
      .columns = {"a", "r", "theta", "L", "p_theta", "r_end", "end_moves", "end_t", "end_theta", "end_phi", "affine",
                  "mino"},
      .rows = {}};
  // Past the hole and back; close past it, with and against its turn; over the axis closely; into it.
  for (const KerrRay& ray :
       {KerrRay{0.6, 50.0, 1.0, 2.0, 6.0, 50.0, true},                                                      //
        KerrRay{0.9, 20.0, 1.3, 2.5, 2.5, 20.0, true},                                                      //
        KerrRay{0.998, 20.0, 1.5, -6.5, 3.5, 20.0, true}, KerrRay{0.9, 20.0, 0.5, 0.05, -7.0, 20.0, true},  //
        KerrRay{0.9, 20.0, 2.0, 1.0, 1.5, 2.0, false}}) {
    const KerrRayEnd end = kerr_ray_by_first_integrals(ray), other = kerr_ray_by_hamiltonian(ray);
    std::vector<std::string> row;
    for (const double x : {ray.spin, ray.r, ray.theta, ray.L, ray.p_theta, ray.r_end}) row.push_back(number_text(x));
    const std::string what = fmt::format("Kerr ray of a = {}, L = {}", ray.spin, ray.L);
    row.push_back(ray.outward ? "outward" : "inward");
    row.push_back(agreed(end.t, other.t, digits, what + ", t"));
    row.push_back(agreed(end.theta, other.theta, digits, what + ", theta"));
    row.push_back(agreed(end.phi, other.phi, digits, what + ", phi"));
    row.push_back(agreed(end.affine, other.affine, digits, what + ", affine"));
    row.push_back(digits_of(end.mino, digits));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace xpr
