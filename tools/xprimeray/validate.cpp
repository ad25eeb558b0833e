// xprimeray validate: run the suite, write the report, say the verdict.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"
#include "report_inputs.hpp"
#include "reports/terminal.hpp"
#include "validation/suite.hpp"
#include "validation/sweep.hpp"

namespace xpr::cli {
namespace {

struct ValidateOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string out;
  Selection selection;
  int threads = 0;
  bool self_test = false;
  bool list = false;
};

/// The command that repeats the run: what selects, not where it is written or on how many threads.
std::string command_line(const ValidateOptions& options) {
  std::string line = "xprimeray validate --suite " + options.selection.suite;
  for (const std::string& glob : options.selection.globs) line += " --case '" + glob + "'";
  for (const std::string& word : options.selection.contains) line += " --filter '" + word + "'";
  return line + (options.self_test ? " --self-test" : "");
}

ReportInputs report_inputs(const ValidateOptions& options, SuiteResult suite, double seconds) {
  ReportInputs inputs = new_report(std::move(suite), options.threads, options.out, seconds);
  inputs.command = command_line(options);
  inputs.configuration = Json{{"suite", options.selection.suite},
                              {"case", options.selection.globs},
                              {"filter", options.selection.contains},
                              {"self-test", options.self_test}};
  return inputs;
}

int list_selected(const ValidateOptions& options, const std::vector<const Case*>& selected) {
  for (const Case* one : selected) {
    if (options.output.json) {
      fmt::print("{}\n", Json{{"case", one->info.id}, {"quick", one->quick}, {"claim", one->info.claim}}.dump());
    } else {
      fmt::print("{:<32} {}\n", one->info.id, one->info.claim);
    }
  }
  return 0;
}

/// Progress in the three ways in which people and programs want it, and the way out on Ctrl-C.
SuiteOptions suite_options(const ValidateOptions& options, ProgressLine& line, std::stop_source& stop) {
  SuiteOptions out;
  out.threads = options.threads;
  out.stop = stop.get_token();
  out.progress = [&options, &line, &stop](const Progress& at) {
    if (interrupted()) stop.request_stop();
    line.update(static_cast<std::int64_t>(at.done), static_cast<std::int64_t>(at.total));
    if (!options.output.json) return;
    fmt::print("{}\n", Json{{"event", "progress"}, {"done", at.done}, {"total", at.total}, {"last", at.last}}.dump());
    std::fflush(stdout);
  };
  return out;
}

/// The faults whose cases are selected; all of them where everything quick is.
std::vector<Fault> selected_faults(const std::vector<const Case*>& selected) {
  std::vector<Fault> out;
  for (const Fault& fault : faults()) {
    const bool wanted =
        std::any_of(selected.begin(), selected.end(), [&](const Case* one) { return one->info.id == fault.case_id; });
    const bool homeless =
        std::none_of(cases().begin(), cases().end(), [&](const Case& one) { return one.info.id == fault.case_id; });
    if (wanted || homeless) out.push_back(fault);
  }
  return out;
}

/// A whole suite's report has sweeps; one of chosen cases has not.
bool has_sweeps(const Selection& selection) {
  const bool whole = selection.suite == "quick" || selection.suite == "full";
  return whole && selection.globs.empty() && selection.contains.empty();
}

SuiteResult run_selected(const ValidateOptions& options, const std::vector<const Case*>& selected) {
  catch_interrupts();
  std::stop_source stop;
  const SuiteSize size = suite_size(options.selection);
  const bool shown = !options.output.quiet && !options.output.json;
  SuiteResult suite;
  suite.suite = options.selection.suite;
  {
    ProgressLine line("validate", shown);
    suite.cases = run_cases(selected, size, suite_options(options, line, stop));
  }
  if (options.self_test && !stop.stop_requested()) {
    ProgressLine line("self-test", shown);
    suite.faults =
        run_self_test(selected_faults(selected), cases(), size, suite_options(options, line, stop), suite.cases);
  }
  if (has_sweeps(options.selection) && !stop.stop_requested()) {
    ProgressLine line("sweeps", shown);
    suite.sweeps = default_sweeps(size, {.threads = options.threads,
                                         .progress =
                                             [&](std::int64_t done, std::int64_t total) {
                                               if (interrupted()) stop.request_stop();
                                               line.update(done, total);
                                             },
                                         .stop = stop.get_token()});
  }
  if (stop.stop_requested() || interrupted()) throw Interrupted("validate");
  return suite;
}

void print_faults(const std::vector<FaultResult>& faults) {
  for (const FaultResult& fault : faults) {
    if (fault.caught) {
      fmt::print("caught      {:<36} by {} [{}]: {:.1e} times its tolerance\n", fault.id, fault.case_id, fault.row,
                 fault.error / fault.tolerance);
    } else {
      fmt::print("NOT CAUGHT  {:<36} by {}: {}\n", fault.id, fault.case_id, fault.note);
    }
  }
}

void print_end(const SuiteResult& suite, const ReportOutcome& outcome, const std::string& out, int code) {
  const Counts counts = count(suite);
  const auto caught = std::count_if(suite.faults.begin(), suite.faults.end(), [](const auto& f) { return f.caught; });
  const Json line{{"event", "end"},
                  {"out", out},
                  {"exit_code", code},
                  {"counts",
                   {{"pass", counts.pass},
                    {"fail", counts.fail},
                    {"inconclusive", counts.inconclusive},
                    {"error", counts.error},
                    {"skipped", counts.skipped}}},
                  {"faults", {{"planted", suite.faults.size()}, {"caught", caught}}},
                  {"rays_hash", outcome.hashes.rays},
                  {"report_hash", outcome.hashes.report}};
  fmt::print("{}\n", line.dump());
}

int run_validate(ValidateOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  if (options.threads < 0) throw InputError("validate: --threads is negative, needs 0 (all cores) or more");
  const std::vector<const Case*> selected = select_cases(cases(), options.selection);
  if (selected.empty()) throw InputError("validate: nothing is selected; see xprimeray list cases");
  if (options.list) return list_selected(options, selected);
  if (options.out.empty()) options.out = "report/" + options.selection.suite;
  check_report_directory(options.out);

  const double begin = seconds_now();
  SuiteResult suite = run_selected(options, selected);
  const ReportInputs inputs = report_inputs(options, std::move(suite), seconds_now() - begin);
  const ReportOutcome outcome = write_report(inputs, options.out);
  for (const std::string& problem : outcome.figure_problems) fmt::print(stderr, "xprimeray: {}\n", problem);
  const int code = exit_code(inputs.suite);
  if (options.output.json) {
    print_end(inputs.suite, outcome, options.out, code);
  } else if (!options.output.quiet) {
    print_faults(inputs.suite.faults);
    fmt::print("{}", terminal_verdict(inputs.suite, options.out));
  }
  return code;
}

}  // namespace

Command register_validate(CLI::App& program) {
  auto options = std::make_shared<ValidateOptions>();
  options->app = program.add_subcommand("validate", "Run the suite, write the report, say the verdict");
  CLI::App& app = *options->app;
  app.add_option("--suite", options->selection.suite, "quick, full, metrics, or a family such as kerr or numerical")
      ->capture_default_str();
  app.add_option("--case", options->selection.globs, "Case ids, with * and ?: --case 'kerr/*' (repeat for more)")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  app.add_option("--filter", options->selection.contains,
                 "A word in id, claim or citations (repeat: all must be there)")
      ->type_name("WORD")
      ->allow_extra_args(false);
  app.add_option("--out", options->out, "Directory of the report (default: report/SUITE); replaced whole");
  app.add_option("--threads", options->threads, "0: one for each core; no number depends on it")->capture_default_str();
  app.add_flag("--self-test", options->self_test, "Plant faults under the selected cases too, and show each caught");
  app.add_flag("--list", options->list, "Print the selected cases and stop");
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app,
              "  xprimeray validate --suite quick --out report\n"
              "  xprimeray validate --case 'conformance/*' --self-test\n"
              "Exit code: 0 all pass, 1 a row fails or a fault goes uncaught, 2 bad usage, 3 a row in error,\n"
              "4 truth inconclusive.");
  return {options->app, [options] { return run_validate(*options); }};
}

}  // namespace xpr::cli
