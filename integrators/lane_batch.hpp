// A batch of rays W at a time: see batch_tracer.hpp.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "integrators/batch_tracer.hpp"
#include "integrators/lane_kernel.hpp"
#include "integrators/ray_trace.hpp"
#include "integrators/step_control.hpp"

namespace xpr {

template <int W>
class LaneBatch {
 public:
  /// `kernel` is that of the settings' method.
  LaneBatch(const Spacetime& spacetime, const TraceSettings& settings, std::unique_ptr<LaneKernel<W>> kernel);

  void trace(std::span<const BatchRay> rays, std::span<RayEnd> ends);

 private:
  using T = Pack<W>;
  using M = Mask<W>;
  static constexpr auto lane_count = static_cast<std::size_t>(W);

  /// A stop or another surface, in lanes: only those of radius and the half-plane of windings are.
  struct LaneSurface {
    SurfaceKind kind;
    Status status;
    T level{};
    T side{};  ///< +1, -1, or 0 where the ray has been on it only
  };

  // Between the lanes and the ray that each holds.
  void take_next(int i);
  void take_up(int i, const PhaseState<double>& rate, double radius, double radial_rate);
  void set_scale(int i);
  void put_back(int i);
  void finish(int i, Status status);
  void look_closer(int i, const LaneProbe<W>& probe);

  // In all lanes.
  void attempt();
  [[nodiscard]] M control_step(const M& numbers);
  [[nodiscard]] M uneventful(const LaneProbe<W>& probe) const;
  [[nodiscard]] M far_from(const LaneSurface& surface, const LaneProbe<W>& probe) const;
  void commit(const M& quiet, const LaneProbe<W>& probe, const T& rest);
  void end_spent();

  const Spacetime& spacetime_;
  const TraceSettings& settings_;
  MethodCard method_;
  std::unique_ptr<LaneKernel<W>> kernel_;
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
  T h_next_, h_first_, steps_, rejected_, radius_, radial_rate_, residual_, residual_max_;
  StepMemory<T> last_;
  M last_rejected_;
};

// Definitions.

template <int W>
LaneBatch<W>::LaneBatch(const Spacetime& spacetime, const TraceSettings& settings,
                        std::unique_ptr<LaneKernel<W>> kernel)
    : spacetime_(spacetime),
      settings_(settings),
      method_(method_card(settings.method)),
      kernel_(std::move(kernel)),
      lanes_see_all_(settings.projection == Projection::none),
      now_{.chart = *spacetime.lane_charts().template of_width<W>()} {
  for (int i = 0; i < W; ++i) {
    alone_.push_back(std::make_unique<RayTrace>(spacetime, settings));
    alone_.back()->keep_stepper();
  }
  SurfaceWatch& watch = alone_.front()->watch();
  for (std::size_t s = 0; s < watch.size(); ++s) {
    surfaces_.push_back({.kind = watch.surface(s).kind, .status = watch.surface(s).status});
    lanes_see_all_ =
        lanes_see_all_ && (surfaces_[s].kind == SurfaceKind::radius || surfaces_[s].kind == SurfaceKind::half_plane);
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
    std::optional<Status> status = ray.begin(start.start, start.sheet, start.r_max);
    if (!status) status = ray.spent();
    if (status) {
      ends_[index_[place]] = ray.end(*status);
      continue;
    }
    const RayProgress& at = ray.progress();
    const bool sided = spacetime_.interface_radius().has_value();
    set_lane(active_, i, true);
    set_scale(i);
    take_up(i, sided ? spacetime_.flow_of_side(at.y, at.inside_interface) : ray.first_rate(),
            spacetime_.radius(at.y.x()), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  set_lane(active_, i, false);
  set_lane(h_next_, i, 0.0);
}

/// From the ray into the lane. A radial rate that is not known is NaN: the next step is looked at closely.
template <int W>
void LaneBatch<W>::take_up(int i, const PhaseState<double>& rate, double radius, double radial_rate) {
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
  set_lane(radius_, i, radius);
  set_lane(radial_rate_, i, radial_rate);
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
  at.rejected = static_cast<std::int64_t>(lane(rejected_, i));
  at.null_residual = lane(residual_, i);
  at.null_residual_max = lane(residual_max_, i);
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const double g =
        surfaces_[s].kind == SurfaceKind::radius ? lane(radius_, i) - lane(surfaces_[s].level, i) : at.y[2];
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
void LaneBatch<W>::look_closer(int i, const LaneProbe<W>& probe) {
  const auto place = static_cast<std::size_t>(i);
  RayTrace& ray = *alone_[place];
  put_back(i);
  const bool was_inside = ray.progress().inside_interface;
  kernel_->hand_over(i, now_, step_, ray.stepper());
  const StepOutcome outcome{.y = lane_of<W>(step_.y, i), .error_norm = lane(step_.error_norm, i)};
  const std::optional<Status> status = ray.accept(outcome, lane(now_.h, i));
  RayProgress& at = ray.progress();
  if (status) return finish(i, *status);
  if (&ray.chart() != &spacetime_) {
    // Other charts have other lanes: the ray goes on alone.
    at.evaluations += (at.steps + at.rejected) * kernel_->evaluations();
    ends_[index_[place]] = ray.end(ray.go_on());
    return take_next(i);
  }
  if (at.y.c == outcome.y.c)
    return take_up(i, lane_of<W>(step_.rate, i), lane(probe.radius, i), lane(probe.radial_rate, i));
  if (at.inside_interface != was_inside) set_scale(i);
  take_up(i, spacetime_.flow_of_side(at.y, at.inside_interface), spacetime_.radius(at.y.x()),
          std::numeric_limits<double>::quiet_NaN());
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
  const M quiet = good & uneventful(probe);
  commit(quiet, probe, rest);
  const M loud = good & !quiet;
  if (any(loud)) {
    for (int i = 0; i < W; ++i) {
      if (lane(loud, i)) look_closer(i, probe);
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
Mask<W> LaneBatch<W>::uneventful(const LaneProbe<W>& probe) const {
  if (!lanes_see_all_) return M(false);
  M calm = probe.inside & probe.stays & !(probe.null_residual > useless_residual);
  for (const LaneSurface& surface : surfaces_) {
    if (surface.status == Status::escaped) calm = calm & !(probe.radius >= surface.level);
    if (surface.status == Status::captured) calm = calm & !(probe.radius <= surface.level);
    calm = calm & far_from(surface, probe);
  }
  return calm;
}

/// Where g, of one sign at both ends, is further from zero than its path bends away from its chord: the cubic through
/// both ends and both slopes deviates from the chord by at most 4/27 of `bend`.
template <int W>
Mask<W> LaneBatch<W>::far_from(const LaneSurface& surface, const LaneProbe<W>& probe) const {
  const auto far = [&](const T& g0, const T& rate0, const T& g1, const T& rate1) {
    const T chord = g1 - g0;
    const T bend = abs(now_.h * rate0 - chord) + abs(now_.h * rate1 - chord);
    return min(abs(g0), abs(g1)) > 0.5 * bend;
  };
  if (surface.kind == SurfaceKind::radius) {
    const T g0 = radius_ - surface.level, g1 = probe.radius - surface.level;
    return (surface.side * g0 > 0.0) & (surface.side * g1 > 0.0) & far(g0, radial_rate_, g1, probe.radial_rate);
  }
  const auto& [x0, x1] = std::pair(now_.y[1], step_.y[1]);
  const auto& [y0, y1] = std::pair(now_.y[2], step_.y[2]);
  // Only crossings at x < 0 are windings.
  const M ahead = (x0 > 0.0) & (x1 > 0.0) & (y1 != 0.0) & far(x0, now_.rate[1], x1, step_.rate[1]);
  return ahead | ((surface.side * y0 > 0.0) & (surface.side * y1 > 0.0) & far(y0, now_.rate[2], y1, step_.rate[2]));
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
  for (LaneSurface& surface : surfaces_) {
    if (surface.kind != SurfaceKind::half_plane) continue;
    surface.side = select(quiet, select(step_.y[2] < 0.0, T(-1.0), T(1.0)), surface.side);
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
