// The results as JUnit XML, for the machines that show test results: a testsuite for each case, a testcase for each
// row. A row without a verdict of pass is never green: fail and inconclusive are failures, error is an error, skipped
// is skipped. Planted faults are a testsuite of their own, in which a fault that went unnoticed is a failure.
#pragma once

#include <string>

#include "validation/result.hpp"

namespace xpr {

[[nodiscard]] std::string junit_xml(const SuiteResult& suite);

}  // namespace xpr
