// What the case families share: rays with a given impact parameter, swept angles, and rows that are filled and judged
// the same way everywhere.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "integrators/tracer.hpp"
#include "metrics/chart_map.hpp"
#include "metrics/spacetime.hpp"
#include "validation/case.hpp"

namespace xpr {

/// A value with the absolute error of its own computation, as a truth is used here.
struct Truth {
  double value = 0.0;
  double error = 0.0;
};

/// A tolerance and why it is that number.
struct Tolerance {
  double value = 0.0;
  std::string reason;
};

/// A method at a setting: what a row is measured with.
struct MethodAt {
  std::string method;
  double setting = 0.0;  ///< tol for adaptive methods, step in lambda for |p_t| = 1 for the others
  Projection projection = Projection::none;
};

/// "dop853" or "dop853+full": how reports name a method with its projection.
[[nodiscard]] std::string method_label(const MethodAt& method);

/// Trace settings for a method, everything else at its default.
[[nodiscard]] TraceSettings trace_settings(const MethodAt& method, double length_unit = 1.0);

/// The description of a metric's case whose truth is a closed form: id "family/name", defined in families/<family>.cpp.
[[nodiscard]] CaseInfo closed_form_case(std::string_view family, std::string_view name, std::string claim,
                                        std::string physics, std::string truth, std::string cites);

/// A row with its inputs named; value, truth and tolerance are set by `grade`.
[[nodiscard]] Row make_row(std::string label, const Spacetime& chart, const MethodAt& method,
                           std::vector<RowParameter> parameters);

/// Sets value, truth and tolerance, and judges.
void grade(Row& row, double value, const Truth& truth, const Tolerance& tolerance);

/// A one-sided claim, |quantity| <= bound: reference 0.
void grade_bound(Row& row, double quantity, const Tolerance& bound);

/// A row for what could not be measured here, with the reason; printed as loudly as a failure.
[[nodiscard]] Row skipped_row(std::string label, std::string reason, std::string unit = "1");

/// The classical chart of a spacetime, in which truth is evaluated, and the chart that rays run in.
struct Charts {
  std::unique_ptr<Spacetime> classical;
  std::unique_ptr<Spacetime> transport;
};
[[nodiscard]] Charts charts(const Lab& lab, std::string_view metric, std::string_view classical,
                            std::string_view transport, std::span<const NamedValue> values);

/// Makes a row an error, and says so, where the ray did not end as it should have; counts its evaluations.
[[nodiscard]] bool ended_as(Row& row, const RayEnd& end, Status wanted);

/// Light at (r, theta, phi = 0) of `classical` (spherical: t, r or l, theta, phi) with E = 1, azimuthal momentum L,
/// polar momentum p_theta, moving inward or outward, expressed in `chart`. `classical` has no cross terms between the
/// radial coordinate and the others. Throws std::domain_error where no such ray exists.
[[nodiscard]] ChartState general_light(const Spacetime& classical, const Spacetime& chart, double r, double theta,
                                       double L, double p_theta, bool inward = true);

/// The same in the equatorial plane, with L = b (signed).
[[nodiscard]] ChartState equatorial_light(const Spacetime& classical, const Spacetime& chart, double r, double b,
                                          bool inward = true);

/// The past-directed twin of a light ray: p -> -p, which runs the same ray backward in time.
[[nodiscard]] PhaseState<double> reversed(const PhaseState<double>& y);

/// A traced ray, and its end in the classical chart with angles continuous along the ray.
struct SweptRay {
  RayEnd end;
  PhaseState<double> start_classical;
  PhaseState<double> end_classical;
  /// phi at the end less phi at the start, unwrapped.
  [[nodiscard]] double azimuth() const { return end_classical[3] - start_classical[3]; }
};

/// Traces a ray that starts at `start` in `chart` and follows its classical angles.
[[nodiscard]] SweptRay trace_swept(const Lab& lab, const Spacetime& classical, const Spacetime& chart,
                                   const ChartState& start, const TraceSettings& settings,
                                   std::span<const Event> events = {});

/// The angle between the directions (theta, phi) of two states of a spherical chart, without loss near 0 and pi.
[[nodiscard]] double angle_between(const PhaseState<double>& a, const PhaseState<double>& b);

/// L/E of a state, from the chart's own Killing vectors: the truth is evaluated at the stored doubles.
[[nodiscard]] double impact_parameter(const Spacetime& chart, const PhaseState<double>& y);

/// The value of a named Killing constant ("E", "L_z", ...). Throws std::invalid_argument if the chart has none so
/// named.
[[nodiscard]] double killing_constant(const Spacetime& chart, const PhaseState<double>& y, std::string_view name);

/// Bisects on how a ray ends: `escapes(x)` is false at `low` and true at `high`. Stops at `width` or at neighbouring
/// doubles.
template <class Escapes>
[[nodiscard]] double bisect_fate(double low, double high, double width, const Escapes& escapes) {
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    (escapes(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// The truth's own conditioning and the tracer's local tolerance, put together: `steps` local errors of `tol`, each
/// amplified by at most `condition`, plus the same for round-off.
[[nodiscard]] Tolerance accumulated(const RayEnd& ray, double tol, double condition);

/// Of a deflection at b = `ratio` times the critical one: the project's promise for the tightest settings wherever the
/// ray is not near-critical, else what has accumulated.
[[nodiscard]] Tolerance deflection_tolerance(const RayEnd& ray, const MethodAt& method, double ratio, double condition,
                                             double deflection);

}  // namespace xpr
