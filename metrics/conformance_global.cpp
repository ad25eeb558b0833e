// Far field, sense of rotation, axis and horizon: what local field equations cannot see.
#include <fmt/format.h>

#include <numbers>

#include "metrics/conformance_kit.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr::conformance {

namespace {

constexpr double equator = 0.5 * std::numbers::pi;

/// g(K, K') of the Killing vectors named E and L_z, where the chart has both.
struct OrbitMetric {
  double tt = 0.0;
  double tp = 0.0;
  double pp = 0.0;
};

std::optional<OrbitMetric> orbit_metric(const Spacetime& chart, const Vec4<double>& x) {
  const std::vector<KillingVector> vectors = chart.killing_vectors(x);
  const auto named = [&](std::string_view name) {
    return std::find_if(vectors.begin(), vectors.end(), [&](const KillingVector& k) { return k.name == name; });
  };
  const auto time = named("E");
  const auto turn = named("L_z");
  if (time == vectors.end() || turn == vectors.end()) return std::nullopt;
  const SymTensor4<double> g = chart.metric(x);
  const Vec4<double> lowered_time = raise_index(g, time->component);
  return OrbitMetric{contract(lowered_time, time->component), contract(lowered_time, turn->component),
                     contract(raise_index(g, turn->component), turn->component)};
}

/// Spin and mass of a rotating black hole, where the module has both parameters and a horizon.
struct Rotation {
  double mass;
  double spin;
};
std::optional<Rotation> rotation_of(const Subject& subject) {
  const std::optional<double> mass = parameter(subject.chart, "M");
  const std::optional<double> spin = parameter(subject.chart, "a");
  if (!mass || !spin || !subject.chart.horizon_radius()) return std::nullopt;
  return Rotation{*mass, *spin};
}

void check_asymptotic_flatness(const Subject& subject, std::vector<Finding>& findings) {
  const Card& card = subject.chart.card();
  const char* claim = "far out the metric goes to that of flat space at least as fast as 1/r";
  const Layout layout = layout_of(card);
  if (!card.asymptotically_flat || (layout != Layout::cartesian && layout != Layout::polar)) {
    findings.push_back(not_checked("asymptotics", claim, "the card does not call the spacetime asymptotically flat"));
    return;
  }
  Worst worst;
  const double far = 1e6 * subject.length;
  std::vector<double> ends = {far};
  if (card.coordinates[1].lower < 0.0 && layout == Layout::polar) ends.push_back(-far);
  for (const double end : ends) {
    for (const double theta : {0.4, 1.1, 2.5}) {
      const Vec4<double> x = *event_at(card, end, theta, 0.8);
      SymTensor4<double> g = subject.chart.metric(x);
      const double around = far * sin(theta);
      const Vec4<double> unit =
          layout == Layout::cartesian ? Vec4<double>{1.0, 1.0, 1.0, 1.0} : Vec4<double>{1.0, 1.0, far, around};
      for (std::size_t mu = 0; mu < 4; ++mu) {
        for (std::size_t nu = mu; nu < 4; ++nu) {
          const double flat = mu != nu ? 0.0 : (mu == 0 ? -1.0 : 1.0);
          worst.look(std::abs(g(mu, nu) / (unit[mu] * unit[nu]) - flat) * far / subject.length, x,
                     spell(card, "g_", mu, nu));
        }
      }
    }
  }
  findings.push_back(finish(subject, "asymptotics", claim, worst,
                            {10.0,
                             "|g - flat| r / length at r = 1e6 lengths: the coefficient of 1/r, 2 or 4 for a "
                             "black hole, is of order one"}));
}

void check_mass(const Subject& subject, std::vector<Finding>& findings) {
  const char* claim = "the mass read off far away, r (1 + g_tt) / 2, is the parameter M";
  const std::optional<double> mass = parameter(subject.chart, "M");
  if (!mass || !subject.chart.horizon_radius() || !subject.chart.card().asymptotically_flat) {
    findings.push_back(not_checked("mass", claim, "not a black hole in flat surroundings with a parameter M"));
    return;
  }
  Worst worst;
  for (const double theta : {0.4, 1.1, 2.5}) {
    const std::optional<double> r = coordinate_radius(subject, 1e6 * *mass, theta, 0.8);
    if (!r) continue;
    const Vec4<double> x = *event_at(subject.chart.card(), *r, theta, 0.8);
    const std::optional<OrbitMetric> g = orbit_metric(subject.chart, x);
    if (!g) continue;
    worst.look(std::abs(subject.chart.radius(x) * (1.0 + g->tt) / (2.0 * *mass) - 1.0), x, "far-field mass / M");
  }
  Finding finding = finish(subject, "mass", claim, worst,
                           {1e-5, "the next terms of g_tt are of relative size M/r = 1e-6, round-off 1e-10"});
  if (finding.state == FindingState::failed) {
    const Vec4<double>& x = finding.where;
    const double found = subject.chart.radius(x) * (1.0 + orbit_metric(subject.chart, x)->tt) / 2.0;
    finding.message = fmt::format("far away g_tt is that of a mass {:.4g} where M = {:.4g}: a ratio of {:.3f}", found,
                                  *mass, found / *mass);
  }
  findings.push_back(std::move(finding));
}

void check_frame_dragging(const Subject& subject, std::vector<Finding>& findings) {
  const char* claim = "a ray without angular momentum is dragged along with the spin: dphi/dt -> 2 M a / r^3";
  const std::optional<Rotation> hole = rotation_of(subject);
  if (!hole) {
    findings.push_back(not_checked("frame-dragging", claim, "not a black hole with parameters M and a"));
    return;
  }
  Worst worst;
  double found_ratio = 0.0;
  for (const double theta : {0.4, 1.1, 2.5}) {
    const std::optional<double> r = coordinate_radius(subject, 1e4 * hole->mass, theta, 0.8);
    if (!r) continue;
    const Vec4<double> x = *event_at(subject.chart.card(), *r, theta, 0.8);
    const std::optional<OrbitMetric> g = orbit_metric(subject.chart, x);
    if (!g) continue;
    const double radius = subject.chart.radius(x);
    const double scaled = -g->tp / g->pp * radius * radius * radius / (2.0 * hole->mass);
    const double size = hole->spin == 0.0 ? hole->mass : hole->spin;
    if (hole->spin != 0.0) found_ratio = scaled / hole->spin;
    worst.look(std::abs((scaled - hole->spin) / size), x, "dφ/dt r³ / 2Ma");
  }
  Finding finding =
      finish(subject, "frame-dragging", claim, worst, {1e-3, "the next terms are of relative size M/r = 1e-4"});
  if (finding.state == FindingState::failed && found_ratio < 0.0) {
    finding.message = fmt::format(
        "space is dragged against the spin: dφ/dt has the wrong sign (a ratio of {:.3f}); the sign of g_tφ or of a "
        "in this chart is flipped",
        found_ratio);
  } else if (finding.state == FindingState::failed) {
    finding.message =
        fmt::format("frame dragging, and with it g_tφ, is {:.3f} × what a = {:.4g} implies", found_ratio, hole->spin);
  }
  findings.push_back(std::move(finding));
}

/// Radius of the equatorial circular photon orbit whose angular momentum has the given sign: where |L/E| of a null
/// vector in the plane of the two Killing vectors is least. In units of the chart's radius().
std::optional<double> photon_orbit(const Subject& subject, double sign) {
  const double horizon = *subject.chart.horizon_radius();
  double best = std::numeric_limits<double>::infinity();
  double best_radius = 0.0;
  const int steps = 600;
  for (int i = 1; i < steps; ++i) {
    const double u = static_cast<double>(i) / steps;  // horizon / radius
    const std::optional<double> r = coordinate_radius(subject, horizon / u, equator, 0.3);
    if (!r) return std::nullopt;
    const Vec4<double> x = *event_at(subject.chart.card(), *r, equator, 0.3);
    const std::optional<OrbitMetric> g = orbit_metric(subject.chart, x);
    if (!g || !(g->pp > 0.0)) continue;
    const double discriminant = g->tp * g->tp - g->tt * g->pp;
    if (!(discriminant >= 0.0)) continue;
    for (const double branch : {-1.0, 1.0}) {
      const double omega = (-g->tp + branch * std::sqrt(discriminant)) / g->pp;
      const double energy = -(g->tt + omega * g->tp);
      const double ratio = (g->tp + omega * g->pp) / energy;
      if (!(energy > 0.0) || !(sign * ratio > 0.0) || !(sign * ratio < best)) continue;
      best = sign * ratio;
      best_radius = subject.chart.radius(x);
    }
  }
  return best_radius > 0.0 ? std::optional(best_radius) : std::nullopt;
}

void check_photon_orbits(const Subject& subject, std::vector<Finding>& findings) {
  const char* claim = "light that turns with the hole orbits further in than light that turns against it";
  const std::optional<Rotation> hole = rotation_of(subject);
  if (!hole || hole->spin == 0.0) {
    findings.push_back(not_checked("photon-orbits", claim, "not a rotating black hole"));
    return;
  }
  const double sense = hole->spin < 0.0 ? -1.0 : 1.0;
  const std::optional<double> prograde = photon_orbit(subject, sense);
  const std::optional<double> retrograde = photon_orbit(subject, -sense);
  if (!prograde || !retrograde) {
    findings.push_back(
        not_checked("photon-orbits", claim, "the chart names no E and L_z, or does not reach the orbits"));
    return;
  }
  Worst worst;
  worst.look(std::max(0.0, (*prograde - *retrograde) / hole->mass),
             *event_at(subject.chart.card(), *prograde, equator, 0.3), "r_prograde - r_retrograde");
  Finding finding = finish(subject, "photon-orbits", claim, worst,
                           {1e-3, "the orbits lie |a| or more apart; the search for them has a grid of 1/600"});
  finding.message = fmt::format("prograde at r = {:.3f}, retrograde at r = {:.3f}", *prograde, *retrograde);
  findings.push_back(std::move(finding));
}

void check_axis(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const char* claim = "circles about the axis close without a cone: (grad X)^2 / 4X -> 1 with X = g(L_z, L_z)";
  Worst worst;
  for (const double factor : {1.4, 3.0, 8.0}) {
    for (const double theta : {1e-3, std::numbers::pi - 1e-3}) {
      const double r = factor * chart.horizon_radius().value_or(subject.length);
      const std::optional<Vec4<double>> x = event_at(chart.card(), r, theta, 0.6);
      if (!x || !chart.inside_domain(*x)) continue;
      const double size = layout_of(chart.card()) == Layout::geographic ? subject.length : r;
      const auto circle = [&](const Vec4<double>& at) {
        const std::optional<OrbitMetric> g = orbit_metric(chart, at);
        return g ? g->pp : std::numeric_limits<double>::quiet_NaN();
      };
      const double here = circle(*x);
      if (!(std::abs(here) < 0.1 * size * size)) continue;
      Vec4<double> gradient{};
      for (std::size_t mu = 1; mu < 4; ++mu) {
        const CoordinateKind kind = chart.card().coordinates[mu].kind;
        const bool across = kind != CoordinateKind::azimuth;
        const double step = kind == CoordinateKind::length ? 2e-4 * r : 2e-4;
        if (!across) continue;
        gradient[mu] = differentiate<1>(
            [&](double s) {
              Vec4<double> moved = *x;
              moved[mu] += s;
              return std::array<double, 1>{circle(moved)};
            },
            step)[0];
      }
      const double slope = contract(raise_index(chart.inverse_metric(*x), gradient), gradient) / (4.0 * here);
      worst.look(std::abs(slope - 1.0), *x, "g(L_z, L_z)");
    }
  }
  if (!worst.any()) {
    findings.push_back(not_checked("axis", claim, "the chart has no axis of L_z that it comes near to"));
    return;
  }
  findings.push_back(
      finish(subject, "axis", claim, worst, {1e-4, "at 1e-3 rad off the axis the next term is of size 1e-6"}));
}

void check_horizon(const Subject& subject, std::vector<Finding>& findings) {
  const Spacetime& chart = subject.chart;
  const char* claim = "a chart that goes through the horizon has a bounded, continuous metric there";
  const std::optional<double> horizon = chart.horizon_radius();
  if (!horizon) {
    findings.push_back(not_checked("horizon", claim, "there is no horizon"));
    return;
  }
  Worst worst;
  for (const double theta : {0.05, 0.9, 2.4}) {
    const std::optional<double> r = coordinate_radius(subject, *horizon, theta, 0.4);
    if (!r) continue;
    const Card& card = chart.card();
    const Vec4<double> x = *event_at(card, *r * (1.0 + 1e-7), theta, 0.4);
    const Vec4<double> inside = *event_at(card, *r * (1.0 - 1e-7), theta, 0.4);
    if (!chart.inside_domain(inside)) continue;
    const SymTensor4<double> above = chart.inverse_metric(x);
    const SymTensor4<double> below = chart.inverse_metric(inside);
    // A polar chart has the horizon as a coordinate surface and may break there; a Cartesian one has no excuse.
    if (layout_of(card) == Layout::polar && largest(above) > 1e4) continue;
    double jump = 0.0;
    for (std::size_t i = 0; i < above.c.size(); ++i) jump = std::max(jump, std::abs(above.c[i] - below.c[i]));
    worst.look(std::max(jump, 1e-6 * largest(above)), x, "g^{mu nu} across the horizon");
  }
  if (!worst.any()) {
    findings.push_back(
        not_checked("horizon", claim, "the chart ends or breaks at the horizon, as its header should say"));
    return;
  }
  findings.push_back(finish(subject, "horizon", claim, worst,
                            {1e-4,
                             "over 2e-7 of the radius a smooth metric changes by less than 1e-5; its components "
                             "are below 100"}));
}

}  // namespace

void check_far_field(const Subject& subject, std::vector<Finding>& findings) {
  check_asymptotic_flatness(subject, findings);
  check_mass(subject, findings);
}

void check_orientation(const Subject& subject, std::vector<Finding>& findings) {
  check_frame_dragging(subject, findings);
  check_photon_orbits(subject, findings);
}

void check_regularity(const Subject& subject, std::vector<Finding>& findings) {
  check_axis(subject, findings);
  check_horizon(subject, findings);
}

}  // namespace xpr::conformance
