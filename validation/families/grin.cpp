// Author-controlled gradient-index fields: exit directions against quadratures of Bouguer's invariant, two centres
// against 50 digits, the fixtures pixel by pixel, and the first order of the stepper that older renderers had.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/fields/kick_drift.hpp"
#include "metrics/fields/field_medium.hpp"
#include "metrics/fields/grin_exact.hpp"
#include "validation/families.hpp"
#include "validation/kit.hpp"
#include "validation/truth/field_rays50.hpp"
#include "validation/truth/grin_fixtures.hpp"

namespace xpr {

namespace {

using Vector = grin_exact::Vector;

constexpr const char* repelling_fault = "grin-repelling-sign";
constexpr const char* curve_fault = "grin-exponential-for-gaussian";
constexpr const char* ramp_fault = "grin-edge-ramp-left-out";
constexpr const char* nearest_fault = "grin-nearest-centre-only";
constexpr const char* projection_fault = "grin-field-of-view-horizontal";
constexpr const char* renormalise_fault = "grin-kick-never-renormalised";

struct Profile {
  std::string_view name;
  FieldSource source;
};

FieldSource lens(FieldCurve curve, double a, double b = 0.0, double c = 0.0) {
  return {.name = "lens", .curve = curve, .amplitude = 0.9, .r_outer = 5.0, .a = a, .b = b, .c = c};
}

std::vector<Profile> profiles() {
  std::vector<Profile> out = {{"linear", lens(FieldCurve::linear, 0.0)},
                              {"power 1.8", lens(FieldCurve::power, 1.8)},
                              {"polynomial", lens(FieldCurve::polynomial, 1.0, -0.7, -0.2)},
                              {"exponential", lens(FieldCurve::exponential, 2.0)},
                              {"gaussian", lens(FieldCurve::gaussian, 0.45)},
                              {"custom", lens(FieldCurve::custom, 0.0)},
                              {"power 3, core", lens(FieldCurve::power, 3.0)},
                              {"gaussian, soft edges", lens(FieldCurve::gaussian, 0.6)},
                              {"exponential, repelling", lens(FieldCurve::exponential, 1.0)}};
  out[5].source.table = {1.0, 0.8, 0.75, 0.3, 0.1, 0.0};
  out[6].source.r_inner = 1.5;
  out[7].source.edge_softness = 0.3;
  out[7].source.r_inner = 0.5;
  out[8].source.invert_sign = true;
  return out;
}

/// What the medium is made of, where a fault says that it is something else.
FieldSource as_built(const Lab& lab, FieldSource source) {
  if (lab.planted(repelling_fault)) source.invert_sign = !source.invert_sign;
  if (lab.planted(curve_fault) && source.curve == FieldCurve::gaussian) source.curve = FieldCurve::exponential;
  if (lab.planted(ramp_fault)) source.edge_softness = 0.0;
  return source;
}

/// Light at x along d, E = 1.
PhaseState<double> light(const Spacetime& medium, const Vector& x, const Vector& d) {
  const Vec4<double> event = {0.0, x[0], x[1], x[2]};
  const double n = std::sqrt(-medium.inverse_metric(event)(0, 0));
  const double norm = std::hypot(d[0], d[1], d[2]);
  return {event, {-1.0, n * d[0] / norm, n * d[1] / norm, n * d[2] / norm}};
}

/// Light followed until it is out of all fields.
RayEnd follow_out(const Lab& lab, const Spacetime& medium, const Vector& from, const Vector& d,
                  const MethodAt& method) {
  TraceSettings settings = trace_settings(method);
  settings.r_max = 14.0;        // beyond every field, before what fixtures show
  settings.max_steps = 20'000;  // a fault may bind light to its field
  return lab.trace(medium, light(medium, from, d), 1, settings);
}

/// The angle between where light goes and a direction of length one, without loss near 0.
double angle_to(const RayEnd& end, const Vector& d) {
  const Vector p{end.y[5], end.y[6], end.y[7]};
  const Vector across{p[1] * d[2] - p[2] * d[1], p[2] * d[0] - p[0] * d[2], p[0] * d[1] - p[1] * d[0]};
  return std::atan2(std::hypot(across[0], across[1], across[2]), p[0] * d[0] + p[1] * d[1] + p[2] * d[2]);
}
/// How far the end lies off a line.
double distance_to(const RayEnd& end, const grin_exact::Line& line) {
  const Vector x{end.y[1] - line.point[0], end.y[2] - line.point[1], end.y[3] - line.point[2]};
  const Vector& d = line.direction;
  return std::hypot(x[1] * d[2] - x[2] * d[1], x[2] * d[0] - x[0] * d[2], x[0] * d[1] - x[1] * d[0]);
}

std::vector<MethodAt> methods_of(const Lab& lab) {
  std::vector<MethodAt> out = {{"dop853", 1e-12, Projection::full}, {"dopri54", 1e-9}};
  if (lab.full()) out.push_back({"rkf45", 1e-9});
  return out;
}

constexpr const char* blind_before_a_field =
    "Fehlberg's 7(8) pair cannot see its own error along nearly straight rays: its two formulas differ by 41/840 (k1 + "
    "k11 - k12 - k13); measured at tol 1e-11: rays that fly through a field unbent, and 1e-7 to 1e-9 elsewhere";

/// The promise of tier 2; other methods by their steps' errors, which bends amplify and which kinks of n meet once
/// each.
Tolerance tolerance_of(const RayEnd& end, const MethodAt& method) {
  if (method.method == "dop853") return {1e-9, "the promise of tier 2: exit directions to 1e-9 rad"};
  return accumulated(end, method.setting, 20.0);
}

void add_line_rows(std::vector<Row>& rows, const Lab& lab, const Spacetime& medium, const std::string& label,
                   const Vector& from, const Vector& d, const grin_exact::Line& exact,
                   const std::vector<RowParameter>& parameters) {
  for (const MethodAt& method : methods_of(lab)) {
    const RayEnd end = follow_out(lab, medium, from, d, method);
    Row row =
        make_row(fmt::format("{}, {} {:g}", label, method_label(method), method.setting), medium, method, parameters);
    if (!ended_as(row, end, Status::escaped)) {
      rows.push_back(std::move(row));
      continue;
    }
    const Tolerance tolerance = tolerance_of(end, method);
    row.unit = "rad";
    grade(row, angle_to(end, exact.direction), {0.0, exact.direction_error}, tolerance);
    rows.push_back(row);
    row.label = fmt::format("{}, place, {} {:g}", label, method_label(method), method.setting);
    row.unit = "1";
    // The end is fifteen lengths from the centre: an error of direction shows fifteen times.
    grade(row, distance_to(end, exact), {0.0, exact.point_error + 15.0 * exact.direction_error},
          {15.0 * tolerance.value, tolerance.reason + ", seen 15 lengths on"});
    rows.push_back(std::move(row));
  }
}

std::vector<Row> deflection_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (const Profile& profile : profiles()) {
    const grin_exact::RadialIndex index(profile.source, {});
    const auto medium = make_field_spacetime({{as_built(lab, profile.source)}, {}});
    for (const double b : {0.3, 1.0, 2.5, 4.5, 4.99}) {
      const ExactValue alpha = grin_exact::deflection(index, b);
      for (const MethodAt& method : methods_of(lab)) {
        // Out of every plane of the axes.
        const Vector from{-12.0, 0.6 * b, -0.8 * b};
        const RayEnd end = follow_out(lab, *medium, from, {1.0, 0.0, 0.0}, method);
        Row row = make_row(fmt::format("{}, b = {}, {} {:g}", profile.name, b, method_label(method), method.setting),
                           *medium, method, {{"b", b, "1"}});
        row.unit = "rad";
        if (ended_as(row, end, Status::escaped)) {
          // Towards the centre, and past half a turn where it goes round.
          const double inward = -(0.6 * end.y[6] - 0.8 * end.y[7]);
          double turned = std::atan2(inward, end.y[5]);
          turned += 2.0 * std::numbers::pi * std::round((alpha.value - turned) / (2.0 * std::numbers::pi));
          grade(row, turned, {alpha.value, alpha.error}, tolerance_of(end, method));
        }
        rows.push_back(std::move(row));
      }
    }
  }
  if (lab.full()) rows.push_back(skipped_row("every profile, odeint:rkf78 1e-11", blind_before_a_field, "rad"));
  return rows;
}

std::vector<Row> inside_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (Profile profile : profiles()) {
    profile.source.world_from_local.origin = {0.5, -1.0, 0.25};
    const grin_exact::RadialIndex index(profile.source, {});
    const auto medium = make_field_spacetime({{as_built(lab, profile.source)}, {}});
    for (const auto& [from, d] : {std::pair<Vector, Vector>{{2.5, 0.5, 1.0}, {0.6, 0.0, 0.8}},
                                  {{-1.5, 1.0, 0.5}, {0.8, -0.48, 0.36}},
                                  {{7.0, 6.0, -5.0}, {-0.7, -0.6, 0.5}}}) {
      const auto exact = grin_exact::outgoing(index, from, d);
      const std::string label = fmt::format("{} from ({}, {}, {})", profile.name, from[0], from[1], from[2]);
      if (!exact) continue;  // bound to the field: it has no way out to grade
      add_line_rows(rows, lab, *medium, label, from, d, *exact, {});
    }
  }
  return rows;
}

std::vector<Row> invariant_rows(const Lab& lab) {
  std::vector<Row> rows;
  for (const Profile& profile : profiles()) {
    const grin_exact::RadialIndex index(profile.source, {});
    const auto medium = make_field_spacetime({{as_built(lab, profile.source)}, {}});
    const MethodAt method{"dop853", 1e-12};
    const double b = 1.7;
    double worst = 0.0;
    TraceSettings settings = trace_settings(method);
    settings.r_max = 12.0;
    const RayEnd end =
        lab.trace(*medium, light(*medium, {-9.0, b, 0.0}, {1.0, 0.0, 0.0}), 1, settings, {}, [&](const StepView& step) {
          const PhaseState<double>& y = step.end;
          const double r = std::hypot(y[1], y[2], y[3]);
          const double n = std::exp(static_cast<double>(index.log_index(r)));
          const double sine = std::abs(y[1] * y[6] - y[2] * y[5]) / (r * std::hypot(y[5], y[6], y[7]));
          worst = std::max(worst, std::abs(n * r * sine - b));
        });
    Row row = make_row(fmt::format("{}, b = {}", profile.name, b), *medium, method, {{"b", b, "1"}});
    if (ended_as(row, end, Status::escaped)) grade_bound(row, worst, accumulated(end, method.setting, 20.0));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> two_centre_rows(const Lab& lab) {
  std::vector<Row> rows;
  std::vector<PowerField> fields;
  FieldSet set = grin_fixtures()[3].fields;
  for (const FieldSource& source : set.sources) {
    fields.push_back({source.world_from_local.origin, bending_of(source, set.gains), source.r_outer, source.a});
  }
  if (lab.planted(nearest_fault)) set.sources.pop_back();
  const auto medium = make_field_spacetime(set);
  for (const Vector& d : {Vector{0.05, 0.11, -1.0}, {0.31, 0.02, -1.0}, {-0.6, 0.25, -1.0}, {0.0, 0.3, -1.0}}) {
    if (!lab.full() && d[2] == -1.0 && d[0] < 0.0) continue;
    const grin_exact::Line exact = outgoing50(fields, GrinFixture::camera, d);
    add_line_rows(rows, lab, *medium, fmt::format("direction ({}, {}, {})", d[0], d[1], d[2]), GrinFixture::camera, d,
                  exact, {});
  }
  return rows;
}

/// Worst direction over a spread of pixels of each fixture, and the number whose class differs.
std::vector<Row> fixture_rows(const Lab& lab) {
  std::vector<Row> rows;
  const MethodAt method{"dop853", 1e-12, Projection::full};
  for (const GrinFixture& fixture : grin_fixtures()) {
    const bool one_field = fixture.fields.sources.size() == 1;
    // Strides without a common factor with the film's symmetry; 50 digits are dear.
    const int stride = one_field ? (lab.full() ? 7 : 23) : (lab.full() ? 61 : 131);
    const auto medium = make_field_spacetime(fixture.fields);
    double worst = 0.0, truth_error = 0.0;
    int differ = 0, pixels = 0, close = 0;
    std::int64_t evaluations = 0;
    for (int row = stride / 3; row < GrinFixture::height; row += stride) {
      for (int column = stride / 4; column < GrinFixture::width; column += stride) {
        const FixtureTruth truth = fixture.truth(column, row);
        Vector d = fixture.direction(column, row);
        if (lab.planted(projection_fault)) d[0] *= 9.0 / 16.0;  // 42 degrees taken for the horizontal field of view
        const RayEnd end = follow_out(lab, *medium, GrinFixture::camera, d, method);
        evaluations += end.evaluations;
        ++pixels;
        worst = std::max(worst, end.status == Status::escaped ? angle_to(end, truth.line.direction) : 9.0);
        truth_error = std::max(truth_error, truth.line.direction_error);
        const double p = std::hypot(end.y[5], end.y[6], end.y[7]);
        const FixtureTruth traced = fixture.classified(
            {.point = {end.y[1], end.y[2], end.y[3]}, .direction = {end.y[5] / p, end.y[6] / p, end.y[7] / p}});
        if (truth.margin < 1e-7) ++close;
        if (truth.margin >= 1e-7 && (traced.hit != truth.hit || traced.sphere != truth.sphere)) ++differ;
      }
    }
    Row row =
        make_row(fmt::format("fixture {}, direction, worst of {} pixels", fixture.id, pixels), *medium, method, {});
    row.unit = "rad";
    row.evaluations = evaluations;
    grade(row, worst, {0.0, truth_error}, {1e-9, "the promise of tier 2: exit directions to 1e-9 rad"});
    rows.push_back(row);
    row.label =
        fmt::format("fixture {}, pixels of another class, {} of {} too close to tell", fixture.id, close, pixels);
    row.unit = "1";
    grade_bound(row, differ, {0.5, "none: 1e-9 rad moves light by 4e-8 on its way of 40 lengths, margins are 1e-7"});
    rows.push_back(std::move(row));
  }
  return rows;
}

/// v' = a - (a.v) v by Runge and Kutta in arc length, a from the closed form: what the stepper's rays tend to.
Vec3 end_of_continuum(const grin_exact::RadialIndex& index, Vec3 x, Vec3 v, double length_to_go, int steps) {
  const auto pull = [&](const Vec3& at, const Vec3& along) {
    const double r = length(at);
    const Vec3 a = (-static_cast<double>(index.bending(r)) / r) * at;
    return a - dot(a, along) * along;
  };
  const double h = length_to_go / steps;
  for (int k = 0; k < steps; ++k) {
    const Vec3 a1 = pull(x, v), v2 = v + 0.5 * h * a1;
    const Vec3 a2 = pull(x + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
    const Vec3 a3 = pull(x + 0.5 * h * v2, v3), v4 = v + h * a3;
    const Vec3 a4 = pull(x + h * v3, v4);
    x = x + (h / 6.0) * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v = v + (h / 6.0) * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return x;
}

std::vector<Row> kick_drift_rows(const Lab& lab) {
  std::vector<Row> rows;
  constexpr double path = 9.0;
  for (const Profile& profile : profiles()) {
    if (profile.source.invert_sign || profile.source.curve == FieldCurve::custom) continue;
    const grin_exact::RadialIndex index(profile.source, {});
    const FieldModel model({{profile.source}, {}});
    // The end is inside the field, away from its rim: that it is met at any part of a step is no matter of order.
    std::array<double, 2> error{};
    for (const double y : {0.8, 1.3, 2.1, 2.7}) {
      const Vec3 from{-4.0, y, 0.4}, along{1.0, 0.0, 0.0};
      const Vec3 exact = end_of_continuum(index, from, along, 0.75 * path, 4000);
      for (std::size_t k = 0; k < 2; ++k) {
        const double h = 0.75 * path / (k == 0 ? 512 : 1024);
        KickDriftSettings settings{.max_steps = 100'000, .step_length = h, .min_step = h, .max_step = h};
        settings.acceleration_cap = std::nullopt;
        settings.max_distance = 0.75 * path;
        Vec3 end = trace_kick_drift(model, from, along, settings).state.position;
        if (lab.planted(renormalise_fault)) {
          Vec3 v = along;
          end = from;
          for (int step = 0; step < (k == 0 ? 512 : 1024); ++step) {
            const FieldVector<double> a = model.evaluate<double>({end.x, end.y, end.z}).gradient;
            v = v + h * Vec3{a[0], a[1], a[2]};
            end = end + h * v;
          }
        }
        error[k] += square(length(end - exact));
      }
    }
    Row row;
    row.label = fmt::format("{}, steps of 1/512 and 1/1024 of the path, four rays", profile.name);
    row.metric = "fields";
    row.chart = "cartesian";
    row.method = "tier0_kick_drift";
    row.unit = "1";
    grade(row, 0.5 * std::log2(error[0] / error[1]), {1.0, 0.0},
          {0.03, "the next order is 1/512 of a few radians of bending; kinks of the profile add as much"});
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<Case> grin_cases() {
  std::vector<Case> out;
  out.push_back(
      {closed_form_case("grin", "deflection", "A radial field deflects light as Bouguer's invariant says.",
                        "ln n = A S F(u), F(u) = int_u^1 f; n r sin(psi) = b. Light from outside, nine profiles.",
                        "alpha = 2 [int b dr/(r sqrt(n^2 r^2 - b^2)) + asin(b/R)] - pi by quadrature", "BornWolf1999"),
       true, deflection_rows});
  out.push_back(
      {closed_form_case("grin", "direction", "Light from any point in or about a field leaves it on its exact line.",
                        "The direction after the field and the place of the line, a field off the origin.",
                        "quadrature of the swept angle", "BornWolf1999"),
       true, inside_rows});
  out.push_back(
      {closed_form_case("grin", "bouguer", "n r sin(psi) is constant along a ray.",
                        "Its largest change over a ray through the field, with no projection.", "b", "BornWolf1999"),
       true, invariant_rows});
  CaseInfo two = closed_form_case("grin", "two-centres", "Fields add up in ln n.",
                                  "Two overlapping fields of fixture 004; no invariant is left but the energy.",
                                  "50 digits, n = exp(ln n_1 + ln n_2) written apart", "BornWolf1999");
  two.rank = TruthRank::high_precision;
  out.push_back({std::move(two), true, two_centre_rows});
  CaseInfo fixtures = closed_form_case(
      "grin", "fixtures", "The light of every pixel of fixtures 001 to 004 goes where it must, and meets what it must.",
      "A spread of pixels; class: a sphere, the backdrop or nothing.",
      "one field: quadrature; two: 50 digits. Behind the fields light is straight.", "BornWolf1999");
  fixtures.rank = TruthRank::high_precision;
  out.push_back({std::move(fixtures), true, fixture_rows});
  CaseInfo order = closed_form_case(
      "grin", "kick-drift-order",
      "The kick-drift stepper of tier 0 is of first order, and tends to the rays of the medium.",
      "End position at fixed arc length, norm over four rays, against v' = a - (a.v) v.",
      "order 1; the end point by Runge-Kutta in arc length with a from the closed form", "BornWolf1999");
  order.grades_metric = false;
  out.push_back({std::move(order), true, kick_drift_rows});
  return out;
}

std::vector<Fault> grin_faults() {
  return {{.id = repelling_fault,
           .description = "a > 0 pushes outward, as one of two older evaluators had it",
           .case_id = "grin/deflection"},
          {.id = curve_fault,
           .description = "\"Exponential\" read as exp(-a u) where it meant exp(-(u/a)^2)",
           .case_id = "grin/direction"},
          {.id = ramp_fault, .description = "the edge ramp left out of the index", .case_id = "grin/bouguer"},
          {.id = nearest_fault,
           .description = "one of two overlapping fields alone bends light",
           .case_id = "grin/two-centres"},
          {.id = projection_fault,
           .description = "the vertical field of view taken for the horizontal one",
           .case_id = "grin/fixtures"},
          {.id = renormalise_fault,
           .description = "the kicked direction never made a unit vector again",
           .case_id = "grin/kick-drift-order"}};
}

}  // namespace xpr
