// xprimeray render: a film frame from a scene.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "command.hpp"
#include "core/film/film_scene.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "core/scene/describe_scene.hpp"
#include "core/scene/scene_file.hpp"
#include "report_inputs.hpp"
#include "reports/frame_report.hpp"

namespace xpr::cli {
namespace {

struct RenderOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string scene;
  std::string out;
  std::string preset, method, backend = "core";
  std::optional<int> tier;
  std::optional<double> tol, scale;
  std::optional<std::int64_t> samples;
  int threads = 0;
  int lanes = 0;
  bool dry_run = false;
};

[[noreturn]] void refuse(const std::string& what) { throw InputError("render: " + what); }

SceneFlags flags_of(const RenderOptions& options) {
  SceneFlags flags;
  if (!options.preset.empty()) flags.preset = options.preset;
  if (!options.method.empty()) flags.method = options.method;
  flags.tier = options.tier;
  flags.tol = options.tol;
  flags.scale = options.scale;
  flags.samples = options.samples;
  return flags;
}

std::string command_line(const RenderOptions& options) {
  std::string line = "xprimeray render " + options.scene;
  if (!options.preset.empty()) line += " --preset " + options.preset;
  if (options.tier) line += fmt::format(" --tier {}", *options.tier);
  if (!options.method.empty()) line += " --method " + options.method;
  if (options.tol) line += fmt::format(" --tol {}", *options.tol);
  if (options.scale) line += fmt::format(" --scale {}", *options.scale);
  if (options.samples) line += fmt::format(" --samples {}", *options.samples);
  if (options.backend != "core") line += " --backend " + options.backend;
  return line;
}

void resolve(const RenderOptions& options) {
  if (options.scene.empty()) refuse("no scene named; give a TOML file, as in scenes/fixture_001.toml");
  if (options.out.empty() && !options.dry_run) refuse("--out is missing, a directory");
  if (options.threads < 0) refuse("--threads is negative, needs 0 (all cores) or more");
  check_lanes("render", options.lanes);
  if (options.backend != "core" && options.backend != "reference") {
    refuse("--backend: " + unknown_name("backend", options.backend, {"core", "reference"}));
  }
}

int run_render(RenderOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  resolve(options);
  const std::shared_ptr<const SceneSnapshot> scene = read_scene(options.scene, flags_of(options));
  if (options.dry_run) {
    if (options.output.json) {
      fmt::print("{}\n", scene_json(*scene).dump());
    } else {
      fmt::print("{}", scene_text(*scene));
    }
    return 0;
  }
  check_frame_directory(options.out);
  catch_interrupts();
  const double begin = seconds_now();
  const bool reference = options.backend == "reference";
  const std::unique_ptr<SceneGeometry> geometry =
      make_geometry(geometry_model(*scene), reference ? GeometryBackend::reference : GeometryBackend::bvh);
  const FilmScene film(scene, *geometry, reference ? 1 : options.lanes);
  const std::string banner = scene->research.config.research_enabled
                                 ? banner_line(scene->research.config, scene->research.overrides)
                                 : std::string();
  if (!banner.empty() && !options.output.quiet && !options.output.json) fmt::print("{}\n", banner);

  FilmOptions exposure;
  exposure.threads = options.threads;
  exposure.seed = frame_seed(scene->research.config, static_cast<std::uint64_t>(scene->film.seed), 0);
  exposure.interrupted = interrupted;
  FilmFrame frame;
  {
    ProgressLine line("render", !options.output.quiet && !options.output.json);
    exposure.progress = [&](std::int64_t done, std::int64_t all) { line.update(done, all); };
    frame = expose(film.tracer(), scene->film, film.shader(), exposure);
  }
  const FrameInputs inputs{.frame = frame,
                           .title = scene->header.name,
                           .banner = banner,
                           .command = command_line(options),
                           .configuration = scene_json(*scene),
                           .provenance = provenance(),
                           .seconds = seconds_now() - begin,
                           .threads = options.threads,
                           .lanes = film.lanes()};
  write_frame(inputs, options.out);
  if (options.output.json) {
    fmt::print("{}\n", Json{{"event", "result"},
                            {"frame_hash", frame_hash(frame)},
                            {"seconds", inputs.seconds},
                            {"health", health_line(inputs)}}
                           .dump());
  } else if (!options.output.quiet) {
    fmt::print("{}\n{:.1f} s; frame_hash {}; {}\n", health_line(inputs), inputs.seconds, frame_hash(frame),
               (std::filesystem::path(options.out) / "frame.md").string());
  }
  return 0;
}

}  // namespace

Command register_render(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& app = *program.add_subcommand("render", "A film frame from a scene file");
  options->app = &app;
  app.add_option("scene", options->scene, "TOML file (docs/scenes.md)");
  app.add_option("--out", options->out, "Directory to write: frame.exr, frame.png, frame.h5, frame.json, frame.md");
  app.add_option("--preset", options->preset, "Research Mode: off, validate, paper-match, stress-test");
  app.add_option("--tier", options->tier, "0 preview, 1 error-bounded, 2 invariant-preserving; over the scene's");
  app.add_option("--method", options->method, "As in `xprimeray list methods`; over the scene's");
  app.add_option("--tol", options->tol, "Tolerance of adaptive methods; over the scene's");
  app.add_option("--scale", options->scale, "Of the film's width and height; over the scene's");
  app.add_option("--samples", options->samples, "Rays a pixel; over the scene's");
  app.add_option("--backend", options->backend, "core, or reference: every triangle in turn, one ray at a time")
      ->capture_default_str();
  app.add_option("--threads", options->threads, "0: one for each core; no pixel depends on it")->capture_default_str();
  app.add_option("--lanes", options->lanes, "Rays side by side, 1, 2, 4 or 8; 0: best here; no pixel depends on it")
      ->capture_default_str();
  app.add_flag("--dry-run", options->dry_run, "Read and check the scene, say what it comes to, render nothing");
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app,
              "  xprimeray render scenes/fixture_001.toml --out frame/\n"
              "  xprimeray render scenes/fixture_001.toml --preset validate --threads 2 --out frame/\n"
              "  xprimeray render scenes/schwarzschild.toml --dry-run");
  return {&app, [options] { return run_render(*options); }};
}

}  // namespace xpr::cli
