// A suite made by hand, with every verdict and every awkward thing that a report must lay out: no physics is run.
#pragma once

#include "reports/report.hpp"
#include "validation/result.hpp"

namespace xpr {

/// Every row passes and every fault is caught.
[[nodiscard]] SuiteResult passing_suite();

/// passing_suite() with a failure, an exception, a NaN, an inconclusive truth, a skipped row, and a missed fault.
[[nodiscard]] SuiteResult troubled_suite();

/// Inputs around a suite, with no figure tools.
[[nodiscard]] ReportInputs sample_inputs(SuiteResult suite);

}  // namespace xpr
