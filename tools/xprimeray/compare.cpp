// xprimeray compare: two reports or two frames.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "core/film/film_class.hpp"
#include "core/film/frame_file.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "reports/report_difference.hpp"
#include "validation/frame_difference.hpp"

namespace xpr::cli {
namespace {

struct CompareOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string before, after;
  int most = 10;
};

bool has_frame(const std::filesystem::path& directory) {
  return std::filesystem::is_regular_file(directory / frame_file_name);
}

std::string place_in(const FilmFrame& frame, std::size_t pixel) {
  const auto columns = static_cast<std::size_t>(frame.columns);
  // As pictures are read: the first row is the upper one.
  return fmt::format("column {}, row {}", pixel % columns, static_cast<std::size_t>(frame.rows) - 1 - pixel / columns);
}

std::string frame_text(const FrameDifference& difference, const FilmFrame& frame) {
  if (difference.unchanged()) return fmt::format("unchanged: {} pixels, bit for bit\n", difference.pixels);
  const auto moved = std::count(difference.moved.begin(), difference.moved.end(), std::uint8_t{1});
  std::string text = fmt::format("changed: {} of {} pixels; mean colour difference {:.3g} of 255\n", moved,
                                 difference.pixels, difference.mean_colour);
  for (const PlaneDifference& plane : difference.planes) {
    text += fmt::format("  {:<20} {:>9} pixels, at most {:.3g}, {} ULPs; first at {}\n", plane.name, plane.pixels,
                        plane.most, plane.ulps, place_in(frame, plane.first));
  }
  for (const ClassChange& change : difference.classes) {
    text += fmt::format("  {} -> {}: {} pixels\n", film_class_names[change.before], film_class_names[change.after],
                        change.pixels);
  }
  for (const std::string& name : difference.gone) text += fmt::format("  {} is in the first frame only\n", name);
  for (const std::string& name : difference.added) text += fmt::format("  {} is in the second frame only\n", name);
  return text;
}

Json frame_json(const FrameDifference& difference) {
  Json planes = Json::array();
  for (const PlaneDifference& plane : difference.planes) {
    planes.push_back({{"plane", plane.name},
                      {"pixels", plane.pixels},
                      {"most", json_number(plane.most)},
                      {"ulps", plane.ulps},
                      {"first", plane.first}});
  }
  Json classes = Json::array();
  for (const ClassChange& change : difference.classes) {
    classes.push_back({{"before", film_class_names[change.before]},
                       {"after", film_class_names[change.after]},
                       {"pixels", change.pixels}});
  }
  return {{"event", "result"},
          {"unchanged", difference.unchanged()},
          {"pixels", difference.pixels},
          {"planes", std::move(planes)},
          {"classes", std::move(classes)},
          {"mean_colour", json_number(difference.mean_colour)}};
}

int compare_two_frames(const CompareOptions& options) {
  const FilmFrame before = read_frame(options.before), after = read_frame(options.after);
  const FrameDifference difference = [&] {
    try {
      return compare_frames(before, after);
    } catch (const std::invalid_argument& error) {
      throw InputError(fmt::format("compare: {} and {}: {}", options.before, options.after, error.what()));
    }
  }();
  if (options.output.json) {
    fmt::print("{}\n", frame_json(difference).dump());
  } else if (!options.output.quiet) {
    fmt::print("{}", frame_text(difference, before));
  }
  return difference.unchanged() ? 0 : 1;
}

int compare_two_reports(const CompareOptions& options) {
  const ReportDifference difference = compare_reports(options.before, options.after);
  if (options.output.json) {
    fmt::print("{}\n", Json{{"event", "result"},
                            {"rows", difference.rows},
                            {"verdicts_moved", difference.verdicts.size()},
                            {"numbers_moved", difference.values.size()},
                            {"gone", difference.gone},
                            {"new", difference.added}}
                           .dump());
  } else if (!options.output.quiet) {
    fmt::print("{}", difference_text(difference, static_cast<std::size_t>(options.most)));
  }
  return difference.same_verdicts() ? 0 : 1;
}

int run_compare(CompareOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  if (options.before.empty() || options.after.empty()) {
    throw InputError("compare: needs two directories, both reports or both frames");
  }
  if (options.most < 0) throw InputError("compare: --most is negative, needs 0 or more");
  if (has_frame(options.before) && has_frame(options.after)) return compare_two_frames(options);
  if (has_report(options.before) && has_report(options.after)) return compare_two_reports(options);
  for (const std::string& directory : {options.before, options.after}) {
    if (!has_frame(directory) && !has_report(directory)) {
      throw InputError(
          fmt::format("compare: {}: neither a report nor a frame; needs a directory with report.h5, "
                      "paper.h5 or {}",
                      directory, frame_file_name));
    }
  }
  throw InputError("compare: one is a report and the other a frame; needs two of a kind");
}

}  // namespace

Command register_compare(CLI::App& program) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App& app = *program.add_subcommand("compare", "Two reports or two frames: what moved, and by how much");
  options->app = &app;
  app.add_option("before", options->before, "Directory of the first");
  app.add_option("after", options->after, "Directory of the second");
  app.add_option("--most", options->most, "How many changes of each kind to name")->capture_default_str();
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app,
              "  xprimeray compare before after\n"
              "with `xprimeray validate --suite quick --out before`, and `--out after`, run earlier.\n"
              "Exit code: 0 nothing moved (of reports: no verdict, no row), 1 something did, 2 bad usage.");
  return {&app, [options] { return run_compare(*options); }};
}

}  // namespace xpr::cli
