// The verdict for programs: summary.json. Numbers that are not finite are written as strings ("nan", "inf", "-inf").
#pragma once

#include <string>

#include "reports/contents.hpp"

namespace xpr {

[[nodiscard]] std::string summary_json(const Contents& contents);

}  // namespace xpr
