// What every report of this program says of where it comes from.
#pragma once

#include <string>

#include "reports/report.hpp"

namespace xpr::cli {

/// A report on `suite` with provenance, circumstances and the axes of its coverage matrix; command and configuration
/// are the caller's to add.
[[nodiscard]] ReportInputs new_report(SuiteResult suite, int threads, const std::string& out, double seconds);

}  // namespace xpr::cli
