// What the subcommands of xprimeray share. One file for each: it defines register_<name>, which adds a CLI11 subcommand
// to the program and says what to run once the command line has been read. A new subcommand is one such file, one line
// here and one line in main.cpp.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/names.hpp"
#include "metrics/spacetime.hpp"

namespace xpr::cli {

/// A subcommand and its work; the work returns an exit code (DESIGN section 8) or throws what main.cpp maps to one.
struct Command {
  CLI::App* app;
  std::function<int()> run;
};

Command register_sweep(CLI::App& program);
Command register_trace(CLI::App& program);
Command register_list(CLI::App& program);
Command register_explain(CLI::App& program);
Command register_doctor(CLI::App& program);
Command register_conform(CLI::App& program);
Command register_validate(CLI::App& program);
Command register_errormap(CLI::App& program);
Command register_paper(CLI::App& program);
Command register_grade(CLI::App& program);
Command register_render(CLI::App& program);
Command register_repro(CLI::App& program);
Command register_compare(CLI::App& program);
Command register_reference(CLI::App& program);

/// --quiet and --json, as every subcommand that works for long has them.
struct OutputFlags {
  bool quiet = false;  ///< nothing but errors
  bool json = false;   ///< one JSON object a line on standard output
};
void add_output_flags(CLI::App& command, OutputFlags& flags);

/// Throws InputError unless `lanes` is 0, 1, 2, 4 or 8.
void check_lanes(std::string_view command, int lanes);

/// "--help" of every subcommand ends in an example.
void add_example(CLI::App& command, const std::string& lines);

/// Values from a TOML file for the options of a subcommand that the command line left unset. Keys are the long names of
/// the options without the dashes; a table stands for an option that takes name=value. Throws InputError for what is
/// no TOML, for values of a wrong kind, and for unknown keys, naming the nearest known one.
void apply_config(CLI::App& command, const std::string& path);

/// Adds the parameter of "--set a=0.9"; its name is a view into the text. Throws InputError for what is no name=number
/// and for a name that is set already.
void add_parameter(std::vector<NamedValue>& parameters, const std::string& text);

/// A line with an ETA on standard error, where that is a terminal; silent otherwise.
class ProgressLine {
 public:
  ProgressLine(std::string label, bool wanted);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();  // leaves a clean line
  void update(std::int64_t done, std::int64_t total);

 private:
  std::string label_;
  bool shown_;
  bool drawn_ = false;
  double begin_;
  double last_drawn_ = 0.0;
};

/// From now on Ctrl-C (and SIGTERM) is noted instead of ending the program; a second one ends it at once.
void catch_interrupts();
[[nodiscard]] bool interrupted();

/// Seconds on a clock that only goes forward.
[[nodiscard]] double seconds_now();

}  // namespace xpr::cli
