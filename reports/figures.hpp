// Draws figures by running a Python script on the HDF5 file of a report or of an error map.
//
//   <python> <script> <file.h5> <directory>
//
// The script writes <name>.svg and <name>.png and an index.json: {"figures": [{"name", "title", "caption"}],
// "problems": ["..."]}. It may fail in any way: what it left is removed and the reason is returned.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/page.hpp"

namespace xpr {

struct FigureTools {
  std::filesystem::path python;  ///< empty: none was found
  std::filesystem::path script;
  std::chrono::seconds limit{180};  ///< a script that takes longer is stopped
};

struct FigureSet {
  std::vector<Picture> drawn;
  std::vector<std::string> problems;  ///< what could not be drawn, and why: printed loudly
};

/// The Python that the build found, and the script of that name in the source tree of the build, else in
/// share/xprimeray/figures beside the directory of the running program. The environment variables XPRIMERAY_PYTHON and
/// XPRIMERAY_FIGURE_SCRIPT take precedence; XPRIMERAY_PYTHON set to nothing means that none is there.
[[nodiscard]] FigureTools found_figure_tools(const std::string& script = "report_figures.py");

/// Draws what `data`, a file in `directory`, holds into `directory`/figures. Never throws for what the script does.
[[nodiscard]] FigureSet draw_figures(const FigureTools& tools, const std::filesystem::path& directory,
                                     const std::string& data = "report.h5");

}  // namespace xpr
