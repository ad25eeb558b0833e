// xprimeray grade: challenge sets out, ray tables in, a report card.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

#include "command.hpp"
#include "core/io/atomic_output.hpp"
#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/ray_table.hpp"
#include "grade.hpp"
#include "metrics/catalogue.hpp"
#include "reports/card_report.hpp"
#include "reports/challenge_sheet.hpp"

namespace xpr::cli {
namespace {

std::vector<Ray> challenge_rays(const ChallengeSet& set, const std::string& chart, std::int64_t count) {
  const auto home = set.spacetime(set.home_chart);
  const auto other = set.spacetime(chart);
  std::vector<Ray> rays;
  for (std::int64_t k = 0; k < count; ++k) rays.push_back(set.ray_in(*other, *home, k));
  return rays;
}

Json challenge_json(const ChallengeSet& set, const std::string& chart, std::int64_t count) {
  Json parameters = Json::object();
  for (const NamedValue& p : set.parameters) parameters[std::string(p.name)] = json_number(p.value);
  return {{"schema", "xprimeray-challenge"},
          {"schema_version", 1},
          {"set", std::string(set.id)},
          {"metric", std::string(set.metric)},
          {"parameters", parameters},
          {"chart", chart},
          {"rays", count},
          {"first_id", set.first_id},
          {"r_max", set.r_max},
          {"captures", set.captures},
          {"version", provenance().version}};
}

int run_export(const GradeOptions& options) {
  const ChallengeSet& set = set_for(options);
  const std::int64_t count = count_for(options, set);
  const std::string chart = chart_for(options, set);
  if (options.out.empty()) throw InputError("grade export: --out is missing, a file that ends in .csv or .h5");
  if (write_challenge(set, chart, count, options.out) && !options.output.quiet) {
    fmt::print("{}: {} rays of '{}' in {}; what they mean: {}.sheet.md\n", options.out, count, set.id, chart,
               options.out);
  }
  return 0;
}

int run_list(const GradeOptions& options) {
  for (const ChallengeSet& set : challenge_sets()) {
    if (options.output.json) {
      fmt::print("{}\n", challenge_json(set, std::string(set.home_chart), set.usual_rays).dump());
    } else {
      fmt::print("  {:<20} {:>5} rays  {}\n", set.id, set.usual_rays, set.title);
    }
  }
  return 0;
}

/// "1e-8=mine.csv" or "mine.csv".
GradedTable table_named(const std::string& text) {
  const std::size_t equals = text.find('=');
  double tolerance = std::numeric_limits<double>::quiet_NaN();
  if (equals == std::string::npos || std::filesystem::exists(text)) return {text, tolerance};
  if (parse_number(text.substr(0, equals), tolerance) != NumberFault::none || !(tolerance > 0.0)) {
    throw InputError(fmt::format("grade score: --rays {}, needs a file, or TOLERANCE=FILE as in 1e-8=mine.csv", text));
  }
  return {text.substr(equals + 1), tolerance};
}

int run_score(const GradeOptions& options) {
  const ChallengeSet& set = set_for(options);
  if (options.rays.empty()) throw InputError("grade score: --rays is missing, a ray table that ends in .csv or .h5");
  CardRequest request;
  for (const std::string& text : options.rays) request.tables.push_back(table_named(text));
  request.chart = chart_for(options, set);
  request.count = count_for(options, set);
  request.name =
      options.name.empty() ? std::filesystem::path(request.tables.front().file).stem().string() : options.name;
  request.command =
      fmt::format("xprimeray grade score --set {} --chart {} --count {}", set.id, request.chart, request.count);
  for (const std::string& text : options.rays) request.command += " --rays " + text;
  return grade_tables(options, set, request);
}

struct Subcommand {
  CLI::App* app;
  std::function<int()> run;
};

CLI::App& add_sub(CLI::App& grade, const char* name, const char* what, GradeOptions& options) {
  CLI::App& app = *grade.add_subcommand(name, what);
  add_output_flags(app, options.output);
  return app;
}

void add_set(CLI::App& app, GradeOptions& options, const char* chart_text) {
  app.add_option("--set", options.set, "Challenge set, as in `xprimeray grade list`");
  app.add_option("--chart", options.chart, chart_text);
  app.add_option("--count", options.count, "How many of its rays (default: 600); more begin with the same ones");
}

std::vector<Subcommand> add_subcommands(CLI::App& grade, const std::shared_ptr<GradeOptions>& options) {
  CLI::App& list = add_sub(grade, "list", "The challenge sets", *options);
  add_example(list, "  xprimeray grade list");

  CLI::App& out = add_sub(grade, "export", "A set's rays, with a sheet that says what they mean", *options);
  add_set(out, *options, "Chart to write them in (default: the classical one)");
  out.add_option("--out", options->out, "Ray table to write: .csv or .h5; FILE.sheet.md goes beside it");
  add_example(out,
              "  xprimeray grade export --set kerr-core --out challenge.csv\n"
              "  xprimeray grade export --set kerr-core --chart kerr-schild --count 5000 --out challenge.h5");

  CLI::App& score = add_sub(grade, "score", "Grade a table of rays that a code has traced", *options);
  add_set(score, *options, "Chart of the table (default: the classical one)");
  score.add_option("--rays", options->rays, "The table, or TOLERANCE=FILE; repeat for work against precision")
      ->type_name("[TOL=]FILE")
      ->allow_extra_args(false);
  score.add_option("--name", options->name, "What the card calls the code (default: the file's name)");
  score.add_option("--out", options->out, "Directory to write: card.md, card.html, card.json, card.h5, badge.svg");
  add_example(score,
              "  xprimeray grade score --set kerr-core --rays mine.csv --out card/\n"
              "  xprimeray grade score --set kerr-core --rays 1e-6=six.csv --rays 1e-9=nine.csv --out card/\n"
              "Exit code 1 where the grade is F.");
  return {{&list, [options] { return run_list(*options); }},
          {&out, [options] { return run_export(*options); }},
          {&score, [options] { return run_score(*options); }}};
}

Subcommand add_peer(CLI::App& grade, const PeerCard& peer) {
  auto options = std::make_shared<PeerOptions>();
  CLI::App& app = add_sub(grade, std::string(peer.id).c_str(), std::string(peer.what).c_str(), options->base);
  add_set(app, options->base, "Chart to run it in (default: the classical one)");
  app.add_option("--tol", options->tol, std::string(peer.tol_text))->delimiter(',');
  app.add_option("--integrator", options->integrator, std::string(peer.integrator_text));
  app.add_option("--name", options->base.name, "What the card calls it");
  app.add_option("--out", options->base.out, "Directory to write the card into");
  add_example(app,
              fmt::format("{}\nWhere it is not installed this says SKIPPED and exits with 0; exit code 1 where the "
                          "grade is F.",
                          peer.example));
  return {&app, [options, &peer] { return run_peer(peer, *options); }};
}

}  // namespace

std::int64_t count_for(const GradeOptions& options, const ChallengeSet& set) {
  const std::int64_t count = options.count == 0 ? set.usual_rays : options.count;
  if (count < 1 || count > ids_of_a_set) {
    throw InputError(fmt::format("grade: --count {}, needs 1 to {}", count, ids_of_a_set));
  }
  return count;
}

/// --chart, checked; the set's home chart where it is not given.
std::string chart_for(const GradeOptions& options, const ChallengeSet& set) {
  const std::string chart = options.chart.empty() ? std::string(set.home_chart) : options.chart;
  static_cast<void>(set.spacetime(chart));
  return chart;
}

const ChallengeSet& set_for(const GradeOptions& options) {
  if (options.set.empty()) throw InputError("grade: --set is missing; xprimeray grade list names the sets");
  return challenge_set(options.set);
}

bool write_challenge(const ChallengeSet& set, const std::string& chart, std::int64_t count, const std::string& path) {
  const TableFormat format = table_format(path);
  AtomicFile out(path);
  const auto spacetime = set.spacetime(chart);
  const Json about = challenge_json(set, chart, count);
  const std::vector<std::pair<std::string, std::string>> attributes{{"schema", std::string(ray_schema_name)},
                                                                    {"schema_version", std::string(ray_schema_version)},
                                                                    {"metric", std::string(set.metric)},
                                                                    {"parameters", about["parameters"].dump()},
                                                                    {"chart", chart}};
  const auto writer = create_table(out.path(), format, ray_schema(spacetime->card()), attributes);
  writer->write(block_of(challenge_rays(set, chart, count)));
  writer->close();
  if (!out.regular()) {
    out.commit();
    return false;
  }
  AtomicFile sheet(path + ".sheet.md"), meta(path + ".meta.json");
  sheet.write(convention_sheet(set, chart, count, std::filesystem::path(path).filename().string()));
  meta.write(about.dump(2) + "\n");
  out.commit();
  sheet.commit();
  meta.commit();
  return true;
}

int grade_tables(const GradeOptions& options, const ChallengeSet& set, const CardRequest& request) {
  if (options.out.empty()) throw InputError("grade: --out is missing, a directory");
  check_card_directory(options.out);
  const double begin = seconds_now();
  std::vector<HandIn> tables;
  for (const GradedTable& table : request.tables) {
    tables.push_back(read_hand_in(table.file, set, request.count, request.chart));
  }
  const Examiner examiner(set, request.count);
  CardInputs inputs;
  inputs.examiner = &examiner;
  {
    ProgressLine line("grade", !options.output.quiet && !options.output.json);
    for (std::size_t k = 0; k < tables.size(); ++k) {
      ReportCard card = grade(examiner, std::move(tables[k]));
      card.tolerance = request.tables[k].tolerance;
      card.label = std::isnan(card.tolerance) ? card.hand_in.file : fmt::format("{:g}", card.tolerance);
      inputs.cards.push_back(std::move(card));
      line.update(static_cast<std::int64_t>(k + 1), static_cast<std::int64_t>(tables.size()));
    }
  }
  inputs.name = request.name;
  inputs.command = request.command;
  inputs.notes = request.notes;
  inputs.configuration = challenge_json(set, request.chart, request.count);
  for (const GradedTable& table : request.tables) inputs.configuration["tables"].push_back(table.file);
  inputs.provenance = provenance();
  inputs.seconds = seconds_now() - begin;
  inputs.figure_tools = found_figure_tools("card.py");
  const std::vector<std::string> problems = write_card(inputs, options.out);
  if (options.output.json) {
    fmt::print("{}\n", card_json(inputs).dump());
  } else if (!options.output.quiet) {
    fmt::print("{}  {:.1f} s; {}\n", card_text(inputs), inputs.seconds,
               (std::filesystem::path(options.out) / "card.md").string());
  }
  for (const std::string& problem : problems) fmt::print(stderr, "xprimeray: {}\n", problem);
  return inputs.main_card().as_handed_in.grade == Letter::f ? 1 : 0;
}

Command register_grade(CLI::App& program) {
  auto options = std::make_shared<GradeOptions>();
  CLI::App& app = *program.add_subcommand("grade", "Grade another code's rays: a challenge out, a report card back");
  app.require_subcommand(1);
  std::vector<Subcommand> subcommands = add_subcommands(app, options);
  for (const PeerCard& peer : peers()) subcommands.push_back(add_peer(app, peer));
  add_example(app,
              "  xprimeray grade export --set kerr-core --out challenge.csv\n"
              "  xprimeray grade score --set kerr-core --rays mine.csv --out card/");
  return {&app, [subcommands] {
            for (const Subcommand& one : subcommands) {
              if (one.app->parsed()) return one.run();
            }
            return 2;
          }};
}

}  // namespace xpr::cli
