// xprimeray repro: the same rays by every number of threads and every width of lanes, hashes side by side.
#include "core/repro.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <thread>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "core/io/provenance.hpp"

namespace xpr::cli {
namespace {

struct ReproOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  ReproSettings repro;
  int threads = 0;
};

int run_repro_command(ReproOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  if (options.repro.rays <= 0) throw InputError("repro: --rays needs to be at least 1");
  if (options.threads < 0) throw InputError("repro: --threads is negative, needs 0 (all cores) or more");
  const int most = options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  options.repro.threads = {1};
  if (most >= 2) options.repro.threads.push_back(2);
  if (most > 2) options.repro.threads.push_back(most);
  catch_interrupts();
  options.repro.interrupted = interrupted;
  std::vector<ReproRun> runs;
  {
    ProgressLine line("repro", !options.output.quiet && !options.output.json);
    options.repro.progress = [&](std::int64_t done, std::int64_t all) { line.update(done, all); };
    runs = run_repro(options.repro);
  }
  const bool same = reproduced(runs);
  if (options.output.json) {
    for (const ReproRun& run : runs) {
      fmt::print("{}\n", Json{{"threads", run.threads}, {"lanes", run.lanes}, {"rays_hash", run.rays_hash}}.dump());
    }
  } else if (!options.output.quiet) {
    const Provenance build = provenance();
    fmt::print("{} rays each of\n", options.repro.rays);
    for (const std::string& subject : repro_subjects()) fmt::print("  {}\n", subject);
    fmt::print("{}, {}, {}\n\n{:>7}  {:>5}  {:<32}  {:>7}\n", build.compiler, build.build_type, build.isa, "threads",
               "lanes", "rays_hash", "seconds");
    for (const ReproRun& run : runs) {
      fmt::print("{:>7}  {:>5}  {:<32}  {:>7.2f}\n", run.threads, run.lanes, run.rays_hash, run.seconds);
    }
    fmt::print("\n{}\n",
               same ? "EQUAL: no result depends on threads or lanes" : "DIFFERENT: this build is not reproducible");
  }
  return same ? 0 : 1;
}

}  // namespace

Command register_repro(CLI::App& program) {
  auto options = std::make_shared<ReproOptions>();
  CLI::App& app =
      *program.add_subcommand("repro", "Show that no bit depends on threads or lanes; tools/repro compares builds");
  options->app = &app;
  app.add_option("--rays", options->repro.rays, "Rays of each spacetime and method")->capture_default_str();
  app.add_option("--threads", options->threads, "The most to try beside 1 and 2; 0: one for each core")
      ->capture_default_str();
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app, "  xprimeray repro --rays 256");
  return {&app, [options] { return run_repro_command(*options); }};
}

}  // namespace xpr::cli
