// xprimeray sweep: the error of methods over a ladder of tolerances and step sizes, with what it cost.
#include "validation/sweep.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "report_inputs.hpp"

namespace xpr::cli {
namespace {

struct SweepCommandOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string out;
  std::vector<std::string> set;
  SweepRequest request;
  int threads = 0;
};

Json configuration(const SweepRequest& request) {
  Json parameters = Json::object();
  for (const SweepParameter& parameter : request.parameters) parameters[parameter.name] = json_number(parameter.value);
  Json json{{"metric", request.metric}, {"set", parameters}, {"methods", request.methods}};
  if (!request.chart.empty()) json["chart"] = request.chart;
  json["from"] = json_number(request.from);
  json["to"] = json_number(request.to);
  json["points-per-decade"] = request.points_per_decade;
  json["step-from"] = json_number(request.step_from);
  json["step-to"] = json_number(request.step_to);
  json["rays"] = request.rays;
  return json;
}

/// The command that repeats the run.
std::string command_line(const SweepRequest& request) {
  std::string line = "xprimeray sweep --metric " + request.metric;
  for (const SweepParameter& parameter : request.parameters) {
    line += fmt::format(" --set {}={}", parameter.name, parameter.value);
  }
  if (!request.chart.empty()) line += " --chart " + request.chart;
  line += fmt::format(" --methods {} --from {} --to {} --points-per-decade {}", fmt::join(request.methods, ","),
                      request.from, request.to, request.points_per_decade);
  return line + fmt::format(" --step-from {} --step-to {} --rays {}", request.step_from, request.step_to, request.rays);
}

ReportInputs report_inputs(const SweepCommandOptions& options, std::vector<Sweep> sweeps, double seconds) {
  SuiteResult suite;
  suite.suite = "sweep";
  suite.sweeps = std::move(sweeps);
  ReportInputs inputs = new_report(std::move(suite), options.threads, options.out, seconds);
  inputs.command = command_line(options.request);
  inputs.configuration = configuration(options.request);
  return inputs;
}

Json to_json(const Sweep& sweep, const SweepPoint& point) {
  return {{"event", "point"},
          {"quantity", sweep.quantity},
          {"unit", sweep.unit},
          {"truth", std::string(to_string(sweep.rank))},
          {"metric", point.metric},
          {"chart", point.chart},
          {"method", point.method},
          {point.adaptive ? "tol" : "step", json_number(point.setting)},
          {"rays", point.rays},
          {"error_norm", json_number(point.error_norm)},
          {"error_median", json_number(point.error_median)},
          {"error_p99", json_number(point.error_p99)},
          {"error_max", json_number(point.error_max)},
          {"truth_error", json_number(point.truth_error)},
          {"null_drift_max", json_number(point.null_drift_max)},
          {"evaluations_per_ray", json_number(point.evaluations_per_ray)},
          {"steps_per_ray", json_number(point.steps_per_ray)},
          {"seconds_per_ray", json_number(point.seconds_per_ray)},
          {"observed_order", json_number(point.observed_order)},
          {"richardson_error", json_number(point.richardson_error)},
          {"convergence", point.convergence}};
}

/// A number of a table's cell, "na" where there is none.
std::string cell(double value, const char* format) {
  return std::isnan(value) ? "na" : fmt::format(fmt::runtime(format), value);
}

void print_table(const std::vector<Sweep>& sweeps) {
  for (const Sweep& sweep : sweeps) {
    const SweepPoint& first = sweep.points.front();
    fmt::print("{} ({}): {}, unit {}, truth: {}\n", first.metric, first.chart, sweep.quantity, sweep.unit,
               to_string(sweep.rank));
    fmt::print("{:<22} {:>13} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>8} {:>6} {:>8}  {}\n", "method", "tol or step",
               "rms", "median", "p99", "max", "null", "evals/ray", "us/ray", "order", "GCI", "class");
    for (const SweepPoint& point : sweep.points) {
      const std::string setting = fmt::format("{} {:.3g}", point.adaptive ? "tol" : "step", point.setting);
      fmt::print("{:<22} {:>13} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9.0f} {:>8} {:>6} {:>8}  {}\n", point.method, setting,
                 cell(point.error_norm, "{:.1e}"), cell(point.error_median, "{:.1e}"), cell(point.error_p99, "{:.1e}"),
                 cell(point.error_max, "{:.1e}"), cell(point.null_drift_max, "{:.1e}"), point.evaluations_per_ray,
                 cell(1e6 * point.seconds_per_ray, "{:.1f}"), cell(point.observed_order, "{:.2f}"),
                 cell(point.richardson_error, "{:.1e}"), point.convergence);
    }
    fmt::print("\n");
  }
  fmt::print(
      "order: of the error against the step (fixed-step methods) or the tolerance (adaptive ones, 1 expected)\n");
}

std::vector<Sweep> measured(const SweepCommandOptions& options) {
  catch_interrupts();
  std::stop_source stop;
  SweepOptions run{.threads = options.threads, .stop = stop.get_token()};
  ProgressLine line("sweep", !options.output.quiet && !options.output.json);
  run.progress = [&](std::int64_t done, std::int64_t total) {
    if (interrupted()) stop.request_stop();
    line.update(done, total);
    if (!options.output.json) return;
    fmt::print("{}\n", Json{{"event", "progress"}, {"done", done}, {"total", total}}.dump());
    std::fflush(stdout);
  };
  std::vector<Sweep> sweeps = run_sweep(options.request, run);
  if (interrupted()) throw Interrupted("sweep");
  return sweeps;
}

int run_sweep_command(SweepCommandOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  if (options.threads < 0) throw InputError("sweep: --threads is negative, needs 0 (all cores) or more");
  std::vector<NamedValue> parameters;
  for (const std::string& text : options.set) add_parameter(parameters, text);
  for (const NamedValue& p : parameters) options.request.parameters.push_back({std::string(p.name), p.value});
  if (!options.out.empty()) check_report_directory(options.out);

  const double begin = seconds_now();
  const std::vector<Sweep> sweeps = measured(options);
  const double seconds = seconds_now() - begin;
  if (options.output.json) {
    for (const Sweep& sweep : sweeps) {
      for (const SweepPoint& point : sweep.points) fmt::print("{}\n", to_json(sweep, point).dump());
    }
  } else if (!options.output.quiet) {
    print_table(sweeps);
  }
  Json end{{"event", "end"}, {"seconds", seconds}};
  if (!options.out.empty()) {
    const ReportOutcome outcome = write_report(report_inputs(options, sweeps, seconds), options.out);
    for (const std::string& problem : outcome.figure_problems) fmt::print(stderr, "xprimeray: {}\n", problem);
    end["out"] = options.out;
    end["rays_hash"] = outcome.hashes.rays;
    end["report_hash"] = outcome.hashes.report;
    if (!options.output.json && !options.output.quiet) fmt::print("report: {}/report.md\n", options.out);
  }
  if (options.output.json) fmt::print("{}\n", end.dump());
  return 0;
}

}  // namespace

Command register_sweep(CLI::App& program) {
  auto options = std::make_shared<SweepCommandOptions>();
  options->app = program.add_subcommand("sweep", "Error and cost of methods over tolerances and step sizes");
  CLI::App& app = *options->app;
  SweepRequest& request = options->request;
  app.add_option("--metric", request.metric, fmt::format("One of {}", fmt::join(sweep_metrics(), ", ")))
      ->capture_default_str();
  app.add_option("--set", options->set, "A parameter of it: --set a=0.9 (repeat for more)")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app.add_option("--chart", request.chart, "Chart to trace in (default: the one that is regular where the rays go)");
  app.add_option("--methods", request.methods, "As in `xprimeray list methods`, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--from", request.from, "Loosest tolerance, for adaptive methods")->capture_default_str();
  app.add_option("--to", request.to, "Tightest tolerance")->capture_default_str();
  app.add_option("--points-per-decade", request.points_per_decade, "Tolerances in each decade")->capture_default_str();
  app.add_option("--step-from", request.step_from, "Longest step of the other methods, in length units; then halved")
      ->capture_default_str();
  app.add_option("--step-to", request.step_to, "Shortest step")->capture_default_str();
  app.add_option("--rays", request.rays, "Rays in the seeded bundle")->capture_default_str();
  app.add_option("--out", options->out, "Directory of a report with figures; replaced whole (default: the table only)");
  app.add_option("--threads", options->threads, "0: one for each core; no number but the times depends on it")
      ->capture_default_str();
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app,
              "  xprimeray sweep --metric kerr --set a=0.9 --methods rk4,dopri54,dop853,gl6 \\\n"
              "      --from 1e-4 --to 1e-12 --rays 32 --out report/sweep");
  return {options->app, [options] { return run_sweep_command(*options); }};
}

}  // namespace xpr::cli
