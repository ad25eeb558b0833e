#include "validation/bundle.hpp"

#include <cmath>
#include <numbers>

#include "metrics/medium_exact.hpp"
#include "metrics/scalar/elementary.hpp"
#include "validation/convergence.hpp"
#include "validation/kit.hpp"

namespace xpr {

namespace {

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double norm(const std::array<double, 3>& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

std::array<double, 3> normalised(std::array<double, 3> a) {
  const double length = norm(a);
  for (double& component : a) component /= length;
  return a;
}

medium_exact::Vector position(const PhaseState<double>& y) { return {y[1], y[2], y[3]}; }
medium_exact::Vector momentum(const PhaseState<double>& y) { return {y[5], y[6], y[7]}; }

/// Where a ray of the fish-eye of radius 1 is at an affine parameter between 0 and `turn`, one turn: its optical path
/// by bisection of Kepler's equation, then the closed form.
PhaseState<double> fisheye_state(const PhaseState<double>& start, double lambda) {
  double low = 0.0, high = 2.0 * std::numbers::pi;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    const double at = medium_exact::fisheye_affine_parameter(1.0, position(start), momentum(start), middle).value;
    (at < lambda ? low : high) = middle;
  }
  const double path = 0.5 * (low + high);
  const medium_exact::RayPoint there = medium_exact::fisheye_ray(1.0, position(start), momentum(start), path);
  PhaseState<double> y;
  y[0] = path;
  y[4] = start[4];
  for (std::size_t k = 0; k < 3; ++k) {
    y[1 + k] = there.position[k];
    y[5 + k] = there.momentum[k];
  }
  return y;
}

}  // namespace

std::uint64_t SeededNumbers::next() {
  state_ += 0x9e3779b97f4a7c15U;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

double SeededNumbers::uniform(double low, double high) {
  const double unit = static_cast<double>(next() >> 11U) * 0x1p-53;
  return low + (high - low) * unit;
}

std::array<double, 3> SeededNumbers::direction() {
  while (true) {
    const std::array<double, 3> v = {uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
    const double length = norm(v);
    if (length > 1.0 || length < 0.1) continue;
    return {v[0] / length, v[1] / length, v[2] / length};
  }
}

Flow Bundle::flow() const {
  return [spacetime = chart.get()](const PhaseState<double>& y) { return spacetime->flow(y); };
}

Bundle fisheye_orbits(const Lab& lab, int rays, FisheyePath path, double R) {
  Bundle bundle;
  const NamedValue radius{"R", R};
  bundle.chart = lab.spacetime("maxwell-fisheye", "cartesian", {&radius, 1});
  bundle.length_unit = R;
  // Lengths and affine parameters scale with R; n and p do not depend on it.
  const auto scaled = [R](PhaseState<double> y) {
    for (std::size_t mu = 0; mu < 4; ++mu) y[mu] *= R;
    return y;
  };
  SeededNumbers seeded(0x1854);  // the year of Maxwell's fish-eye
  for (int i = 0; i < rays; ++i) {
    const std::array<double, 3> radial = seeded.direction();
    const std::array<double, 3> across = normalised(cross(radial, seeded.direction()));
    const double r = seeded.uniform(0.45, 0.75);
    const double cosine = seeded.uniform(-0.5, 0.5);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double n = 2.0 / (1.0 + r * r);
    const double L = r * n * sine;
    PhaseState<double> y;
    y[4] = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      y[1 + k] = r * radial[k];
      y[5 + k] = n * (cosine * radial[k] + sine * across[k]);
    }
    // Arithmetic only: what goes into transport must have the same bits everywhere.
    const double turn = 2.0 * pi<double>() / (L * L * L);
    bundle.starts.push_back(scaled(y));
    if (path == FisheyePath::closed) {
      bundle.spans.push_back(R * turn);
      y[0] = 2.0 * pi<double>();
      bundle.ends.push_back(scaled(y));
    } else {
      bundle.spans.push_back(R * (0.45 * turn));
      bundle.ends.push_back(scaled(fisheye_state(y, 0.45 * turn)));
    }
  }
  // The start's own rounding leaves |p| = n to 2e-16 and lambda to 2e-16 of a turn.
  bundle.truth_error = 2e-15;
  return bundle;
}

Bundle luneburg_rays(const Lab& lab, int rays, double R) {
  Bundle bundle;
  const NamedValue radius{"R", R};
  bundle.chart = lab.spacetime("luneburg", "cartesian", {&radius, 1});
  bundle.length_unit = R;
  SeededNumbers seeded(0x1944);  // the year of Luneburg's lectures
  for (int i = 0; i < rays; ++i) {
    const std::array<double, 3> along = normalised(seeded.direction());
    const std::array<double, 3> across = normalised(cross(along, seeded.direction()));
    const double height = seeded.uniform(0.1, 0.9);
    const double rim = std::sqrt(1.0 - height * height);
    medium_exact::Vector entry{};
    PhaseState<double> start;
    start[4] = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      start[1 + k] = R * (height * across[k] - 2.0 * along[k]);
      start[5 + k] = along[k];
      entry[k] = R * (height * across[k] - rim * along[k]);
    }
    // Outside |p| = 1, so that lambda is the length.
    const double quarter = 0.5 * pi<double>() * R;
    const medium_exact::RayPoint focus = medium_exact::luneburg_ray(R, entry, along, quarter);
    PhaseState<double> end;
    end[0] = R * (2.0 - rim) + medium_exact::luneburg_optical_path(R, entry, along, quarter).value;
    end[4] = start[4];
    for (std::size_t k = 0; k < 3; ++k) {
      end[1 + k] = focus.position[k];
      end[5 + k] = focus.momentum[k];
    }
    bundle.starts.push_back(start);
    bundle.spans.push_back(R * (2.0 - rim) + quarter);
    bundle.ends.push_back(end);
  }
  // Round-off of the start, of the entry point and of the length in vacuum: a unit each on components below 3 R.
  bundle.truth_error = 2e-15;
  return bundle;
}

Bundle kerr_rays(const Lab& lab, int rays, KerrHole hole) {
  Bundle bundle;
  const std::array<NamedValue, 2> values = {NamedValue{"M", hole.mass}, NamedValue{"a", hole.spin}};
  bundle.chart = lab.spacetime("kerr", "kerr-schild", values);
  bundle.length_unit = hole.mass;
  const std::unique_ptr<Spacetime> classical = lab.spacetime("kerr", "boyer-lindquist", values);
  SeededNumbers seeded(0x1963);  // the year of Kerr's solution
  for (int i = 0; i < rays; ++i) {
    const double theta = seeded.uniform(0.9, 2.2);
    const double total = hole.mass * seeded.uniform(6.3, 7.5);  // |L| / E, above the critical one of these rays
    const double along = seeded.uniform(-0.3, 0.9);             // L_z / |L|
    const double L = total * along * sin(theta);
    const double p_theta = total * std::sqrt(1.0 - along * along) * (i % 2 == 0 ? 1.0 : -1.0);
    bundle.starts.push_back(general_light(*classical, *bundle.chart, 15.0 * hole.mass, theta, L, p_theta).state);
    bundle.spans.push_back(30.0 * hole.mass);
  }
  return bundle;
}

Bundle kerr_scattering(const Lab& lab, int rays, KerrHole hole) {
  Bundle bundle = kerr_rays(lab, rays, hole);
  // The real steppers, never planted ones, and flows of the Lab's spacetime: grades steppers only.
  const Flow flow = bundle.flow();
  std::vector<PhaseState<double>> other;
  for (std::size_t i = 0; i < bundle.starts.size(); ++i) {
    bundle.ends.push_back(walk(*make_stepper("dop853", flow, {}), bundle.starts[i], bundle.spans[i], 600).y);
    other.push_back(walk(*make_stepper("gl6", flow, {}), bundle.starts[i], bundle.spans[i], 1500).y);
  }
  bundle.truth_error = distance(spatial_components(bundle.ends), spatial_components(other));
  return bundle;
}

Walk walk(Stepper& stepper, const PhaseState<double>& start, double span, std::int64_t steps) {
  Walk out{start, true};
  const double h = span / static_cast<double>(steps);
  for (std::int64_t i = 0; i < steps; ++i) {
    const StepOutcome outcome = stepper.step(out.y, h);
    out.y = outcome.y;
    out.converged = out.converged && outcome.converged;
  }
  return out;
}

std::vector<double> spatial_components(const std::vector<PhaseState<double>>& states) {
  std::vector<double> out;
  for (const PhaseState<double>& y : states) out.insert(out.end(), {y[1], y[2], y[3], y[5], y[6], y[7]});
  return out;
}

}  // namespace xpr
