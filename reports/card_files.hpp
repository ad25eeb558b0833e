// The files of a report card that are no pages.
#pragma once

#include <filesystem>
#include <string>

#include "reports/card_report.hpp"

namespace xpr {

/// Every number of a card, ray by ray: /cards/<k>/ray/<column>.
void write_card_h5(const CardInputs& inputs, const std::filesystem::path& path);

/// A badge: the set and the grade.
[[nodiscard]] std::string badge_svg(std::string_view set, Letter grade);

}  // namespace xpr
