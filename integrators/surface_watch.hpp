// Watches a ray for surfaces g(y) = 0: notices that a step meets one, even twice or nearly tangentially, and locates
// the meeting to round-off.
//
// A surface met at a step's end is found by the sign of g there. One that is met and left again within a step is found
// by samples between and by the slopes of g at both ends: g must have at most one dip between neighbouring samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "integrators/stepper.hpp"
#include "integrators/tracer.hpp"

namespace xpr {

/// What a surface is for.
enum class SurfaceKind { radius, proper_distance, interface, half_plane, event };

/// One surface and which side of it the ray is on.
struct Surface {
  SurfaceKind kind = SurfaceKind::event;
  double level = 0.0;            ///< radius and proper_distance: g is their difference to this
  const Event* event = nullptr;  ///< kind event: its g
  std::size_t index = 0;         ///< kind event: its place in the list given
  int direction = 0;             ///< +1: only where g rises along the ray; -1: only where it falls; 0: both
  bool terminal = false;         ///< the ray ends there
  bool cuts = false;             ///< the step ends there and the ray goes on
  Status status = Status::crossed;
  int side = 0;  ///< sign of g on the ray so far; 0 while the ray has been on the surface only
};

/// A meeting within a step.
struct Crossing {
  std::size_t surface = 0;
  double theta = 0.0;  ///< fraction of the step
  int direction = 0;   ///< +1: g rises
  PhaseState<double> y;
};

/// The step that was just made, as the watch sees it.
struct StepPath {
  const Spacetime& chart;
  int sheet = 1;
  const PhaseState<double>& begin;
  const PhaseState<double>& end;
  double h = 0.0;
  Stepper& stepper;

  [[nodiscard]] PhaseState<double> at(double theta) const { return stepper.interpolate(theta); }
};

class SurfaceWatch {
 public:
  SurfaceWatch(std::vector<Surface> surfaces, double length_unit)
      : surfaces_(std::move(surfaces)), length_unit_(length_unit) {}

  [[nodiscard]] const Surface& surface(std::size_t i) const { return surfaces_[i]; }
  [[nodiscard]] bool empty() const { return surfaces_.empty(); }

  /// g of surface i.
  [[nodiscard]] double value(std::size_t i, const Spacetime& chart, const PhaseState<double>& y, int sheet) const;

  [[nodiscard]] std::size_t size() const { return surfaces_.size(); }

  /// Forgets the last ray; the next escapes at r_max.
  void restart(std::optional<double> r_max);
  /// Where the ray is before a step that another watched so far: g of surface i there, and its side.
  void take_up(std::size_t i, double g, int side) {
    g_begin_[i] = g;
    surfaces_[i].side = side;
  }

  /// Notes on which sides the ray begins.
  void begin(const Spacetime& chart, const PhaseState<double>& y, int sheet);

  /// The crossings of a step, in order, up to the first that ends or cuts it; sides are those after it. With a method
  /// whose interpolant is not good enough, the stepper's last step is the cut one afterwards.
  /// Surfaces whose bit is set in `far` are known not to be met and not looked for.
  [[nodiscard]] std::span<const Crossing> crossings(const StepPath& path, std::uint32_t far = 0);
  /// Forgets the last crossings(): the step is not taken.
  void take_back();

 private:
  struct Sample {
    double theta;
    double g;
  };

  void search(std::size_t i, const StepPath& path, const PhaseState<double>& middle);
  void locate(std::size_t i, const StepPath& path, Sample from, Sample to);
  void add_crossing(std::size_t i, const StepPath& path, double theta, bool rises);
  [[nodiscard]] double end_fraction(const PhaseState<double>& y, const PhaseState<double>& rate, double h) const;

  std::vector<Surface> surfaces_;
  std::vector<double> g_begin_;
  std::vector<double> g_before_;  ///< of the last crossings()
  std::vector<int> sides_before_;
  double length_unit_;
  std::vector<Crossing> found_;
};

}  // namespace xpr
