// W rays by first integrals, side by side: the loop around the Taylor series. Included by the sources that instantiate
// it, one for each width.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "integrators/first_integral_series.hpp"
#include "integrators/first_integrals.hpp"
#include "integrators/root.hpp"

namespace xpr::first_integrals {

/// What all rays of a call share.
struct Batch {
  SeparatedLight light;
  std::span<const SeparatedState> rays;
  std::span<FirstIntegralEnd> ends;
  FirstIntegralSettings settings;
  double u_escape = 0.0;   ///< 1/r_max
  double u_capture = 0.0;  ///< 1/r_min
};

/// The closed-form parts of azimuth and time over a ray's branches (metrics/separable.hpp), as running combinations:
/// every branch from u1 to u2 of sign s adds s (A(u2) - A(u1)), so a turn adds 2 s A and the ends -s A and s A. Sums of
/// artanh(w g) combine g by the addition theorem, sums of logarithms multiply: one artanh and one log a ray.
template <class T, bool Timed>
struct BranchSums {
  T g{};       ///< artanh(w g)/w is the sum of s A
  T delta{};   ///< log delta is the sum of s ln Delta, if timed
  T radius{};  ///< the sum of s r, if timed

  /// Adds s A, s ln Delta and s r at u.
  void add(const SeparatedLight& light, const T& u, const T& s) {
    const T g_here = s * u / (1.0 - light.mass * u);
    g = (g + g_here) / (1.0 + light.half_gap_squared() * g * g_here);
    if constexpr (Timed) {
      const T u_sq = square(u), d = light.d(u);
      const auto forward = s > 0.0;
      delta = delta * (select(forward, d, u_sq) / select(forward, u_sq, d));
      radius = radius + s / u;
    }
  }
};

/// artanh(w g)/w, by its series for small w g and by a logarithm else.
template <class T>
[[nodiscard]] T artanh_over(double w_squared, const T& g) {
  const T x_sq = w_squared * square(g);
  // 0.04^k / (2k + 1) falls below 1e-17 at k = 11.
  T series = T(0.0);
  for (int k = 11; k >= 0; --k) series = series * x_sq + 1.0 / static_cast<double>(2 * k + 1);
  const double w = sqrt(w_squared);
  const T logarithm = log((1.0 + w * g) / (1.0 - w * g)) * (w > 0.0 ? 0.5 / w : 0.0);
  return select(x_sq < 0.04, g * series, logarithm);
}

/// Lanes of T: the rays under way and what has to be known of each.
template <class T, int N, bool Timed>
class Lanes {
  static constexpr int width = lanes<T>;
  static constexpr auto slots = static_cast<std::size_t>(width);
  using Bool = MaskOf<T>;

 public:
  explicit Lanes(const Batch& batch) : batch_(batch) {}

  void run() {
    for (int i = 0; i < width; ++i) {
      blank(i);
      load_next(i);
    }
    while (any(active_)) step();
    finish();
  }

 private:
  /// A harmless state for a lane without a ray.
  void blank(int i) {
    SeparatedState still;
    still.u_rate = 1.0;
    still.n = {1.0, 0.0, 0.0};
    put(i, still, {.c2 = 0, .c3 = 0, .c4 = 0, .p2 = 0, .kappa = 0, .polar_constant = 0, .spin_squared = 0});
    set_lane(active_, i, false);
  }

  /// Takes rays from the batch until one has to be traced.
  void load_next(int i) {
    for (; next_ < batch_.rays.size(); ++next_) {
      const SeparatedState& ray = batch_.rays[next_];
      const SeparatedPotentials potentials = separated_potentials(batch_.light, ray.lambda, ray.eta);
      const auto status = status_at_start(ray, potentials);
      if (!status) {
        put(i, ray, potentials);
        index_[static_cast<std::size_t>(i)] = next_++;
        set_lane(active_, i, true);
        return;
      }
      batch_.ends[next_] = {.status = *status, .state = ray};
    }
    set_lane(active_, i, false);
  }

  [[nodiscard]] std::optional<Status> status_at_start(const SeparatedState& ray,
                                                      const SeparatedPotentials& potentials) const {
    const double u = ray.u, u_rate = ray.u_rate;
    const double speed_sq = square(ray.n_rate[0]) + square(ray.n_rate[1]) + square(ray.n_rate[2]);
    const double size = square(ray.n[0]) + square(ray.n[1]) + square(ray.n[2]);
    const double tension = potentials.spin_squared * square(ray.n[2]);
    if (!isfinite(u_rate + speed_sq + size + tension + potentials.radial(u) + ray.t)) return Status::not_finite;
    if (!(u >= 0.0 && batch_.light.mass * u < 1.0 && batch_.light.d(u) > 0.0)) return Status::outside_domain;
    const double radial_size = 1.0 + u * u * (abs(potentials.c2) + u * (abs(potentials.c3) + u * abs(potentials.c4)));
    const double polar_size = abs(ray.eta) + square(ray.lambda) + tension + speed_sq;
    const bool on_cone = abs(u_rate * u_rate - potentials.radial(u)) <= 1e-9 * radial_size &&
                         abs(speed_sq - potentials.polar_constant - tension) <= 1e-9 * polar_size &&
                         abs(size - 1.0) <= 1e-9 && abs(abs(ray.energy_sign) - 1.0) == 0.0;
    if (!on_cone) return Status::constraint_violated;
    if (u <= batch_.u_escape && u_rate < 0.0) return Status::escaped;
    if (u >= batch_.u_capture && u_rate > 0.0) return Status::captured;
    return std::nullopt;
  }

  /// Puts a ray into lane i, turned about the axis so that it begins at azimuth 0.
  void put(int i, const SeparatedState& ray, const SeparatedPotentials& p) {
    const double sine = sqrt(square(ray.n[0]) + square(ray.n[1]));
    const double rate = sqrt(square(ray.n_rate[0]) + square(ray.n_rate[1]));
    const double cos_start = sine > 0.0 ? ray.n[0] / sine : rate > 0.0 ? ray.n_rate[0] / rate : 1.0;
    const double sin_start = sine > 0.0 ? ray.n[1] / sine : rate > 0.0 ? ray.n_rate[1] / rate : 0.0;
    const double u = ray.u, u_rate = ray.u_rate;
    const double sign_p = 1.0 + p.p2 * u * u < 0.0 ? -1.0 : 1.0;
    const double mass_sq = square(batch_.light.mass);

    set_lane(constants_.c2, i, p.c2);
    set_lane(constants_.three_halves_c3, i, 1.5 * p.c3);
    set_lane(constants_.twice_c4, i, 2.0 * p.c4);
    set_lane(constants_.p2, i, p.p2);
    set_lane(constants_.kappa, i, p.kappa);
    set_lane(constants_.polar_constant, i, p.polar_constant);
    set_lane(constants_.spin_squared, i, p.spin_squared);
    set_lane(constants_.time_constant, i, batch_.light.spin * (ray.lambda - batch_.light.spin));
    const double size_squared = abs(p.polar_constant) + 27.0 * mass_sq + 1e-200;
    set_lane(constants_.size_squared, i, size_squared);
    set_lane(constants_.inverse_size_squared, i, 1.0 / size_squared);
    // The direction turns by at most one and a half radians a step, so that half-plane crossings are not missed.
    set_lane(longest_, i, 1.5 / sqrt(abs(p.polar_constant) + p.spin_squared + 1e-200));

    set_lane(state_.u, i, u);
    set_lane(state_.u_rate, i, u_rate);
    set_lane(state_.n[0], i, sine);
    set_lane(state_.n[1], i, 0.0);
    set_lane(state_.n[2], i, ray.n[2]);
    set_lane(state_.n_rate[0], i, cos_start * ray.n_rate[0] + sin_start * ray.n_rate[1]);
    set_lane(state_.n_rate[1], i, cos_start * ray.n_rate[1] - sin_start * ray.n_rate[0]);
    set_lane(state_.n_rate[2], i, ray.n_rate[2]);
    set_lane(state_.azimuth, i, 0.0);
    set_lane(state_.time, i, 0.0);
    set_lane(state_.affine, i, 0.0);
    set_lane(mino_, i, 0.0);
    set_lane(windings_, i, 0.0);
    set_lane(steps_, i, 0.0);
    set_lane(sign_p_, i, sign_p);
    set_lane(branch_, i, u_rate < 0.0 ? -sign_p : sign_p);
    set_lane(sums_.g, i, 0.0);
    set_lane(sums_.delta, i, 1.0);
    set_lane(sums_.radius, i, 0.0);
  }

  void step() {
    follow_branch();
    expand(constants_, state_, branch_, series_);
    T h = min(step_size(constants_, series_, batch_.settings.tol), longest_);
    const T left = batch_.settings.mino_max - mino_;
    const Bool last = h >= left;
    h = select(last, left, h);

    T u, u_rate;
    evaluate(series_.u, h, u, u_rate);
    const Bool turned = state_.u_rate * u_rate < 0.0;
    Bool out = (u < batch_.u_escape) & (u_rate < 0.0) & active_;
    Bool in = (u > batch_.u_capture) & (u_rate > 0.0) & active_;
    T from = 0.0;  // a stop that is met lies between here and h
    if (any(turned & active_) && check_turns(from, h, turned, out, in)) evaluate(series_.u, h, u, u_rate);
    const Bool stopped = out | in;
    if (any(stopped)) stop_at(stopped, out, from, h, u, u_rate);

    const T y_before = state_.n[1];
    advance_rest(series_, h, state_);
    state_.u = u;
    state_.u_rate = u_rate;
    restore_radial_integral(stopped);
    restore_direction();
    mino_ = select(last & !stopped, T(batch_.settings.mino_max), mino_ + h);
    steps_ = steps_ + 1.0;
    count_windings(y_before);

    const T sum = u_rate + state_.n[0] + state_.n[1] + state_.n[2] + state_.azimuth + state_.time;
    const Bool broken = !isfinite(sum + u);
    const Bool spent = steps_ >= static_cast<double>(batch_.settings.max_steps);
    const Bool ended = (stopped | last | broken | spent) & active_;
    if (!any(ended)) return;
    for (int i = 0; i < width; ++i) {
      if (!lane(ended, i)) continue;
      const Status status = lane(broken, i) ? Status::not_finite
                            : lane(out, i)  ? Status::escaped
                            : lane(in, i)   ? Status::captured
                            : lane(last, i) ? Status::max_affine
                                            : Status::max_steps;
      unload(i, status);
      load_next(i);
    }
  }

  /// Moves (u, u') back onto u'^2 = U(u) the shortest way, u counted in units of the ray's size. The integral holds the
  /// ray's constants: off it a ray that lingers near a spherical orbit leaves as one of other constants would. Next to
  /// a double root, where U and U' vanish together, there is no such way and the state stays.
  void restore_radial_integral(const Bool& stopped) {
    const T off = square(state_.u_rate) - radial_potential(state_.u);
    const T force = radial_force(state_.u);
    const T scaled = force * constants_.inverse_size_squared;
    const T gradient = scaled * force + square(state_.u_rate);
    const T change = select((abs(off) < 0.01 * gradient) & !stopped, 0.5 * off / gradient, T(0.0));
    state_.u = state_.u + change * scaled;
    state_.u_rate = state_.u_rate - change * state_.u_rate;
  }

  /// Moves n back onto the unit sphere and n' onto its tangent plane and to its speed, to first order in the errors.
  void restore_direction() {
    auto& n = state_.n;
    auto& rate = state_.n_rate;
    const T shrink = 1.5 - 0.5 * (square(n[0]) + square(n[1]) + square(n[2]));
    for (T& x : n) x = shrink * x;
    const T along = n[0] * rate[0] + n[1] * rate[1] + n[2] * rate[2];
    for (std::size_t i = 0; i < 3; ++i) rate[i] = rate[i] - along * n[i];
    const T speed_sq = constants_.polar_constant + constants_.spin_squared * square(n[2]);
    const T off = square(rate[0]) + square(rate[1]) + square(rate[2]) - speed_sq;
    const T change = select(abs(off) < 0.01 * speed_sq, 0.5 * off / speed_sq, T(0.0));
    for (T& x : rate) x = x - change * x;
  }

  /// Closes the books on a branch where the radial motion has turned.
  void follow_branch() {
    const T branch = select(state_.u_rate < 0.0, -sign_p_, sign_p_);
    const Bool changed = (branch != branch_) & active_;
    if (!any(changed)) return;
    BranchSums<T, Timed> turned = sums_;
    turned.add(batch_.light, state_.u, branch_);
    turned.add(batch_.light, state_.u, branch_);
    sums_.g = select(changed, turned.g, sums_.g);
    sums_.delta = select(changed, turned.delta, sums_.delta);
    sums_.radius = select(changed, turned.radius, sums_.radius);
    branch_ = select(changed, branch, branch_);
  }

  /// Where a ray turns within a step it may pass a stop and come back: looks at the turning point itself, but only if
  /// the size of the series allows it to lie beyond a stop. True if it did look.
  [[nodiscard]] bool check_turns(T& from, T& h, const Bool& turned, Bool& out, Bool& in) {
    T spread = abs(series_.u[static_cast<std::size_t>(N)]);
    for (std::size_t k = static_cast<std::size_t>(N); k-- > 1;) spread = spread * h + abs(series_.u[k]);
    spread = spread * h;
    const Bool near =
        turned & active_ & ((state_.u + spread > batch_.u_capture) | (state_.u - spread < batch_.u_escape));
    for (int i = 0; i < width; ++i) {
      if (lane(near, i)) turn_near_a_stop(i, from, h, out, in);
    }
    return any(near);
  }

  /// u and u' of lane i at tau = s.
  [[nodiscard]] std::pair<double, double> radius_of(int i, double s) const {
    double u = lane(series_.u[static_cast<std::size_t>(N)], i), rate = 0.0;
    for (std::size_t k = static_cast<std::size_t>(N); k-- > 0;) {
      rate = rate * s + u;
      u = u * s + lane(series_.u[k], i);
    }
    return {u, rate};
  }

  /// Lane i turns in this step. It ends before the turn if it passes a stop on the way there; at the turn, if it began
  /// beyond a stop and turns before it gets back (from = h says so).
  void turn_near_a_stop(int i, T& from, T& h, Bool& out, Bool& in) {
    const double begin = lane(state_.u, i), length = lane(h, i);
    const auto slope = [&](double s) { return radius_of(i, s).second; };
    const double turn = bracketed_root(slope, 0.0, length, lane(state_.u_rate, i), slope(length));
    const double u_turn = radius_of(i, turn).first;
    const bool inward = lane(state_.u_rate, i) > 0.0;
    const bool passes = inward ? begin < batch_.u_capture && u_turn > batch_.u_capture
                               : begin > batch_.u_escape && u_turn < batch_.u_escape;
    const bool stays = inward ? u_turn < batch_.u_escape : u_turn > batch_.u_capture;
    if (passes || stays) {
      const bool leaves = inward == stays;
      set_lane(h, i, turn);
      set_lane(from, i, stays ? turn : 0.0);
      set_lane(out, i, leaves);
      set_lane(in, i, !leaves);
    } else {
      set_lane(from, i, turn);
    }
  }

  [[nodiscard]] T radial_potential(const T& u) const {
    return 1.0 +
           square(u) * (constants_.c2 + u * ((2.0 / 3.0) * constants_.three_halves_c3 + 0.5 * u * constants_.twice_c4));
  }

  /// U'/2.
  [[nodiscard]] T radial_force(const T& u) const {
    return u * (constants_.c2 + u * (constants_.three_halves_c3 + u * constants_.twice_c4));
  }

  /// Shortens the step of stopped lanes to end on their stop, where u' is known from U: without the series' error,
  /// which the affine length would multiply by r. Not so where the ray turns, and the root of U loses digits.
  void stop_at(const Bool& stopped, const Bool& out, const T& from, T& h, T& u, T& u_rate) {
    const T stop = select(out, T(batch_.u_escape), T(batch_.u_capture));
    const T slope_sq = radial_potential(stop);
    const T size = sqrt(max(slope_sq, T(0.0)));
    const T slope = select(out, -size, size);
    const Bool met = stopped & (from < h);
    const Bool exact = met & (slope_sq > 0.01);
    h = select(met, meet(stop, slope_sq, slope, from, h, u, met), h);
    if (any(stopped & !exact)) evaluate(series_.u, h, u, u_rate);
    u = select(met, stop, u);
    u_rate = select(exact, slope, u_rate);
  }

  /// The tau at which each lane of `met` has u = stop, to round-off: tau as a function of u expanded about the stop,
  /// where u' and u'' are known, corrects the guess by three orders a time. `u` is that at h.
  [[nodiscard]] T meet(const T& stop, const T& slope_sq, const T& slope, const T& from, const T& h, const T& u,
                       const Bool& met) {
    const T bend = 0.5 * radial_force(stop) / slope_sq;
    const T inverse_slope = 1.0 / slope;
    T s = h, off = u - stop;
    Bool going = met;
    for (int iteration = 0; iteration < 8; ++iteration) {
      const T curved = bend * off;
      const T change = off * (1.0 - curved) * inverse_slope;
      s = select(going, s - change, s);
      // What is left is of the third order in these.
      going = going & !((abs(change) <= 1e-6 * abs(s)) & (abs(curved) <= 1e-6));
      if (!any(going)) break;
      off = value_at(series_.u, s) - stop;
    }
    const Bool missed = met & !((s >= from) & (s <= h) & !going);
    for (int i = 0; i < width; ++i) {
      if (lane(missed, i)) set_lane(s, i, bracketed(i, lane(stop, i), lane(from, i), lane(h, i)));
    }
    return s;
  }

  /// The same by brackets, for tangent passages.
  [[nodiscard]] double bracketed(int i, double stop, double from, double h) const {
    const auto above = [&](double s) { return radius_of(i, s).first - stop; };
    const double first = above(from), last = above(h);
    return first * last < 0.0 ? bracketed_root(above, from, h, first, last) : h;
  }

  /// The angular momentum about the axis keeps its sign, so a step of less than pi that leaves y >= 0 for y < 0
  /// (turning counter-clockwise), or the reverse (clockwise), has crossed the half-plane y = 0, x < 0.
  void count_windings(const T& y_before) {
    const T& y = state_.n[1];
    const T turning = state_.n[0] * state_.n_rate[1] - y * state_.n_rate[0];
    const Bool forward = (turning > 0.0) & (y_before >= 0.0) & (y < 0.0);
    const Bool backward = (turning < 0.0) & (y_before < 0.0) & (y >= 0.0);
    windings_ = windings_ + select(forward, T(1.0), select(backward, T(-1.0), T(0.0)));
  }

  /// Sets a ray that has ended aside; a full set is finished at once, in lanes again.
  void unload(int i, Status status) {
    const std::size_t from = index_[static_cast<std::size_t>(i)];
    const auto to = static_cast<std::size_t>(waiting_);
    waiting_index_[to] = from;
    waiting_status_[to] = status;
    const auto move = [i, this](T& target, const T& source) { set_lane(target, waiting_, lane(source, i)); };
    move(ended_.u, state_.u), move(ended_.u_rate, state_.u_rate);
    for (std::size_t k = 0; k < 3; ++k) move(ended_.n[k], state_.n[k]), move(ended_.n_rate[k], state_.n_rate[k]);
    move(ended_.azimuth, state_.azimuth), move(ended_.time, state_.time), move(ended_.affine, state_.affine);
    move(ended_sums_.g, sums_.g), move(ended_sums_.delta, sums_.delta), move(ended_sums_.radius, sums_.radius);
    move(ended_branch_, branch_), move(ended_mino_, mino_), move(ended_windings_, windings_),
        move(ended_steps_, steps_);
    if (++waiting_ == width) finish();
  }

  /// From what was integrated to azimuth, time and direction, for the rays set aside.
  void finish() {
    if (waiting_ == 0) return;
    T start_u = ended_.u, start_rate = 0.0, first_branch = ended_branch_, sign = 1.0;
    for (int i = 0; i < waiting_; ++i) {
      const SeparatedState& ray = batch_.rays[waiting_index_[static_cast<std::size_t>(i)]];
      const SeparatedPotentials p = separated_potentials(batch_.light, ray.lambda, ray.eta);
      const double u = ray.u, u_rate = ray.u_rate;
      const double sign_p = 1.0 + p.p2 * u * u < 0.0 ? -1.0 : 1.0;
      set_lane(start_u, i, u);
      set_lane(start_rate, i, u_rate);
      set_lane(first_branch, i, u_rate < 0.0 ? -sign_p : sign_p);
      set_lane(sign, i, ray.energy_sign);
    }
    const SeparatedLight& light = batch_.light;
    ended_sums_.add(light, ended_.u, ended_branch_);
    ended_sums_.add(light, start_u, -first_branch);
    const T sum = artanh_over(light.half_gap_squared(), ended_sums_.g);
    const T drag = sign * (light.spin * (sum + ended_.azimuth - ended_mino_));
    const T swept = atan2(ended_.n[1], ended_.n[0]) + 2.0 * pi() * ended_windings_ + drag;
    const auto [sin_drag, cos_drag] = sincos(drag);
    T elapsed = bits::nan, affine = bits::nan;
    if constexpr (Timed) {
      const double twice = 2.0 * square(light.mass) - light.charge_squared;
      elapsed = sign * (ended_.time + twice * sum - ended_sums_.radius - light.mass * log(ended_sums_.delta));
      affine = ended_.affine + start_rate / start_u - ended_.u_rate / ended_.u;
    }
    for (int i = 0; i < waiting_; ++i) {
      const std::size_t index = waiting_index_[static_cast<std::size_t>(i)];
      const SeparatedState& ray = batch_.rays[index];
      FirstIntegralEnd& end = batch_.ends[index];
      end.status = waiting_status_[static_cast<std::size_t>(i)];
      end.swept_azimuth = lane(swept, i);
      end.mino_time = lane(ended_mino_, i);
      end.affine = lane(affine, i);
      end.steps = static_cast<std::int64_t>(lane(ended_steps_, i));
      end.state = ray;
      end.state.t = ray.t + lane(elapsed, i);
      end.state.u = lane(ended_.u, i);
      end.state.u_rate = lane(ended_.u_rate, i);
      turn_back(ray, lane(cos_drag, i), lane(sin_drag, i), i, end.state);
    }
    waiting_ = 0;
  }

  /// Undoes the turn of put() and adds the drag.
  void turn_back(const SeparatedState& ray, double cos_drag, double sin_drag, int i, SeparatedState& out) const {
    const double sine = sqrt(square(ray.n[0]) + square(ray.n[1]));
    const double rate = sqrt(square(ray.n_rate[0]) + square(ray.n_rate[1]));
    const double cos_start = sine > 0.0 ? ray.n[0] / sine : rate > 0.0 ? ray.n_rate[0] / rate : 1.0;
    const double sin_start = sine > 0.0 ? ray.n[1] / sine : rate > 0.0 ? ray.n_rate[1] / rate : 0.0;
    const double cosine = cos_start * cos_drag - sin_start * sin_drag;
    const double turn = sin_start * cos_drag + cos_start * sin_drag;
    const auto rotate = [&](const std::array<T, 3>& v) {
      const double x = lane(v[0], i), y = lane(v[1], i);
      return std::array{cosine * x - turn * y, turn * x + cosine * y, lane(v[2], i)};
    };
    out.n = rotate(ended_.n);
    out.n_rate = rotate(ended_.n_rate);
  }

  Batch batch_;
  std::size_t next_ = 0;

  std::array<std::size_t, slots> index_{};
  Bool active_{};
  Constants<T> constants_{};
  State<T> state_{};
  Series<T, N, Timed> series_{};
  T longest_{}, mino_{}, windings_{}, steps_{}, sign_p_{}, branch_{};
  BranchSums<T, Timed> sums_{};

  int waiting_ = 0;  ///< rays that have ended and are not finished
  std::array<std::size_t, slots> waiting_index_{};
  std::array<Status, slots> waiting_status_{};
  State<T> ended_{};
  T ended_branch_{}, ended_mino_{}, ended_windings_{}, ended_steps_{};
  BranchSums<T, Timed> ended_sums_{};
};

}  // namespace xpr::first_integrals
