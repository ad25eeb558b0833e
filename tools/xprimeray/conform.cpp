// xprimeray conform: what must hold of a metric module, checked, and in words what does not.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/conformance.hpp"

namespace xpr::cli {
namespace {

struct ConformOptions {
  OutputFlags output;
  std::string metric;
  std::string chart;
  std::vector<std::string> set;
  bool all = false;
  ConformanceOptions checks;
};

struct Tally {
  int passed = 0;
  int failed = 0;
};

std::string_view state_word(FindingState state) {
  constexpr std::array<std::string_view, 3> words{"ok", "FAIL", "-"};  // as in the enum
  return words[static_cast<std::size_t>(state)];
}

void print_finding(const Finding& finding) {
  if (finding.state == FindingState::not_checked) {
    fmt::print("  -     {:<38} not checked: {}\n", finding.check, finding.message);
    return;
  }
  fmt::print("  {:<5} {:<38} {:>8.1e} of {:<8.0e}{}\n", state_word(finding.state), finding.check, finding.error,
             finding.tolerance, finding.claim);
  if (finding.state == FindingState::failed) fmt::print("        {}\n", finding.message);
}

Json finding_line(const Spacetime& chart, const Finding& finding) {
  Json where = Json::object();
  for (std::size_t mu = 0; mu < 4; ++mu) {
    where[std::string(chart.card().coordinates[mu].name)] = json_number(finding.where[mu]);
  }
  Json line{{"event", "finding"},
            {"metric", std::string(chart.card().metric)},
            {"chart", std::string(chart.card().chart)},
            {"check", finding.check},
            {"state", finding.state == FindingState::passed   ? "passed"
                      : finding.state == FindingState::failed ? "failed"
                                                              : "not_checked"},
            {"claim", finding.claim},
            {"message", finding.message}};
  if (finding.state == FindingState::not_checked) return line;
  line["error"] = json_number(finding.error);
  line["tolerance"] = json_number(finding.tolerance);
  line["tolerance_reason"] = finding.tolerance_reason;
  line["component"] = finding.component;
  line["where"] = where;
  return line;
}

void check_chart(const Spacetime& chart, std::span<const Spacetime* const> siblings, const ConformOptions& options,
                 Tally& tally) {
  if (!options.output.json && !options.output.quiet) {
    std::string parameters;
    for (const NamedValue& value : chart.parameters()) parameters += fmt::format("  {} = {}", value.name, value.value);
    fmt::print("{} {}{}\n", chart.card().metric, chart.card().chart, parameters);
  }
  for (const Finding& finding : check_conformance(chart, siblings, options.checks)) {
    tally.passed += finding.state == FindingState::passed ? 1 : 0;
    tally.failed += finding.state == FindingState::failed ? 1 : 0;
    if (options.output.json) {
      fmt::print("{}\n", finding_line(chart, finding).dump());
    } else if (!options.output.quiet) {
      print_finding(finding);
    }
  }
}

/// Makes all charts of a metric, since they check each other, and reports on the one asked for or on all.
void check_metric(std::string_view metric, std::span<const NamedValue> values, const ConformOptions& options,
                  Tally& tally) {
  std::vector<std::unique_ptr<Spacetime>> owned;
  std::vector<const Spacetime*> charts;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.card->metric != metric) continue;
    owned.push_back(entry.make(values));
    charts.push_back(owned.back().get());
  }
  for (const Spacetime* chart : charts) {
    if (options.chart.empty() || options.chart == chart->card().chart) check_chart(*chart, charts, options, tally);
  }
}

int run_conform(const ConformOptions& options) {
  if (options.metric.empty() != options.all) {
    throw InputError("conform: needs a metric or --all; see xprimeray list metrics");
  }
  if (options.checks.points < 1) throw InputError("conform: --points is below 1");
  std::vector<NamedValue> values;
  for (const std::string& text : options.set) add_parameter(values, text);
  Tally tally;
  if (options.all) {
    if (!values.empty() || !options.chart.empty()) throw InputError("conform: --all takes no --set and no --chart");
    std::string_view last;
    for (const CatalogueEntry& entry : catalogue()) {
      if (entry.card->metric != last) check_metric(entry.card->metric, {}, options, tally);
      last = entry.card->metric;
    }
  } else {
    (void)make_spacetime(options.metric, options.chart, values);  // refuses unknown names with the nearest known one
    check_metric(options.metric, values, options, tally);
  }
  if (options.output.json) {
    fmt::print("{}\n", Json{{"event", "end"}, {"passed", tally.passed}, {"failed", tally.failed}}.dump());
  } else if (!options.output.quiet) {
    fmt::print("{} of {} checks failed\n", tally.failed, tally.passed + tally.failed);
  }
  return tally.failed > 0 ? 1 : 0;
}

}  // namespace

Command register_conform(CLI::App& program) {
  auto options = std::make_shared<ConformOptions>();
  CLI::App* app = program.add_subcommand("conform", "Check a metric module: which component is wrong, where, by what");
  app->add_option("metric", options->metric, "As in `xprimeray list metrics`");
  app->add_option("--chart", options->chart, "Report on this chart alone (default: all charts of the metric)");
  app->add_option("--set", options->set, "A parameter: --set a=0.9 (repeat for more)")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app->add_flag("--all", options->all, "Check every metric of this build");
  app->add_option("--points", options->checks.points, "Events sampled in each chart")->capture_default_str();
  app->add_option("--seed", options->checks.seed, "Of the sampled events")->capture_default_str();
  add_output_flags(*app, options->output);
  add_example(*app,
              "  xprimeray conform kerr --set a=0.9 --chart boyer-lindquist\n"
              "Exit code: 0 all checks hold, 1 one fails, 2 bad usage.");
  return {app, [options] { return run_conform(*options); }};
}

}  // namespace xpr::cli
