// A figure as data: panels of named series, drawn from the HDF5 file by tools/figures/paper_figures.py.
#pragma once

#include <string>
#include <vector>

namespace xpr {

/// How a series is drawn.
enum class Look {
  line,     ///< the exact curve
  dashed,   ///< an approximation
  dotted,   ///< a guide: a critical value, a horizon
  dots,     ///< what was traced
  printed,  ///< numbers as printed
  area,     ///< a filled outline
};

struct Series {
  std::string name;  ///< empty: not in the legend
  Look look = Look::line;
  std::vector<double> x;
  std::vector<double> y;
};

struct Panel {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool x_log = false;
  bool y_log = false;
  bool equal = false;  ///< the same unit on both axes: a picture of space or of a screen
  std::vector<Series> series = {};
};

struct Figure {
  std::string title;
  std::string caption;
  std::vector<Panel> panels;  ///< empty: the paper has no figure here
};

/// x from `first` to `last`, `count` >= 2 of them, evenly or by equal factors.
[[nodiscard]] std::vector<double> even_steps(double first, double last, int count);
[[nodiscard]] std::vector<double> log_steps(double first, double last, int count);

}  // namespace xpr
