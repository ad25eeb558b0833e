// Rays in one chart, transport in another: what `xprimeray trace`, the camera and the suite call for a whole ray.
//
// The start is mapped into the transport chart (regular by default), traced, and mapped back; spherical angles come out
// continuous along the ray, whatever chart the transport ran in (DESIGN section 7).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/ray_angles.hpp"
#include "integrators/tracer.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/spacetime.hpp"

namespace xpr {

/// One row of a ray table as it comes in.
struct Ray {
  std::int64_t id = 0;
  PhaseState<double> start{};
  int sheet = 1;
};

/// One row of a ray table as it goes out, in the chart in which the ray came in.
struct TracedRay {
  std::int64_t id = 0;
  Status status = Status::outside_domain;
  int sheet = 1;
  PhaseState<double> end{};
  double lambda = 0.0;
  std::int64_t steps = 0;
  std::int64_t rejected = 0;
  std::int64_t evaluations = 0;
  double null_residual = 0.0;
  double null_residual_max = 0.0;
};

struct TransportSettings {
  std::string metric = "kerr";
  std::vector<NamedValue> parameters = {};
  std::string chart = {};            ///< of the ray table; empty: the metric's first
  std::string transport_chart = {};  ///< empty: the regular one, chosen for each ray by the sign of p^t
  TraceSettings trace = {};          ///< stops left unset get their defaults (DESIGN section 4)
};

/// What lengths are measured in: the mass where there is one, else the throat, the lens, the ellipsoid, else one.
[[nodiscard]] double length_unit_of(const Spacetime& spacetime);

/// A spacetime made ready to transport rays. Immutable; trace() may be called from many threads.
class Transport {
 public:
  /// Throws std::invalid_argument for unknown ids, parameters out of range, settings that make no sense.
  explicit Transport(TransportSettings settings);
  ~Transport();

  [[nodiscard]] const TransportSettings& settings() const { return settings_; }
  [[nodiscard]] const Spacetime& chart() const { return *chart_; }

  /// |g^{mu nu} p_mu p_nu| / (n.p)^2 of a start, in the table's chart.
  [[nodiscard]] double off_cone(const Ray& ray) const;
  /// Whether physics and the charts admit a start: inside its domain, finite, with a direction in time, on a sheet that
  /// there is.
  [[nodiscard]] bool admits(const Ray& ray) const;
  /// The same ray put onto the light cone by solving for p_0, keeping the sign of p^t. Unchanged where no real root
  /// exists.
  [[nodiscard]] Ray renormalised(const Ray& ray) const;
  /// Traces one ray to its stop. A start that physics does not admit comes back as `outside_domain`.
  [[nodiscard]] TracedRay trace(const Ray& ray) const;
  /// Traces ray k into out[k], `lanes` at a time (see batch_tracer.hpp): the bits of trace(), whatever the width.
  void trace(std::span<const Ray> rays, int lanes, std::span<TracedRay> out) const;

 private:
  /// A start that is admitted, in the chart that will transport it.
  struct Departure {
    const Spacetime* chart = nullptr;
    ChartState start;
    double r_max = 0.0;
  };
  [[nodiscard]] std::optional<Departure> departure(const Ray& ray) const;
  [[nodiscard]] TracedRay arrival(const Ray& ray, const RayEnd& end, const RayAngles& angles) const;
  void trace_in_lanes(std::span<const Ray> rays, const Spacetime& chart, std::span<const Departure> departures,
                      std::span<const std::size_t> places, int lanes, std::span<TracedRay> out) const;

  TransportSettings settings_;
  std::unique_ptr<Spacetime> chart_;
  std::unique_ptr<Spacetime> forward_;   ///< transport chart for p^t > 0
  std::unique_ptr<Spacetime> backward_;  ///< for p^t < 0
};

}  // namespace xpr
