#include "validation/grading/exact_medium_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "metrics/medium_exact.hpp"

namespace xpr {
namespace {

using medium_exact::Vector;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The least phase >= 0 at which amplitude cos(phase - shift) = value, rising or falling; nothing where it never is.
std::optional<double> phase_at(double amplitude, double shift, double value, bool rising) {
  const double ratio = value / amplitude;
  // A point that rounding puts past the extreme is the extreme.
  if (!(std::abs(ratio) <= 1.0 + 8.0 * epsilon)) return std::nullopt;
  const double angle = std::acos(std::clamp(ratio, -1.0, 1.0));
  constexpr double turn = 2.0 * std::numbers::pi;
  double phase = rising ? shift - angle : shift + angle;
  phase -= turn * std::floor(phase / turn);
  // A start that stands there already is a whole turn early by rounding.
  return turn - phase < 64.0 * epsilon ? 0.0 : phase;
}

/// A point on the way of light of unit energy.
struct Point {
  Vector x{}, p{};
  double lambda = 0.0;
  double time = 0.0;
};

class MediumCourse : public ExactRay {
 public:
  MediumCourse(double R, const PhaseState<double>& y) : R_(R), start_(y), energy_(std::abs(y[4])) {
    for (std::size_t i = 0; i < 3; ++i) {
      first_.x[i] = y[i + 1];
      first_.p[i] = y[i + 5] / energy_;
    }
  }
  [[nodiscard]] bool captured() const override { return false; }
  [[nodiscard]] int turns_at_end() const override { return dot(first_.x, first_.p) < 0.0 ? 1 : 0; }

  [[nodiscard]] ExactEnd at(double radius, int turns) const override {
    ExactEnd end;
    if (!(radius > 0.0) || !std::isfinite(radius) || turns > turns_at_end()) return end;
    const std::optional<Point> there = point_at(radius, turns == 1 || turns_at_end() == 0);
    if (!there) return end;
    const double sense = start_[4] < 0.0 ? 1.0 : -1.0;
    end.reached = true;
    end.state[0] = start_[0] + sense * there->time;
    end.state[4] = start_[4];
    const double distance = std::sqrt(dot(there->x, there->x));
    for (std::size_t i = 0; i < 3; ++i) {
      end.state[i + 1] = there->x[i];
      end.state[i + 5] = energy_ * there->p[i];
      end.direction[i] = there->x[i] / distance;
    }
    end.lambda = there->lambda / energy_;
    // Some ten operations, each on numbers of the size of R and |x|.
    end.direction_error = 16.0 * epsilon * (1.0 + R_ / distance);
    return end;
  }

 protected:
  [[nodiscard]] virtual std::optional<Point> point_at(double radius, bool outward) const = 0;
  [[nodiscard]] const Point& first() const { return first_; }

  double R_;

 private:
  PhaseState<double> start_;
  double energy_;
  Point first_;
};

class LuneburgCourse final : public MediumCourse {
 public:
  using MediumCourse::MediumCourse;

 private:
  /// Along the straight line through `from` to the distance `radius`, behind or beyond the point next to the centre.
  [[nodiscard]] static std::optional<Point> straight(const Point& from, double radius, bool outward) {
    const double along = dot(from.x, from.p);
    const double size = dot(from.x, from.x);
    const double under = along * along + (radius * radius - size);
    if (under < 0.0) return std::nullopt;
    const double way = (outward ? std::sqrt(under) : -std::sqrt(under)) - along;
    Point to = from;
    for (std::size_t i = 0; i < 3; ++i) to.x[i] += way * from.p[i];
    to.lambda += way;
    to.time += way;
    return to;
  }

  /// Inside the lens |x|^2/R^2 = 1 + (A - 1) cos 2w + C sin 2w, w = lambda/R, A = |x0|^2/R^2, C = x0.p0/R.
  [[nodiscard]] std::optional<Point> inside(const Point& from, double radius, bool outward) const {
    const double A = dot(from.x, from.x) / (R_ * R_), C = dot(from.x, from.p) / R_;
    const auto phase =
        phase_at(std::hypot(A - 1.0, C), std::atan2(C, A - 1.0), (radius / R_ - 1.0) * (radius / R_ + 1.0), outward);
    if (!phase) return std::nullopt;
    const double lambda = 0.5 * R_ * *phase;
    const medium_exact::RayPoint there = medium_exact::luneburg_ray(R_, from.x, from.p, lambda);
    const ExactValue path = medium_exact::luneburg_optical_path(R_, from.x, from.p, lambda);
    return Point{there.position, there.momentum, from.lambda + lambda, from.time + path.value};
  }

  [[nodiscard]] std::optional<Point> point_at(double radius, bool outward) const override {
    Point from = first();
    const double along = dot(from.x, from.p), size = dot(from.x, from.x);
    if (size > R_ * R_) {
      const bool meets = along < 0.0 && size - along * along < R_ * R_;
      if (!meets || (radius >= R_ && !outward)) return straight(from, radius, outward);
      from = straight(from, R_, false).value();
    }
    if (radius < R_) return inside(from, radius, outward);
    const std::optional<Point> rim = inside(from, R_, true);
    return rim ? straight(*rim, radius, true) : std::nullopt;
  }
};

class FisheyeCourse final : public MediumCourse {
 public:
  using MediumCourse::MediumCourse;

 private:
  /// The height h = (|x|^2 - R^2)/(|x|^2 + R^2) on the 3-sphere is h0 cos psi + (x0.p0/R) sin psi, psi = t/R.
  [[nodiscard]] std::optional<Point> point_at(double radius, bool outward) const override {
    const Point& from = first();
    const auto height = [&](double size) { return (size - R_ * R_) / (size + R_ * R_); };
    const double h0 = height(dot(from.x, from.x)), slope = dot(from.x, from.p) / R_;
    const auto psi = phase_at(std::hypot(h0, slope), std::atan2(slope, h0), height(radius * radius), outward);
    if (!psi) return std::nullopt;
    const double time = R_ * *psi;
    const medium_exact::RayPoint there = medium_exact::fisheye_ray(R_, from.x, from.p, time);
    return Point{there.position, there.momentum, medium_exact::fisheye_affine_parameter(R_, from.x, from.p, time).value,
                 time};
  }
};

}  // namespace

std::unique_ptr<ExactRay> luneburg_course(double R, const PhaseState<double>& start) {
  return std::make_unique<LuneburgCourse>(R, start);
}

std::unique_ptr<ExactRay> fisheye_course(double R, const PhaseState<double>& start) {
  return std::make_unique<FisheyeCourse>(R, start);
}

}  // namespace xpr
