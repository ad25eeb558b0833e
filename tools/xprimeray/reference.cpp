// xprimeray reference: the tables of reference_data/, listed, checked, and computed anew.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "core/io/atomic_output.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "core/io/reference_table.hpp"
#include "validation/truth/stored_tables.hpp"
#include "validation/truth/tables.hpp"

namespace xpr::cli {
namespace {

struct ReferenceOptions {
  std::vector<std::string> tables;
  std::string data;
  std::string out;
  bool regenerate = false;
  bool check = false;
  OutputFlags output;
};

constexpr const char* folder_here = "reference_data";

/// A table to be read: from a file, or the one that was built in.
struct Source {
  std::string name;
  std::function<ReferenceTable()> read;
};

/// The folder that is asked for, or the one that stands here, or what was built in.
std::vector<Source> sources(const ReferenceOptions& options) {
  std::vector<Source> out;
  if (options.data.empty() && !std::filesystem::is_directory(folder_here)) {
    for (const StoredTable& table : stored_tables()) {
      out.push_back({std::string(table.name), [name = table.name] { return stored_table(name); }});
    }
    return out;
  }
  for (const auto& file : reference_files(options.data.empty() ? folder_here : options.data)) {
    out.push_back({file.stem().string(), [file] { return read_reference(file); }});
  }
  return out;
}

/// A table as the user sees it.
struct Line {
  std::string name;
  std::string rank = "na", digits = "na", rows = "na", origin = "na";
  std::string state;
};

Line line_of(const ReferenceTable& table, std::string state) {
  return {table.name,
          std::string(to_string(rank_of(table))),
          fmt::format("{}", table.digits),
          fmt::format("{}", table.rows.size()),
          table.origin,
          std::move(state)};
}

void print(const std::vector<Line>& lines, const OutputFlags& output) {
  if (output.json) {
    for (const Line& l : lines) {
      fmt::print("{}\n", Json{{"event", "table"},
                              {"name", l.name},
                              {"rank", l.rank},
                              {"digits", l.digits},
                              {"rows", l.rows},
                              {"origin", l.origin},
                              {"state", l.state}}
                             .dump());
    }
    return;
  }
  if (output.quiet) return;
  std::size_t name = 5, rank = 4;
  for (const Line& l : lines) name = std::max(name, l.name.size()), rank = std::max(rank, l.rank.size());
  fmt::print("{:{}}  {:{}}  {:>6}  {:>4}  {:8}  {}\n", "table", name, "rank", rank, "digits", "rows", "origin",
             "state");
  for (const Line& l : lines) {
    fmt::print("{:{}}  {:{}}  {:>6}  {:>4}  {:8}  {}\n", l.name, name, l.rank, rank, l.digits, l.rows, l.origin,
               l.state);
  }
}

const ReferenceMaker* maker_of(std::string_view name) {
  const auto& makers = reference_makers();
  const auto found = std::find_if(makers.begin(), makers.end(), [&](const auto& maker) { return maker.name == name; });
  return found == makers.end() ? nullptr : &*found;
}

bool chosen(const ReferenceOptions& options, std::string_view name) {
  return options.tables.empty() ||
         std::find(options.tables.begin(), options.tables.end(), name) != options.tables.end();
}

/// Refuses names that nothing has.
void check_names(const ReferenceOptions& options, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  for (const std::string& name : options.tables) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError("reference: " + unknown_name("table", name, views));
  }
}

int regenerate(const ReferenceOptions& options) {
  std::vector<std::string> known;
  std::vector<const ReferenceMaker*> makers;
  for (const ReferenceMaker& maker : reference_makers()) {
    known.emplace_back(maker.name);
    if (chosen(options, maker.name)) makers.push_back(&maker);
  }
  check_names(options, known);
  catch_interrupts();
  const std::filesystem::path folder = !options.out.empty()   ? options.out
                                       : options.data.empty() ? folder_here
                                                              : options.data;
  if (options.out.empty()) (void)reference_files(folder);  // it has to be there
  std::vector<std::pair<Line, std::string>> made;
  {
    ProgressLine progress("reference", !options.output.quiet && !options.output.json);
    for (const ReferenceMaker* maker : makers) {
      progress.update(static_cast<std::int64_t>(made.size()), static_cast<std::int64_t>(makers.size()));
      if (interrupted()) throw Interrupted("");
      const ReferenceTable table = maker->make();
      made.emplace_back(line_of(table, "written"), reference_text(table));
    }
  }
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw_system_error(folder, "create the folder", problem.value());
  std::vector<Line> lines;
  for (const auto& [line, text] : made) {
    write_file(folder / (line.name + ".csv"), text);
    lines.push_back(line);
  }
  print(lines, options.output);
  return 0;
}

/// What a stored table is worth: its hash, and where asked its digits. `digits_differ` is set where they do.
Line examined(const ReferenceTable& table, bool recompute, bool& digits_differ) {
  if (!recompute) return line_of(table, "hash agrees");
  const ReferenceMaker* maker = maker_of(table.name);
  if (maker == nullptr) return line_of(table, "hash agrees; nothing here computes it");
  const std::optional<std::string> difference = first_difference(table, maker->make());
  digits_differ = digits_differ || difference.has_value();
  return line_of(table, difference ? "differs: " + *difference : "every digit agrees");
}

int examine(const ReferenceOptions& options) {
  const std::vector<Source> tables = sources(options);
  std::vector<std::string> known;
  for (const Source& table : tables) known.push_back(table.name);
  check_names(options, known);
  catch_interrupts();
  std::vector<Line> lines;
  std::vector<std::string> problems;
  bool digits_differ = false;
  {
    ProgressLine progress("reference", options.check && !options.output.quiet && !options.output.json);
    for (const Source& table : tables) {
      progress.update(static_cast<std::int64_t>(lines.size()), static_cast<std::int64_t>(tables.size()));
      if (!chosen(options, table.name)) continue;
      if (interrupted()) throw Interrupted("");
      try {
        lines.push_back(examined(table.read(), options.check, digits_differ));
      } catch (const InputError& error) {
        problems.emplace_back(error.what());
        lines.push_back({.name = table.name, .state = "refused"});
      }
    }
  }
  print(lines, options.output);
  for (const std::string& problem : problems) fmt::print(stderr, "xprimeray: {}\n", problem);
  if (!problems.empty()) return 2;
  return digits_differ ? 1 : 0;
}

int run_reference(const ReferenceOptions& options) {
  if (options.regenerate && options.check) throw InputError("reference: --regenerate or --check, not both");
  if (!options.out.empty() && !options.regenerate) throw InputError("reference: --out goes with --regenerate");
  return options.regenerate ? regenerate(options) : examine(options);
}

}  // namespace

Command register_reference(CLI::App& program) {
  const auto options = std::make_shared<ReferenceOptions>();
  CLI::App* app = program.add_subcommand("reference", "List, check and compute anew the tables of reference_data/");
  app->add_option("tables", options->tables, "Only these (default: all)");
  app->add_flag("--regenerate", options->regenerate, "Compute the tables from nothing and write them");
  app->add_flag("--check", options->check,
                "Compute the tables from nothing and compare every digit; exit 1 where one differs");
  app->add_option("--data", options->data,
                  "The folder of the tables (default: reference_data here, else those built in)");
  app->add_option("--out", options->out, "With --regenerate: write there instead");
  add_output_flags(*app, options->output);
  add_example(*app,
              "  xprimeray reference\n"
              "  xprimeray reference --check schwarzschild_deflection\n"
              "  xprimeray reference --regenerate --out /tmp/reference\n"
              "Exit code 2 where a file was changed by hand, 1 where a digit differs from its recomputation.");
  return {app, [options] { return run_reference(*options); }};
}

}  // namespace xpr::cli
