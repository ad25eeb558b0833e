// xprimeray paper: published results, reproduced: printed, exact, ours.
#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "reports/paper_report.hpp"

namespace xpr::cli {
namespace {

struct PaperOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string out;
  std::vector<std::string> ids;
  bool list = false;
  bool all = false;
  int threads = 0;
};

int list_papers(const OutputFlags& output) {
  std::size_t width = 0;
  for (const Paper& paper : all_papers()) width = std::max(width, paper.info.id.size());
  for (const Paper& paper : all_papers()) {
    const PaperInfo& info = paper.info;
    if (output.json) {
      fmt::print(
          "{}\n",
          Json{
              {"paper", info.id}, {"reference", info.reference}, {"reproduced", info.reproduced}, {"cites", info.cites}}
              .dump());
    } else {
      fmt::print("{:<{}}  {}\n", info.id, width, info.reproduced);
    }
  }
  return 0;
}

std::vector<const Paper*> chosen(const PaperOptions& options) {
  std::vector<const Paper*> out;
  if (options.all) {
    if (!options.ids.empty()) throw InputError("paper: --all and ids together; give one or the other");
    for (const Paper& paper : all_papers()) out.push_back(&paper);
    return out;
  }
  if (options.ids.empty()) throw InputError("paper: no paper named; give ids, --all, or --list");
  for (const std::string& id : options.ids) {
    const Paper* paper = &find_paper(id);
    if (std::find(out.begin(), out.end(), paper) != out.end()) throw InputError("paper: " + id + " is named twice");
    out.push_back(paper);
  }
  return out;
}

/// In the order asked for, whatever the threads.
std::vector<PaperResult> run_papers(const std::vector<const Paper*>& wanted, int threads, ProgressLine& line) {
  std::vector<PaperResult> results(wanted.size());
  const Lab lab(SuiteSize::full);
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  std::int64_t done = 0;
  const auto worker = [&] {
    for (std::size_t i = next++; i < wanted.size() && !interrupted(); i = next++) {
      results[i] = run_paper(*wanted[i], lab);
      const std::scoped_lock lock(reporting);
      line.update(++done, static_cast<std::int64_t>(wanted.size()));
    }
  };
  const unsigned most =
      threads > 0 ? static_cast<unsigned>(threads) : std::max(1U, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> pool;
    for (std::size_t i = 1; i < std::min<std::size_t>(most, wanted.size()); ++i) pool.emplace_back(worker);
    worker();
  }
  if (interrupted()) throw Interrupted("paper");
  return results;
}

std::string command_line(const PaperOptions& options) {
  return options.all ? "xprimeray paper --all" : fmt::format("xprimeray paper {}", fmt::join(options.ids, " "));
}

void print_json(const PaperReportInputs& inputs, const PaperReportOutcome& outcome, int code) {
  for (const PaperResult& result : inputs.results) {
    for (const Claim& claim : result.claims) {
      fmt::print("{}\n", Json{{"event", "claim"},
                              {"paper", result.info.id},
                              {"quantity", claim.quantity},
                              {"unit", claim.unit},
                              {"printed", claim.printed},
                              {"exact", json_number(claim.exact.value)},
                              {"exact_error", json_number(claim.exact.error)},
                              {"verdict", std::string(to_string(verdict_of(claim)))}}
                             .dump());
    }
  }
  fmt::print("{}\n", Json{{"event", "end"},
                          {"papers", inputs.results.size()},
                          {"exit_code", code},
                          {"rays_hash", outcome.hashes.rays},
                          {"report_hash", outcome.hashes.report}}
                         .dump());
}

void print_text(const PaperOptions& options, const PaperReportInputs& inputs) {
  if (!options.all) {
    for (const PaperResult& result : inputs.results) fmt::print("{}\n", paper_text(result));
  } else {
    for (const PaperResult& result : inputs.results) fmt::print("{}", paper_line(result));
  }
  const Counts counts = count(as_suite(inputs.results));
  const std::string page = inputs.results.size() == 1 ? inputs.results.front().info.id : "overview";
  fmt::print("{} papers: {} rows passed, {} failed, {} in error, {} inconclusive, {} skipped; {:.1f} s; {}\n",
             inputs.results.size(), counts.pass, counts.fail, counts.error, counts.inconclusive, counts.skipped,
             inputs.seconds, (std::filesystem::path(options.out) / (page + ".md")).string());
}

int run_paper_command(PaperOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  if (options.list) return list_papers(options.output);
  if (options.threads < 0) throw InputError("paper: --threads is negative, needs 0 (all cores) or more");
  const std::vector<const Paper*> wanted = chosen(options);
  if (options.out.empty()) options.out = wanted.size() == 1 ? "report/" + wanted.front()->info.id : "report/papers";
  check_paper_directory(options.out);
  catch_interrupts();
  const double begin = seconds_now();
  PaperReportInputs inputs;
  {
    ProgressLine line("papers", !options.output.quiet && !options.output.json);
    inputs.results = run_papers(wanted, options.threads, line);
  }
  inputs.command = command_line(options);
  std::vector<std::string> ids;
  for (const Paper* paper : wanted) ids.push_back(paper->info.id);
  inputs.configuration = Json{{"papers", ids}};
  inputs.provenance = provenance();
  inputs.seconds = seconds_now() - begin;
  inputs.figure_tools = found_figure_tools("paper_figures.py");
  const PaperReportOutcome outcome = write_paper_report(inputs, options.out);
  for (const std::string& problem : outcome.figure_problems) fmt::print(stderr, "xprimeray: {}\n", problem);
  const int code = exit_code(as_suite(inputs.results));
  if (options.output.json) {
    print_json(inputs, outcome, code);
  } else if (!options.output.quiet) {
    print_text(options, inputs);
  }
  return code;
}

}  // namespace

Command register_paper(CLI::App& program) {
  auto options = std::make_shared<PaperOptions>();
  options->app = program.add_subcommand("paper", "Published results, reproduced: printed, exact, ours");
  CLI::App& app = *options->app;
  app.add_option("papers", options->ids, "Ids, as in `xprimeray paper --list`");
  app.add_flag("--list", options->list, "Print the papers and stop");
  app.add_flag("--all", options->all, "Every paper");
  app.add_option("--out", options->out, "Directory of the report (default: report/ID, report/papers); replaced whole");
  app.add_option("--threads", options->threads, "0: one for each core; no number depends on it")->capture_default_str();
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app,
              "  xprimeray paper --list\n"
              "  xprimeray paper virbhadra-ellis-2000\n"
              "  xprimeray paper --all --out papers\n"
              "Exit code: 0 all pass, 1 a claim fails, 2 bad usage, 3 a claim in error, 4 truth inconclusive.");
  return {options->app, [options] { return run_paper_command(*options); }};
}

}  // namespace xpr::cli
