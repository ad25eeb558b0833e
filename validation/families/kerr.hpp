// The Kerr family's parts, one file each, put together in kerr.cpp, and what they share.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "validation/case.hpp"
#include "validation/kit.hpp"

namespace xpr::kerr_family {

inline constexpr double mass = 1.0;

/// Boyer-Lindquist and the chart that rays run in.
[[nodiscard]] Charts charts(const Lab& lab, double spin, std::string_view transport);

/// Light at (r, theta) with E = 1, L and p_theta in the transport chart, to be followed towards smaller r: forward in
/// time, or, in `kerr-schild-outgoing`, backward from where it goes outward, as a camera does.
[[nodiscard]] ChartState inward_light(const Charts& at, double r, double theta, double L, double p_theta);

/// |b d alpha / d b| + 1 of an equatorial ray, by a central difference of the closed form: how much a relative error of
/// b is amplified.
[[nodiscard]] double deflection_condition(double spin, double b);

/// A CaseInfo of this family: "kerr/" + name.
[[nodiscard]] CaseInfo info(std::string_view name, std::string claim, std::string physics, std::string truth,
                            TruthRank rank, std::string cites, std::string source);

[[nodiscard]] std::vector<Case> orbit_cases();     ///< spherical photon orbits, principal null rays, the past horizon
[[nodiscard]] std::vector<Case> shadow_cases();    ///< what a camera sees: the shadow's edge, the equatorial plane
[[nodiscard]] std::vector<Case> constant_cases();  ///< E, L_z and Q; one ray in every chart

[[nodiscard]] std::vector<Fault> orbit_faults();
[[nodiscard]] std::vector<Fault> shadow_faults();
[[nodiscard]] std::vector<Fault> constant_faults();

}  // namespace xpr::kerr_family
