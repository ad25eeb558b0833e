#include "validation/grading/challenge.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "metrics/catalogue.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/kerr_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/grading/challenge_starts.hpp"

namespace xpr {
namespace {

constexpr double equator = 0.5 * std::numbers::pi;

int sign_of(std::int64_t k) { return k % 2 == 0 ? 1 : -1; }

// Two of three rays carry p_t = -2.
PhaseState<double> at_some_energy(const PhaseState<double>& y, std::int64_t k) { return k % 3 != 0 ? doubled(y) : y; }

// Light that comes in from x1 with b between two values, from anywhere off the axis.
PhaseState<double> incoming(const Spacetime& home, std::int64_t k, double x1, double low, double high) {
  const auto u = even_numbers(k);
  return at_some_energy(
      departed(home, aimed(x1, even_theta(u[0], 0.92), even_phi(u[1]), between(low, high, u[2]), u[3])), k);
}

// The same backwards in time.
PhaseState<double> incoming_past(const Spacetime& home, std::int64_t k, double x1, double low, double high) {
  const auto u = even_numbers(k);
  Departing start = aimed(x1, even_theta(u[0], 0.92), even_phi(u[1]), between(low, high, u[2]), u[3]);
  start.p_t = 1.0;
  return departed(home, start);
}

// Over the axis: no angular momentum about it.
PhaseState<double> over_the_axis(const Spacetime& home, std::int64_t k, double x1, double low, double high) {
  const auto u = even_numbers(k);
  return departed(home, {.x1 = x1,
                         .theta = even_theta(u[0], 0.92),
                         .phi = even_phi(u[1]),
                         .p_theta = sign_of(k) * between(low, high, u[2])});
}

// Past the axis at a distance of 1e-3 to 1e-1 in L.
PhaseState<double> close_to_the_axis(const Spacetime& home, std::int64_t k, double x1, double low, double high) {
  const auto u = even_numbers(k);
  return departed(home, {.x1 = x1,
                         .theta = even_theta(u[0], 0.92),
                         .phi = even_phi(u[1]),
                         .p_theta = (u[4] < 0.5 ? 1.0 : -1.0) * between(low, high, u[2]),
                         .p_phi = sign_of(k) * std::array{1e-3, 1e-2, 1e-1}[static_cast<std::size_t>(k % 3)]});
}

// From its turning point (p_r = 0), or from just before it.
PhaseState<double> tangent(const Spacetime& home, std::int64_t k, double low, double high, double p_r) {
  const auto u = even_numbers(k);
  const double r = between(low, high, u[2]);
  const double theta = even_theta(u[0], 0.6);
  return departed(home, {.x1 = r,
                         .theta = theta,
                         .phi = even_phi(u[1]),
                         .p_theta = sign_of(k) * 1.0,
                         .p_phi = 0.7 * between(-r, r, u[3]) * sin(theta),
                         .radial_sign = 0,
                         .p_r = p_r});
}

PhaseState<double> in_the_equator(const Spacetime& home, std::int64_t k, double x1, double low, double high) {
  const auto u = even_numbers(k);
  return at_some_energy(
      departed(home,
               {.x1 = x1, .theta = equator, .phi = even_phi(u[1]), .p_phi = sign_of(k) * between(low, high, u[2])}),
      k);
}

PhaseState<double> outgoing(const Spacetime& home, std::int64_t k, double low, double high, double most_b) {
  const auto u = even_numbers(k);
  Departing start = aimed(between(low, high, u[4]), even_theta(u[0], 0.92), even_phi(u[1]), most_b * u[2], u[3]);
  start.radial_sign = 1;
  return departed(home, start);
}

PhaseState<double> camera(const Spacetime& home, std::int64_t k, double inclination, double half_width) {
  const auto u = even_numbers(k);
  return camera_ray(home, inclination, even_phi(u[1]), between(-half_width, half_width, u[2]),
                    between(-half_width, half_width, u[3]));
}

// Constants of a spherical photon orbit of Kerr, a little more or less of each: the ray winds and leaves, or falls in.
// xi and eta of the orbit at r as in [Teo2003].
PhaseState<double> near_critical_kerr(const Spacetime& home, std::int64_t k) {
  const auto u = even_numbers(k);
  const double M = parameter_of(home, "M", 1.0), a = parameter_of(home, "a", 0.0);
  const double prograde = kerr_exact::photon_orbit_radius(M, a, kerr_exact::Sense::prograde).value;
  const double retrograde = kerr_exact::photon_orbit_radius(M, a, kerr_exact::Sense::retrograde).value;
  const double r = between(prograde, retrograde, between(0.02, 0.98, u[2]));
  const double xi = -(r * r * (r - 3.0 * M) + a * a * (r + M)) / (a * (r - M));
  const double eta = r * r * r * (4.0 * a * a * M - r * square(r - 3.0 * M)) / square(a * (r - M));
  const double off = 1.0 + sign_of(k) * std::array{1e-2, 1e-3, 1e-4, 1e-5, 1e-6}[static_cast<std::size_t>(k / 2 % 5)];
  return departed(home, {.x1 = 50.0 * M,
                         .theta = equator,
                         .phi = even_phi(u[1]),
                         .p_theta = (u[3] < 0.5 ? off : -off) * std::sqrt(std::fmax(eta, 0.0)),
                         .p_phi = off * xi});
}

PhaseState<double> near_critical_ellis(const Spacetime& home, std::int64_t k) {
  const auto u = even_numbers(k);
  const double off = 1.0 + sign_of(k) * std::array{1e-2, 1e-3, 1e-4, 1e-5, 1e-6}[static_cast<std::size_t>(k / 2 % 5)];
  return departed(home, aimed(20.0, even_theta(u[0], 0.92), even_phi(u[1]), off, u[3]));
}

// Next to the horizon of a hole that turns almost as fast as it can, going out with the rotation.
PhaseState<double> near_extremal(const Spacetime& home, std::int64_t k) {
  const auto u = even_numbers(k);
  const double horizon = home.horizon_radius().value();
  Departing start{.x1 = horizon * between(1.02, 1.4, u[2]),
                  .theta = even_theta(u[0], 0.4),
                  .phi = even_phi(u[1]),
                  .p_theta = between(-0.4, 0.4, u[3]),
                  .p_phi = between(-1.0, 1.8, u[4]),
                  .radial_sign = 1};
  return departed(home, start);
}

PhaseState<double> at_the_lens(const Spacetime& home, std::int64_t k, double low, double high) {
  const auto u = even_numbers(k);
  const double sine = between(low, high, u[2]) / 2.0;
  return medium_ray(home, 2.0, even_theta(u[0], 1.0), even_phi(u[1]),
                    atan2(sine, std::sqrt((1.0 - sine) * (1.0 + sine))), u[3]);
}

PhaseState<double> inside_the_medium(const Spacetime& home, std::int64_t k, double low, double high) {
  const auto u = even_numbers(k);
  return medium_ray(home, between(low, high, u[2]), even_theta(u[0], 1.0), even_phi(u[1]),
                    std::numbers::pi * between(0.05, 0.95, u[4]), u[3]);
}

using Home = const Spacetime&;
using Index = std::int64_t;

std::vector<ChallengeSet> flat_and_schwarzschild() {
  return {{.id = "flat",
           .title = "flat space in its spherical chart: straight lines, the axis crossed and grazed",
           .metric = "minkowski",
           .parameters = {},
           .home_chart = "spherical",
           .r_max = 50.0,
           .families = {{"incoming", "from r = 20, passing the centre at b = 0.1 to 15",
                         [](Home h, Index k) { return incoming(h, k, 20.0, 0.1, 15.0); }},
                        {"backwards", "the same, backwards in time",
                         [](Home h, Index k) { return incoming_past(h, k, 20.0, 0.1, 15.0); }},
                        {"axis", "through the axis: L = 0",
                         [](Home h, Index k) { return over_the_axis(h, k, 20.0, 1.0, 15.0); }},
                        {"near-axis", "past the axis at L = 1e-3, 1e-2, 1e-1",
                         [](Home h, Index k) { return close_to_the_axis(h, k, 20.0, 1.0, 15.0); }},
                        {"tangent", "from the turning point, p_r = 0",
                         [](Home h, Index k) { return tangent(h, k, 2.0, 20.0, 0.0); }}}},
          {.id = "schwarzschild-core",
           .title = "Schwarzschild: scattering, capture, a camera, the equator, light from near the hole",
           .metric = "schwarzschild",
           .parameters = {{"M", 1.0}},
           .home_chart = "areal",
           .r_max = 100.0,
           .captures = true,
           .families = {{"scattered", "from r = 50 M with b = 5.5 to 15 M",
                         [](Home h, Index k) { return incoming(h, k, 50.0, 5.5, 15.0); }},
                        {"captured", "from r = 50 M with b = 0 to 5 M",
                         [](Home h, Index k) { return incoming(h, k, 50.0, 0.0, 5.0); }},
                        {"camera", "a screen of +-12 M at r = 50 M and 60 degrees, traced back in time",
                         [](Home h, Index k) { return camera(h, k, std::numbers::pi / 3.0, 12.0); }},
                        {"equatorial", "in the equator from r = 50 M with |b| = 5.5 to 15 M",
                         [](Home h, Index k) { return in_the_equator(h, k, 50.0, 5.5, 15.0); }},
                        {"outgoing", "from r = 2.5 M to 8 M outwards, b up to 4 M",
                         [](Home h, Index k) { return outgoing(h, k, 2.5, 8.0, 4.0); }}}}};
}

std::vector<ChallengeSet> kerr_sets() {
  return {{.id = "kerr-core",
           .title = "Kerr, a = 0.9 M: two cameras, scattering, capture, the equator, light from near the hole",
           .metric = "kerr",
           .parameters = {{"M", 1.0}, {"a", 0.9}},
           .home_chart = "boyer-lindquist",
           .r_max = 100.0,
           .captures = true,
           .families = {{"camera", "a screen of +-12 M at r = 50 M and 60 degrees, traced back in time",
                         [](Home h, Index k) { return camera(h, k, std::numbers::pi / 3.0, 12.0); }},
                        {"camera-edge", "the same seen from the equator, 90 degrees",
                         [](Home h, Index k) { return camera(h, k, equator, 12.0); }},
                        {"scattered", "from r = 50 M with b = 7.3 to 15 M",
                         [](Home h, Index k) { return incoming(h, k, 50.0, 7.3, 15.0); }},
                        {"captured", "from r = 50 M with b = 0 to 2.5 M",
                         [](Home h, Index k) { return incoming(h, k, 50.0, 0.0, 2.5); }},
                        {"equatorial", "in the equator from r = 50 M with |b| = 7.3 to 15 M, either way around",
                         [](Home h, Index k) { return in_the_equator(h, k, 50.0, 7.3, 15.0); }},
                        {"outgoing", "from r = 3 M to 8 M outwards, b up to 2.5 M",
                         [](Home h, Index k) { return outgoing(h, k, 3.0, 8.0, 2.5); }}}},
          {.id = "kerr-hard",
           .title = "Kerr, a = 0.999 M: poles, near-critical, near-extremal and tangent rays",
           .metric = "kerr",
           .parameters = {{"M", 1.0}, {"a", 0.999}},
           .home_chart = "boyer-lindquist",
           .r_max = 100.0,
           .captures = true,
           .families = {{"pole", "over the poles: L = 0, b = 5.2 to 12 M",
                         [](Home h, Index k) { return over_the_axis(h, k, 50.0, 5.2, 12.0); }},
                        {"near-pole", "past the poles at L = 1e-3, 1e-2, 1e-1 M",
                         [](Home h, Index k) { return close_to_the_axis(h, k, 50.0, 5.2, 12.0); }},
                        {"camera-pole", "a screen of +-12 M at r = 50 M and 2 degrees, traced back in time",
                         [](Home h, Index k) { return camera(h, k, std::numbers::pi / 90.0, 12.0); }},
                        {"near-critical", "constants of a spherical photon orbit times 1 +- 1e-2 ... 1e-6",
                         [](Home h, Index k) { return near_critical_kerr(h, k); }},
                        {"near-extremal", "from 1.02 to 1.4 horizon radii outwards",
                         [](Home h, Index k) { return near_extremal(h, k); }},
                        // At p_r = 0 itself the light cone fixes p_r to 1e-8 only: its square is round-off.
                        {"tangent", "from just before the turning point, p_r = -1e-3, at r = 8 to 20 M",
                         [](Home h, Index k) { return tangent(h, k, 8.0, 20.0, -1e-3); }}}}};
}

std::vector<ChallengeSet> other_sets() {
  return {{.id = "ellis-core",
           .title = "Ellis wormhole: past the throat, through it, over the axis, near-critical",
           .metric = "ellis",
           .parameters = {{"b0", 1.0}},
           .home_chart = "proper-distance",
           .r_max = 40.0,
           .families = {{"scattered", "from l = 20 b0 with b = 1.05 to 6 b0: back to the same side",
                         [](Home h, Index k) { return incoming(h, k, 20.0, 1.05, 6.0); }},
                        {"through", "with b = 0 to 0.95 b0: out on the other side",
                         [](Home h, Index k) { return incoming(h, k, 20.0, 0.0, 0.95); }},
                        {"backwards", "b = 0 to 6 b0, backwards in time",
                         [](Home h, Index k) { return incoming_past(h, k, 20.0, 0.0, 6.0); }},
                        {"axis", "over the axis: L = 0, b = 1.2 to 6 b0",
                         [](Home h, Index k) { return over_the_axis(h, k, 20.0, 1.2, 6.0); }},
                        {"near-critical", "b = b0 times 1 +- 1e-2 ... 1e-6",
                         [](Home h, Index k) { return near_critical_ellis(h, k); }}}},
          {.id = "grin-core",
           .title = "Luneburg's lens: rays through it, past it and from inside",
           .metric = "luneburg",
           .parameters = {{"R", 1.0}},
           .home_chart = "cartesian",
           .r_max = 4.0,
           .families = {{"through", "from |x| = 2 R, aimed to pass the centre at 0.02 to 0.98 R",
                         [](Home h, Index k) { return at_the_lens(h, k, 0.02, 0.98); }},
                        {"past", "missing the lens, at 1.02 to 1.8 R",
                         [](Home h, Index k) { return at_the_lens(h, k, 1.02, 1.8); }},
                        {"inside", "from inside, |x| = 0.1 to 0.9 R",
                         [](Home h, Index k) { return inside_the_medium(h, k, 0.1, 0.9); }}}},
          {.id = "grin-fisheye",
           .title = "Maxwell's fish-eye: every ray a circle",
           .metric = "maxwell-fisheye",
           .parameters = {{"R", 1.0}},
           .home_chart = "cartesian",
           .r_max = 1.0,
           .families = {{"inside", "from |x| = 0.15 to 0.75 R to the rim at |x| = R",
                         [](Home h, Index k) { return inside_the_medium(h, k, 0.15, 0.75); }}}}};
}

std::vector<ChallengeSet> all_sets() {
  std::vector<ChallengeSet> sets;
  for (auto* part : {&flat_and_schwarzschild, &kerr_sets, &other_sets}) {
    for (ChallengeSet& set : part()) sets.push_back(std::move(set));
  }
  for (std::size_t k = 0; k < sets.size(); ++k) sets[k].first_id = static_cast<std::int64_t>(k + 1) * ids_of_a_set;
  return sets;
}

}  // namespace

std::unique_ptr<Spacetime> ChallengeSet::spacetime(std::string_view chart) const {
  return make_spacetime(metric, chart, parameters);
}

ChallengeRay ChallengeSet::ray(const Spacetime& home, std::int64_t k) const {
  const auto kinds = static_cast<std::int64_t>(families.size());
  const std::int64_t family = k % kinds;
  const PhaseState<double> start = families[static_cast<std::size_t>(family)].start(home, k / kinds);
  return {.ray = {.id = first_id + k, .start = start, .sheet = 1}, .family = family};
}

Ray ChallengeSet::ray_in(const Spacetime& chart, const Spacetime& home, std::int64_t k) const {
  const ChallengeRay start = ray(home, k);
  const ChartState there = change_chart(home, chart, start.ray.start, start.ray.sheet);
  return {.id = start.ray.id, .start = on_the_cone_again(chart, there.state), .sheet = there.sheet};
}

const std::vector<ChallengeSet>& challenge_sets() {
  static const std::vector<ChallengeSet> sets = all_sets();
  return sets;
}

const ChallengeSet& challenge_set(std::string_view id) {
  std::vector<std::string_view> known;
  for (const ChallengeSet& set : challenge_sets()) {
    if (set.id == id) return set;
    known.push_back(set.id);
  }
  const std::string near = nearest_name(id, known);
  throw std::invalid_argument(near.empty() ? fmt::format("unknown set '{}'; there are {}", id, fmt::join(known, ", "))
                                           : fmt::format("unknown set '{}'; did you mean '{}'?", id, near));
}

const ChallengeSet* set_of_id(std::int64_t id) {
  for (const ChallengeSet& set : challenge_sets()) {
    if (id >= set.first_id && id < set.first_id + ids_of_a_set) return &set;
  }
  return nullptr;
}

}  // namespace xpr
