// The families of cases and of planted faults: one function each, put together in cases.cpp and faults.cpp.
#pragma once

#include <vector>

#include "validation/case.hpp"

namespace xpr {

[[nodiscard]] std::vector<Case> conformance_cases();  ///< what must hold of every metric module, whatever it describes
[[nodiscard]] std::vector<Case> flat_cases();         ///< straight lines, aberration
[[nodiscard]] std::vector<Case> schwarzschild_cases();  ///< deflection, capture, the photon sphere, time
[[nodiscard]] std::vector<Case> kerr_cases();   ///< equatorial light, spherical orbits, the shadow, constants, charts
[[nodiscard]] std::vector<Case> ellis_cases();  ///< deflection, transit, the throat
[[nodiscard]] std::vector<Case> media_cases();  ///< uniform, Luneburg, Maxwell
[[nodiscard]] std::vector<Case> grin_cases();   ///< author-controlled fields, the fixtures, tier 0
[[nodiscard]] std::vector<Case> ellipsoid_cases();  ///< geodesics of the ellipsoid
[[nodiscard]] std::vector<Case> numerical_cases();  ///< what the integrators promise of themselves
[[nodiscard]] std::vector<Case> grading_cases();    ///< what report cards say of known rays

[[nodiscard]] std::vector<Fault> metric_faults();         ///< wrong-on-purpose spacetimes
[[nodiscard]] std::vector<Fault> flat_faults();           ///< the axis and aberration gone wrong
[[nodiscard]] std::vector<Fault> schwarzschild_faults();  ///< wrong closed forms
[[nodiscard]] std::vector<Fault> kerr_faults();           ///< wrong closed forms
[[nodiscard]] std::vector<Fault> ellis_faults();          ///< wrong closed forms
[[nodiscard]] std::vector<Fault> media_faults();          ///< a wrong focus
[[nodiscard]] std::vector<Fault> grin_faults();           ///< fields gone wrong as renderers had them wrong
[[nodiscard]] std::vector<Fault> numerical_faults();      ///< wrong steppers, events and projections
[[nodiscard]] std::vector<Fault> grading_faults();        ///< wrong adapters, truths and cards

}  // namespace xpr
