// A batch of rays W at a time: see batch_tracer.hpp.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "integrators/batch_tracer.hpp"
#include "integrators/lane_kernel.hpp"
#include "integrators/path_watch.hpp"
#include "integrators/ray_trace.hpp"
#include "integrators/step_control.hpp"

namespace xpr {

template <int W>
class LaneBatch {
 public:
  /// `kernel` is that of the settings' method.
  /// `things` may be null.
  LaneBatch(const Spacetime& spacetime, const TraceSettings& settings, std::unique_ptr<LaneKernel<W>> kernel,
            PathWatch* things);

  void trace(std::span<const BatchRay> rays, std::span<RayEnd> ends);

 private:
  using T = Pack<W>;
  using M = Mask<W>;
  static constexpr auto lane_count = static_cast<std::size_t>(W);

  /// A stop or another surface, in lanes: only those of radius and the half-plane of windings are.
  struct LaneSurface {
    SurfaceKind kind;
    Status status;
    int direction;
    T level{};
    T side{};      ///< +1, -1, or 0 where the ray has been on it only
    T windings{};  ///< of the step under way, for the half-plane
    M far{};       ///< it is not met on the step under way
  };

  // Between the lanes and the ray that each holds.
  void take_next(int i);
  void take_up(int i, const PhaseState<double>& rate);
  void set_scale(int i);
  void put_back(int i);
  void finish(int i, Status status);
  void look_closer(int i);

  // In all lanes.
  void attempt();
  [[nodiscard]] M control_step(const M& numbers);
  [[nodiscard]] M uneventful(const LaneProbe<W>& probe, const M& good);
  [[nodiscard]] M far_from_things(const M& asked) const;
  [[nodiscard]] M far_from_radius(const LaneSurface& surface, const LaneProbe<W>& probe) const;
  void pass_half_plane(LaneSurface& surface) const;
  void commit(const M& quiet, const LaneProbe<W>& probe, const T& rest);
  void end_spent();

  const Spacetime& spacetime_;
  const TraceSettings& settings_;
  MethodCard method_;
  std::unique_ptr<LaneKernel<W>> kernel_;
  PathWatch* things_;
  bool lanes_see_all_ = true;  ///< no surface, projection or the like that only the scalar code knows
  std::vector<std::unique_ptr<RayTrace>> alone_;
  std::vector<LaneSurface> surfaces_;

  std::span<const BatchRay> rays_;
  std::span<RayEnd> ends_;
  std::size_t next_ = 0;
  std::array<std::size_t, lane_count> index_{};
  std::array<int, lane_count> sheet_{};

  M active_;
  LaneStart<W> now_;
  LaneEnd<W> step_;
  CompensatedSum<T> lambda_;
  T h_next_, h_first_, steps_, rejected_, radius_, radial_rate_, interface_, residual_, residual_max_, windings_;
  StepMemory<T> last_;
  M last_rejected_;
};

// Definitions.

template <int W>
LaneBatch<W>::LaneBatch(const Spacetime& spacetime, const TraceSettings& settings,
                        std::unique_ptr<LaneKernel<W>> kernel, PathWatch* things)
    : spacetime_(spacetime),
      settings_(settings),
      method_(method_card(settings.method)),
      kernel_(std::move(kernel)),
      things_(things),
      lanes_see_all_(settings.projection == Projection::none),
      now_{.chart = *spacetime.lane_charts().template of_width<W>()} {
  for (int i = 0; i < W; ++i) {
    alone_.push_back(std::make_unique<RayTrace>(spacetime, settings));
    alone_.back()->keep_stepper();
    alone_.back()->look_for(things_);
  }
  SurfaceWatch& watch = alone_.front()->watch();
  for (std::size_t s = 0; s < watch.size(); ++s) {
    surfaces_.push_back(
        {.kind = watch.surface(s).kind, .status = watch.surface(s).status, .direction = watch.surface(s).direction});
    lanes_see_all_ =
        lanes_see_all_ && (surfaces_[s].kind == SurfaceKind::radius || surfaces_[s].kind == SurfaceKind::interface ||
                           surfaces_[s].kind == SurfaceKind::half_plane);
  }
}

template <int W>
void LaneBatch<W>::trace(std::span<const BatchRay> rays, std::span<RayEnd> ends) {
  rays_ = rays;
  ends_ = ends;
  next_ = 0;
  for (int i = 0; i < W; ++i) take_next(i);
  while (any(active_)) attempt();
}

/// Sets out with the next ray that does not end where it begins.
template <int W>
void LaneBatch<W>::take_next(int i) {
  const auto place = static_cast<std::size_t>(i);
  RayTrace& ray = *alone_[place];
  while (next_ < rays_.size()) {
    index_[place] = next_++;
    const BatchRay& start = rays_[index_[place]];
    std::optional<Status> status = ray.begin(start.start, start.sheet, start.r_max, index_[place]);
    if (!status) status = ray.spent();
    if (status) {
      ends_[index_[place]] = ray.end(*status);
      continue;
    }
    const RayProgress& at = ray.progress();
    const bool sided = has_interface(spacetime_);
    set_lane(active_, i, true);
    set_scale(i);
    take_up(i, sided ? spacetime_.flow_of_side(at.y, at.inside_interface) : ray.first_rate());
    return;
  }
  set_lane(active_, i, false);
  set_lane(h_next_, i, 0.0);
}

/// From the ray, at a point where the flow is `rate`, into the lane.
template <int W>
void LaneBatch<W>::take_up(int i, const PhaseState<double>& rate) {
  RayTrace& ray = *alone_[static_cast<std::size_t>(i)];
  const RayProgress& at = ray.progress();
  set_lane_of<W>(now_.y, i, at.y);
  set_lane_of<W>(now_.rate, i, rate);
  set_lane(now_.inside, i, at.inside_interface);
  set_lane(lambda_.sum, i, at.lambda.sum);
  set_lane(lambda_.rest, i, at.lambda.rest);
  set_lane(h_next_, i, at.h);
  set_lane(h_first_, i, at.h_first);
  set_lane(last_.h, i, at.last.h);
  set_lane(last_.error, i, at.last.error);
  set_lane(last_rejected_, i, at.last_rejected);
  set_lane(steps_, i, static_cast<double>(at.steps));
  set_lane(rejected_, i, static_cast<double>(at.rejected));
  set_lane(residual_, i, at.null_residual);
  set_lane(residual_max_, i, at.null_residual_max);
  set_lane(windings_, i, static_cast<double>(at.windings));
  PhaseState<Pack<1>> here, along;
  set_lane_of<1>(here, 0, at.y);
  set_lane_of<1>(along, 0, rate);
  const LaneProbe<1> probe = spacetime_.lane_charts().one->probe(here, along, {ray.sheet()});
  set_lane(radius_, i, lane(probe.radius, 0));
  set_lane(radial_rate_, i, lane(probe.radial_rate, 0));
  set_lane(interface_, i, lane(probe.interface, 0));
  sheet_[static_cast<std::size_t>(i)] = ray.sheet();
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    set_lane(surfaces_[s].level, i, ray.watch().surface(s).level);
    set_lane(surfaces_[s].side, i, static_cast<double>(ray.watch().surface(s).side));
  }
}

template <int W>
void LaneBatch<W>::set_scale(int i) {
  const PhaseState<double>& y = alone_[static_cast<std::size_t>(i)]->progress().y;
  const ErrorScale scale = error_scale(spacetime_, y, settings_);
  for (std::size_t k = 0; k < 8; ++k) set_lane(now_.scale.absolute[k], i, scale.absolute[k]);
  now_.scale.relative = scale.relative;
}

/// From the lane into the ray, as it stood before the step.
template <int W>
void LaneBatch<W>::put_back(int i) {
  RayTrace& ray = *alone_[static_cast<std::size_t>(i)];
  RayProgress& at = ray.progress();
  at.y = lane_of<W>(now_.y, i);
  at.lambda = {lane(lambda_.sum, i), lane(lambda_.rest, i)};
  at.h = lane(h_next_, i);
  at.last = {lane(last_.h, i), lane(last_.error, i)};
  at.last_rejected = lane(last_rejected_, i);
  at.steps = static_cast<std::int64_t>(lane(steps_, i));
  at.windings = static_cast<int>(lane(windings_, i));
  at.rejected = static_cast<std::int64_t>(lane(rejected_, i));
  at.null_residual = lane(residual_, i);
  at.null_residual_max = lane(residual_max_, i);
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    double g = at.y[2];
    if (surfaces_[s].kind == SurfaceKind::radius) g = lane(radius_, i) - lane(surfaces_[s].level, i);
    if (surfaces_[s].kind == SurfaceKind::interface) g = lane(interface_, i);
    ray.watch().take_up(s, g, static_cast<int>(lane(surfaces_[s].side, i)));
  }
}

/// The lane's ray, put back, has ended in this chart.
template <int W>
void LaneBatch<W>::finish(int i, Status status) {
  const auto place = static_cast<std::size_t>(i);
  RayProgress& at = alone_[place]->progress();
  at.evaluations += (at.steps + at.rejected) * kernel_->evaluations();
  ends_[index_[place]] = alone_[place]->end(status);
  take_next(i);
}

/// A good step on which something may have happened: as trace_ray takes it.
template <int W>
void LaneBatch<W>::look_closer(int i) {
  const auto place = static_cast<std::size_t>(i);
  RayTrace& ray = *alone_[place];
  put_back(i);
  const bool was_inside = ray.progress().inside_interface;
  kernel_->hand_over(i, now_, step_, ray.stepper());
  const StepOutcome outcome{.y = lane_of<W>(step_.y, i), .error_norm = lane(step_.error_norm, i)};
  std::uint32_t far = 0;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    // The half-plane's crossings are counted by the ray.
    if (surfaces_[s].kind != SurfaceKind::half_plane && lane(surfaces_[s].far, i)) far |= 1U << s;
  }
  const std::optional<Status> status = ray.accept(outcome, lane(now_.h, i), far);
  RayProgress& at = ray.progress();
  if (status) return finish(i, *status);
  if (&ray.chart() != &spacetime_) {
    // Other charts have other lanes: the ray goes on alone.
    at.evaluations += (at.steps + at.rejected) * kernel_->evaluations();
    ends_[index_[place]] = ray.end(ray.go_on());
    return take_next(i);
  }
  if (at.inside_interface != was_inside) set_scale(i);
  const bool whole = at.y.c == outcome.y.c;
  take_up(i, whole ? lane_of<W>(step_.rate, i) : spacetime_.flow_of_side(at.y, at.inside_interface));
}

/// One step in every lane.
template <int W>
void LaneBatch<W>::attempt() {
  const T rest = settings_.lambda_max - lambda_.sum;
  now_.h = select(h_next_ < rest, h_next_, rest);
  kernel_->step(now_, step_);
  const M numbers = all_finite(step_.y) & isfinite(step_.error_norm);
  const M good = active_ & control_step(numbers);

  const LaneProbe<W> probe = now_.chart.probe(step_.y, step_.rate, sheet_);
  const M quiet = good & uneventful(probe, good);
  commit(quiet, probe, rest);
  const M loud = good & !quiet;
  if (any(loud)) {
    for (int i = 0; i < W; ++i) {
      if (lane(loud, i)) look_closer(i);
    }
  }
  end_spent();
}

/// Chooses the next steps; ends the rays whose steps cannot get shorter. Which steps are good.
template <int W>
Mask<W> LaneBatch<W>::control_step(const M& numbers) {
  M good = numbers;
  M ended = active_ & !numbers;
  if (method_.adaptive) {
    good = numbers & (step_.error_norm <= 1.0);
    const M bad = active_ & !good;
    const T& error = step_.error_norm;
    const T proposed = now_.h * select(good, step_factor_foreseen(now_.h, error, last_, method_.error_power),
                                       step_factor(error, method_.error_power));
    const StepMemory<T> memory = StepMemory<T>::of(now_.h, error);
    last_.h = select(good, memory.h, last_.h);
    last_.error = select(good, memory.error, last_.error);
    h_next_ = select(good & last_rejected_ & (proposed > now_.h), now_.h, proposed);
    rejected_ = select(bad, rejected_ + 1.0, rejected_);
    last_rejected_ = !good;
    const T reached = select(lambda_.sum > h_first_, lambda_.sum, h_first_);
    ended = bad & (h_next_ < least_step * reached);
  }
  if (any(ended)) {
    for (int i = 0; i < W; ++i) {
      if (!lane(ended, i)) continue;
      put_back(i);
      finish(i, method_.adaptive && lane(numbers, i) ? Status::step_underflow : Status::not_finite);
    }
  }
  return good;
}

/// Where a step meets no stop and the ray goes on in this chart.
template <int W>
Mask<W> LaneBatch<W>::uneventful(const LaneProbe<W>& probe, const M& good) {
  if (!lanes_see_all_) return M(false);
  M calm = probe.inside & probe.stays & !(probe.null_residual > useless_residual);
  for (LaneSurface& surface : surfaces_) {
    if (surface.kind == SurfaceKind::radius) {
      surface.far = far_from_radius(surface, probe);
      if (surface.status == Status::escaped) calm = calm & !(probe.radius >= surface.level);
      if (surface.status == Status::captured) calm = calm & !(probe.radius <= surface.level);
    } else if (surface.kind == SurfaceKind::interface) {
      surface.far = out_of_reach(T(surface.side * interface_), T(surface.side * probe.interface),
                                 path_length_bound(now_.h, now_.y, now_.rate, step_.y, step_.rate));
    } else {
      pass_half_plane(surface);
    }
    calm = calm & surface.far;
  }
  return things_ == nullptr ? calm : calm & far_from_things(good & calm);
}

/// Where a step is out of reach of everything in space.
template <int W>
Mask<W> LaneBatch<W>::far_from_things(const M& asked) const {
  std::array<T, 3> bend;
  for (std::size_t k = 0; k < 3; ++k) {
    bend[k] = bend_of(now_.h, now_.y[k + 1], now_.rate[k + 1], step_.y[k + 1], step_.rate[k + 1]);
  }
  M far = asked;
  for (int i = 0; i < W; ++i) {
    if (!lane(asked, i)) continue;
    const auto of_lane = [i](const T& x, const T& y, const T& z) {
      return std::array<double, 3>{lane(x, i), lane(y, i), lane(z, i)};
    };
    if (things_->may_meet(of_lane(now_.y[1], now_.y[2], now_.y[3]), of_lane(step_.y[1], step_.y[2], step_.y[3]),
                          of_lane(bend[0], bend[1], bend[2]))) {
      set_lane(far, i, false);
    }
  }
  return far;
}

/// Where the radius is on its side of the level at both ends, further from it than its path bends; or, for a surface
/// that counts in one direction, where it goes the other way throughout.
template <int W>
Mask<W> LaneBatch<W>::far_from_radius(const LaneSurface& surface, const LaneProbe<W>& probe) const {
  const T g0 = radius_ - surface.level, g1 = probe.radius - surface.level;
  const T bend = bend_of(now_.h, g0, radial_rate_, g1, probe.radial_rate);
  M far = (surface.side * g0 > 0.0) & (surface.side * g1 > 0.0) & (min(abs(g0), abs(g1)) > 0.5 * bend);
  if (surface.direction == 0) return far;
  const auto direction = static_cast<double>(surface.direction);
  const T chord = g1 - g0;
  return far |
         ((direction * surface.side <= 0.0) & (direction * g1 < 0.0) & (direction * chord < 0.0) & (bend < abs(chord)));
}

/// Counts a winding where y changes sign once at x clearly below zero; `far` where that, or nothing, is to be counted.
template <int W>
void LaneBatch<W>::pass_half_plane(LaneSurface& surface) const {
  const T &x0 = now_.y[1], &x1 = step_.y[1], &y0 = now_.y[2], &y1 = step_.y[2];
  const T bend = bend_of(now_.h, y0, now_.rate[2], y1, step_.rate[2]);
  const M x_is_clear = min(abs(x0), abs(x1)) > 0.5 * bend_of(now_.h, x0, now_.rate[1], x1, step_.rate[1]);
  const M ahead = (x0 > 0.0) & (x1 > 0.0) & x_is_clear & (y1 != 0.0);
  const M stays = (surface.side * y0 > 0.0) & (surface.side * y1 > 0.0) & (min(abs(y0), abs(y1)) > 0.5 * bend);
  const M behind = (x0 < 0.0) & (x1 < 0.0) & x_is_clear & (surface.side * y0 > 0.0) & (surface.side * y1 < 0.0) &
                   (bend < abs(y1 - y0));
  surface.windings = select(behind, select(y1 > y0, T(-1.0), T(1.0)), T(0.0));
  surface.far = ahead | stays | behind;
}

/// Takes the steps of quiet lanes.
template <int W>
void LaneBatch<W>::commit(const M& quiet, const LaneProbe<W>& probe, const T& rest) {
  for (std::size_t k = 0; k < 8; ++k) {
    now_.y[k] = select(quiet, step_.y[k], now_.y[k]);
    now_.rate[k] = select(quiet, step_.rate[k], now_.rate[k]);
  }
  CompensatedSum<T> lambda = lambda_;
  lambda.add(now_.h);
  const M reached = now_.h == rest;
  lambda_.sum = select(quiet, select(reached, T(settings_.lambda_max), lambda.sum), lambda_.sum);
  lambda_.rest = select(quiet, select(reached, T(0.0), lambda.rest), lambda_.rest);
  steps_ = select(quiet, steps_ + 1.0, steps_);
  residual_ = select(quiet, probe.null_residual, residual_);
  residual_max_ = select(quiet & (probe.null_residual > residual_max_), probe.null_residual, residual_max_);
  radius_ = select(quiet, probe.radius, radius_);
  radial_rate_ = select(quiet, probe.radial_rate, radial_rate_);
  interface_ = select(quiet, probe.interface, interface_);
  for (LaneSurface& surface : surfaces_) {
    if (surface.kind == SurfaceKind::half_plane) {
      surface.side = select(quiet, select(step_.y[2] < 0.0, T(-1.0), T(1.0)), surface.side);
      windings_ = select(quiet, windings_ + surface.windings, windings_);
    } else {
      const T g = surface.kind == SurfaceKind::radius ? T(probe.radius - surface.level) : probe.interface;
      const T side = select(g < 0.0, T(-1.0), T(1.0));
      surface.side = select(quiet & (surface.side == 0.0), side, surface.side);
    }
  }
}

template <int W>
void LaneBatch<W>::end_spent() {
  const M spent =
      active_ & ((lambda_.sum >= settings_.lambda_max) | (steps_ >= static_cast<double>(settings_.max_steps)));
  if (!any(spent)) return;
  for (int i = 0; i < W; ++i) {
    if (!lane(spent, i)) continue;
    put_back(i);
    finish(i, lane(lambda_.sum, i) >= settings_.lambda_max ? Status::max_affine : Status::max_steps);
  }
}

extern template class LaneBatch<1>;
extern template class LaneBatch<2>;
extern template class LaneBatch<4>;
extern template class LaneBatch<8>;

}  // namespace xpr
