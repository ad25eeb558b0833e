// A report card as files: card.md, card.html, card.json, card.h5 with every number, badge.svg, figures/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/provenance.hpp"
#include "reports/figures.hpp"
#include "validation/grading/card.hpp"

namespace xpr {

struct CardInputs {
  const Examiner* examiner = nullptr;
  std::vector<ReportCard> cards;  ///< one for each table, at least one
  std::string name;               ///< of the code that is graded
  std::string command;            ///< that repeats it
  Json configuration;             ///< resolved
  Provenance provenance;
  double seconds = 0.0;
  std::vector<std::string> notes;  ///< said on the page: what an adapter did
  FigureTools figure_tools;

  /// The card that the headline is of: the one at the tightest tolerance, the last of those without.
  [[nodiscard]] const ReportCard& main_card() const;
};

/// Throws where no card can be written there, before any work is done.
void check_card_directory(const std::filesystem::path& directory);

/// Writes the card into a directory that is complete or absent. Returns what could not be drawn.
[[nodiscard]] std::vector<std::string> write_card(const CardInputs& inputs, const std::filesystem::path& directory);

/// "A+", or "F as handed in, A+ once the mistakes of convention are undone".
[[nodiscard]] std::string grade_text(const ReportCard& card);

/// The card as text for the terminal.
[[nodiscard]] std::string card_text(const CardInputs& inputs);

/// The card as JSON.
[[nodiscard]] Json card_json(const CardInputs& inputs);

}  // namespace xpr
