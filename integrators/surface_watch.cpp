#include "integrators/surface_watch.hpp"

#include <algorithm>
#include <array>

#include "integrators/flow_stepper.hpp"
#include "integrators/path_watch.hpp"
#include "integrators/root.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

[[nodiscard]] int sign_of(double g) { return g > 0.0 ? 1 : g < 0.0 ? -1 : 0; }

/// Whether events must be located by repeating the step shorter: the interpolant is of lower order than the method.
[[nodiscard]] bool repeats_steps(const MethodCard& card) { return card.dense_order < card.order - 1; }

}  // namespace

double SurfaceWatch::value(std::size_t i, const Spacetime& chart, const PhaseState<double>& y, int sheet) const {
  const Surface& s = surfaces_[i];
  switch (s.kind) {
    case SurfaceKind::radius:
      return chart.radius(y.x()) - s.level;
    case SurfaceKind::proper_distance:
      return chart.proper_distance(y.x(), sheet).value_or(unbounded) - s.level;
    case SurfaceKind::interface:
      return chart.interface_distance(y.x()).value_or(unbounded);
    case SurfaceKind::half_plane:
      return y[2];
    case SurfaceKind::event:
      break;
  }
  return s.event->g(chart, y, sheet);
}

void SurfaceWatch::restart(std::optional<double> r_max) {
  for (Surface& surface : surfaces_) {
    surface.side = 0;
    if (r_max && surface.kind == SurfaceKind::radius && surface.status == Status::escaped) surface.level = *r_max;
  }
}

void SurfaceWatch::begin(const Spacetime& chart, const PhaseState<double>& y, int sheet) {
  g_begin_.resize(surfaces_.size());
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    g_begin_[i] = value(i, chart, y, sheet);
    if (surfaces_[i].side == 0) surfaces_[i].side = sign_of(g_begin_[i]);
  }
}

std::span<const Crossing> SurfaceWatch::crossings(const StepPath& path, std::uint32_t far) {
  found_.clear();
  if (surfaces_.empty()) return {};
  g_before_ = g_begin_;
  sides_before_.resize(surfaces_.size());
  for (std::size_t i = 0; i < surfaces_.size(); ++i) sides_before_[i] = surfaces_[i].side;
  const PhaseState<double> middle = path.stepper.interpolate_coarse(0.5);
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const bool known_far = i < 32 && ((far >> i) & 1U) != 0;
    if (!known_far) search(i, path, middle);
  }

  std::stable_sort(found_.begin(), found_.end(),
                   [](const Crossing& a, const Crossing& b) { return a.theta < b.theta; });
  const auto last = std::find_if(found_.begin(), found_.end(), [&](const Crossing& crossing) {
    return surfaces_[crossing.surface].terminal || surfaces_[crossing.surface].cuts;
  });
  const bool cut = last != found_.end();
  if (cut) found_.erase(last + 1, found_.end());

  if (!found_.empty() && repeats_steps(path.stepper.card())) {
    // The stepper's memory must be of the step that counts.
    const StepOutcome repeated = path.stepper.step(path.begin, cut ? found_.back().theta * path.h : path.h);
    if (cut) found_.back().y = repeated.y;
  }
  const PhaseState<double>& end = cut ? found_.back().y : path.end;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    g_begin_[i] = value(i, path.chart, end, path.sheet);
    const bool on_surface = cut && found_.back().surface == i;
    if (!on_surface && sign_of(g_begin_[i]) != 0) surfaces_[i].side = sign_of(g_begin_[i]);
  }
  if (cut) surfaces_[found_.back().surface].side = found_.back().direction;
  return found_;
}

void SurfaceWatch::take_back() {
  g_begin_ = g_before_;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) surfaces_[i].side = sides_before_[i];
}

void SurfaceWatch::search(std::size_t i, const StepPath& path, const PhaseState<double>& middle) {
  const double g_end = value(i, path.chart, path.end, path.sheet);
  const double g_middle = value(i, path.chart, middle, path.sheet);
  if (surfaces_[i].kind == SurfaceKind::interface) {
    // g is a distance, of whatever is nearest: what lies between may be met and left unseen from both ends.
    const double side = static_cast<double>(surfaces_[i].side);
    if (out_of_reach(
            side * g_begin_[i], side * g_end,
            path_length_bound(path.h, path.begin, path.stepper.begin_rate(), path.end, path.stepper.end_rate()))) {
      return;
    }
  } else {
    // Far away: one sign, and further off than g varies over the step.
    const auto [low, high] = std::minmax({g_begin_[i], g_middle, g_end});
    if ((low > 0.0 && low > high - low) || (high < 0.0 && -high > high - low)) return;
  }

  const double theta_first = end_fraction(path.begin, path.stepper.begin_rate(), path.h);
  const double theta_last = 1.0 - end_fraction(path.end, path.stepper.end_rate(), path.h);
  std::array<Sample, 7> samples{
      {{0.0, g_begin_[i]}, {theta_first, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}, {theta_last, 0}, {1.0, g_end}}};
  for (std::size_t k = 1; k < 6; ++k) samples[k].g = value(i, path.chart, path.at(samples[k].theta), path.sheet);

  // The side is known from before: at a step that begins on the surface the sign of g is round-off.
  int side = surfaces_[i].side;
  if (side != 0 && sign_of(samples[0].g) != side) samples[0].g = side * 1e-300;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const int sign = sign_of(samples[k].g);
    if (sign == 0) continue;
    if (side != 0 && sign != side) {
      Sample from = samples[k - 1];
      if (from.g == 0.0) from.g = side * 1e-300;
      locate(i, path, from, samples[k]);
    } else if (side != 0 && k + 1 < samples.size() && sign_of(samples[k + 1].g) == side &&
               abs(samples[k].g) <= abs(samples[k - 1].g) && abs(samples[k].g) <= abs(samples[k + 1].g)) {
      const double toward = static_cast<double>(side);
      const auto g = [&](double theta) { return toward * value(i, path.chart, path.at(theta), path.sheet); };
      const double theta = dip_below_zero(g, samples[k - 1].theta, samples[k + 1].theta);
      if (theta > samples[k - 1].theta) {
        const Sample bottom{theta, toward * g(theta)};
        locate(i, path, samples[k - 1], bottom);
        locate(i, path, bottom, samples[k + 1]);
      }
    }
    side = sign;
  }
}

void SurfaceWatch::locate(std::size_t i, const StepPath& path, Sample from, Sample to) {
  const bool rises = to.g > from.g;
  const int direction = surfaces_[i].direction;
  if (direction != 0 && (direction > 0) != rises) return;
  if (!repeats_steps(path.stepper.card())) {
    const auto g = [&](double theta) { return value(i, path.chart, path.at(theta), path.sheet); };
    add_crossing(i, path, bracketed_root(g, from.theta, to.theta, from.g, to.g), rises);
    return;
  }
  const auto g = [&](double theta) {
    return value(i, path.chart, path.stepper.step(path.begin, theta * path.h).y, path.sheet);
  };
  const double g_from = from.theta == 0.0 ? from.g : g(from.theta);
  const double g_to = to.theta == 1.0 ? to.g : g(to.theta);
  if ((g_from < 0.0) == (g_to < 0.0)) {
    (void)path.stepper.step(path.begin, path.h);  // the method itself does not meet the surface here
    return;
  }
  const double theta = bracketed_root(g, from.theta, to.theta, g_from, g_to);
  const PhaseState<double> y = path.stepper.step(path.begin, theta * path.h).y;
  (void)path.stepper.step(path.begin, path.h);
  found_.push_back({i, theta, rises ? 1 : -1, y});
}

void SurfaceWatch::add_crossing(std::size_t i, const StepPath& path, double theta, bool rises) {
  found_.push_back({i, theta, rises ? 1 : -1, path.at(theta)});
}

double SurfaceWatch::end_fraction(const PhaseState<double>& y, const PhaseState<double>& rate, double h) const {
  // So short that the ray is straight over it, so long that the change of g stands out of round-off.
  constexpr double relative_move = 1e-5;
  double fraction = 1.0 / 1024.0;
  for (std::size_t mu = 1; mu < 4; ++mu) {
    const double move = abs(h * rate[mu]);
    const double allowed = relative_move * (length_unit_ + abs(y[mu]));
    if (move * fraction > allowed) fraction = allowed / move;
  }
  return fraction;
}

}  // namespace xpr
