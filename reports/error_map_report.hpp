// An error map as files: map.h5 with every number, map.exr with every channel, a figure, a page of text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/provenance.hpp"
#include "reports/figures.hpp"
#include "validation/error_map.hpp"

namespace xpr {

struct ErrorMapInputs {
  ErrorMap map;
  std::vector<ErrorSummary> summary;
  std::string title;    ///< of page and figure: metric, observer, screen, method
  std::string command;  ///< that repeats it
  Json configuration;   ///< resolved
  Provenance provenance;
  double seconds = 0.0;
  FigureTools figure_tools;
};

/// Throws where no error map can be written there, before any work is done.
void check_error_map_directory(const std::filesystem::path& directory);

/// Writes map.h5, map.exr, errormap.md and figures/error-map.{png,svg} into a directory that is complete or absent.
/// Returns what could not be drawn.
[[nodiscard]] std::vector<std::string> write_error_map(const ErrorMapInputs& inputs,
                                                       const std::filesystem::path& directory);

/// The table of errors by class as text, for the page and the terminal.
[[nodiscard]] std::string error_map_table(const std::vector<ErrorSummary>& summary);

}  // namespace xpr
