#include "reports/error_map_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/atomic_output.hpp"
#include "core/io/exr.hpp"
#include "core/io/hdf5_file.hpp"
#include "integrators/status.hpp"
#include "reports/origin.hpp"

namespace xpr {
namespace {

// A directory that holds this file is an earlier error map, and may be replaced.
constexpr const char* marker = "map.h5";

struct Column {
  const char* name;
  const std::vector<double> ErrorMap::*values;
  DatasetText text;
};

std::vector<Column> columns() {
  return {{"alpha", &ErrorMap::alpha, {"1", "screen coordinate to the right, in the unit in which M is given"}},
          {"beta", &ErrorMap::beta, {"1", "screen coordinate upwards, in the unit in which M is given"}},
          {"direction_error", &ErrorMap::direction_error, {"radian", "angle between the ends' directions"}},
          {"swept_error", &ErrorMap::swept_error, {"radian", "error of the swept azimuth"}},
          {"time_error",
           &ErrorMap::time_error,
           {"1", "error of the elapsed coordinate time, in the unit in which M is given"}},
          {"truth_error", &ErrorMap::truth_error, {"radian", "the closed form's own error in direction"}},
          {"condition", &ErrorMap::condition, {"radian", "turn of the end for a step of M on the screen"}}};
}

struct Counts {
  const char* name;
  const std::vector<std::int64_t> ErrorMap::*values;
  const char* long_name;
};

constexpr std::array<Counts, 4> counts{
    {{"status_agrees", &ErrorMap::status_agrees, "1 where the traced ray ends as the exact one does"},
     {"steps", &ErrorMap::steps, "accepted steps"},
     {"rejected", &ErrorMap::rejected, "rejected steps"},
     {"evaluations", &ErrorMap::evaluations, "evaluations of the flow"}}};

void write_h5(const ErrorMapInputs& inputs, const std::filesystem::path& path) {
  const ErrorMap& map = inputs.map;
  Hdf5File file = Hdf5File::create(path);
  file.set_attribute("/", "schema", "xprimeray-error-map");
  file.set_attribute("/", "schema_version", std::int64_t{1});
  file.set_attribute("/", "title", inputs.title);
  for (const Column& column : columns()) {
    file.write(fmt::format("/map/{}", column.name), map.*column.values, column.text);
  }
  for (const Counts& count : counts) {
    file.write(fmt::format("/map/{}", count.name), map.*count.values, {"1", count.long_name});
  }
  file.write_enum("/map/status", map.status, status_names, {"1", "how the traced ray ended"});
  file.write_enum("/map/class", map.pixel_class, pixel_class_names, {"1", "what the ray is, by the closed form"});
  file.set_attribute("/map", "columns", std::int64_t{map.columns});
  file.set_attribute("/map", "rows", std::int64_t{map.rows});
  file.set_attribute("/map", "order", "row by row from the lower left");
  file.set_attribute("/map", "critical_condition", critical_condition);
  write_origin(file, {inputs.provenance, inputs.command, inputs.configuration, {{"rays_hash", map.rays_hash}}});
  file.set_attribute("/volatile", "seconds", inputs.seconds);
  file.close();
}

void write_channels(const ErrorMap& map, const std::filesystem::path& path) {
  std::vector<std::vector<double>> integers;
  std::vector<ImageChannel> channels;
  for (const Column& column : columns()) channels.push_back({column.name, map.*column.values});
  for (const auto* values : {&map.status, &map.pixel_class, &map.status_agrees, &map.steps, &map.evaluations}) {
    integers.emplace_back(values->begin(), values->end());
  }
  constexpr std::array<const char*, 5> names{"status", "class", "status_agrees", "steps", "evaluations"};
  for (std::size_t k = 0; k < names.size(); ++k) channels.push_back({names[k], integers[k]});
  write_exr(path, map.columns, map.rows, channels);
}

std::string number(double x) { return std::isnan(x) ? "na" : fmt::format("{:.1e}", x); }

std::vector<std::string> cells(const ErrorSummary& row) {
  return {row.name,
          std::to_string(row.pixels),
          std::to_string(row.wrong_status),
          number(row.median),
          number(row.p99),
          number(row.most),
          number(row.scaled_p99),
          number(row.swept_median),
          number(row.swept_most),
          std::isnan(row.steps) ? "na" : fmt::format("{:.1f}", row.steps),
          std::isnan(row.evaluations) ? "na" : fmt::format("{:.0f}", row.evaluations)};
}

const std::vector<std::string> headings{"rays",      "pixels", "wrong status",    "median",
                                        "p99",       "max",    "p99 / condition", "swept median",
                                        "swept max", "steps",  "evaluations"};

std::string page_of(const ErrorMapInputs& inputs, const FigureSet& figures) {
  const ErrorSummary& all = inputs.summary.front();
  std::string page = fmt::format("# Error map: {}\n\n", inputs.title);
  page += fmt::format(
      "{} of {} rays end as the closed form says. Errors are angles between the directions of the ends, "
      "in radians.\n\n",
      all.pixels - all.wrong_status, all.pixels);
  page += fmt::format("| {} |\n|{}\n", fmt::join(headings, " | "), [] {
    std::string rule = " --- |";
    for (std::size_t k = 1; k < headings.size(); ++k) rule += " ---: |";
    return rule;
  }());
  for (const ErrorSummary& row : inputs.summary) page += fmt::format("| {} |\n", fmt::join(cells(row), " | "));
  page += fmt::format(
      "\n`near_critical`: the end turns by more than {} rad for a step of M on the screen, or a neighbour's fate is "
      "another. `p99 / condition`: of the errors over the ray's condition, where that is more than 1.\n\n",
      critical_condition);
  for (const Picture& picture : figures.drawn)
    page += fmt::format("![{}]({}.png)\n\n{}\n\n", picture.title, picture.file, picture.caption);
  for (const std::string& problem : figures.problems) page += problem + "\n\n";
  page += fmt::format("Reproduce: `{}`\n\nrays_hash {}; {} {}; every number: map.h5, channels: map.exr.\n",
                      inputs.command, inputs.map.rays_hash, inputs.provenance.version, inputs.provenance.commit);
  return page;
}

}  // namespace

void check_error_map_directory(const std::filesystem::path& directory) {
  const AtomicDirectory probe(directory, marker);
}

std::vector<std::string> write_error_map(const ErrorMapInputs& inputs, const std::filesystem::path& directory) {
  AtomicDirectory out(directory, marker);
  write_h5(inputs, out.path() / "map.h5");
  write_channels(inputs.map, out.path() / "map.exr");
  const FigureSet figures = draw_figures(inputs.figure_tools, out.path(), marker);
  write_file(out.path() / "errormap.md", page_of(inputs, figures));
  out.commit();
  return figures.problems;
}

std::string error_map_table(const std::vector<ErrorSummary>& summary) {
  std::vector<std::vector<std::string>> rows{headings};
  for (const ErrorSummary& row : summary) rows.push_back(cells(row));
  std::vector<std::size_t> width(headings.size());
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}", row[0], width[0]);
    for (std::size_t k = 1; k < row.size(); ++k) text += fmt::format("  {:>{}}", row[k], width[k]);
    text += "\n";
  }
  return text;
}

}  // namespace xpr
