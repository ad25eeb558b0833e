// xprimeray errormap: a camera's rays as a method traces them against the closed form, pixel by pixel.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "command.hpp"
#include "core/io/angle.hpp"
#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "integrators/stepper.hpp"
#include "reports/error_map_report.hpp"

namespace xpr::cli {
namespace {

struct ErrorMapOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string out;
  std::string metric = "kerr";
  std::string observer = "r=1000,inclination=60deg";
  std::string pixels = "512x512";
  std::vector<std::string> set;
  ErrorMapSettings map;
};

[[noreturn]] void refuse(const std::string& what) { throw InputError("errormap: " + what); }

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  if (parse_number(text, value) != NumberFault::none) return std::nullopt;
  return value;
}

/// r=1000,inclination=60deg
void set_observer(CameraScreen& screen, const std::string& text) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    if (name == "r") {
      const auto radius = number(value);
      if (!radius) refuse(fmt::format("--observer r={}, needs a number", value));
      screen.radius = *radius;
    } else if (name == "inclination") {
      const auto angle = parse_angle(value);
      if (!angle)
        refuse(fmt::format("--observer {}={}, needs a number with its unit, as in 60deg or 1.05rad", name, value));
      screen.inclination = *angle;
    } else {
      refuse(fmt::format("--observer: {}; it takes r and inclination, as in r=1000,inclination=60deg",
                         unknown_name("part", name, {"r", "inclination"})));
    }
    begin = end + 1;
  }
}

/// 512x256
void set_pixels(CameraScreen& screen, const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto whole = [&](const std::string& part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    const bool good = error == std::errc() && end == part.data() + part.size() && value > 0 && value <= 32768;
    if (!good || cross == std::string::npos) {
      refuse(fmt::format("--pixels {}, needs columns x rows between 1 and 32768, as in 512x512", text));
    }
    return value;
  };
  screen.pixels = {whole(text.substr(0, cross)), whole(cross == std::string::npos ? "" : text.substr(cross + 1))};
  // A pixel takes some 250 bytes of memory: 4 GB.
  constexpr std::int64_t most = 16'777'216;
  if (std::int64_t{screen.pixels[0]} * screen.pixels[1] > most) {
    refuse(fmt::format("--pixels {}, needs {} pixels (4096x4096) or fewer", text, most));
  }
}

std::string title_of(const ErrorMapSettings& map) {
  const CameraScreen& screen = map.screen;
  const TraceSettings& trace = map.transport.trace;
  const bool adaptive = method_card(trace.method).adaptive;
  return fmt::format("{}{}, observer at {:g} M, {:.4g} degrees, screen +-{:g} M, {} {} {:g}", map.transport.metric,
                     map.transport.metric == "kerr" ? fmt::format(" a = {:g} M", screen.spin / screen.mass) : "",
                     screen.radius / screen.mass, screen.inclination * 180.0 / std::numbers::pi,
                     screen.half_width / screen.mass, trace.method, adaptive ? "tol" : "step",
                     adaptive ? trace.tol : trace.step);
}

Json configuration(const ErrorMapOptions& options) {
  const CameraScreen& screen = options.map.screen;
  const TraceSettings& trace = options.map.transport.trace;
  return {{"metric", options.map.transport.metric},
          {"M", screen.mass},
          {"a", screen.spin},
          {"observer", {{"r", screen.radius}, {"inclination", screen.inclination}}},
          {"screen", screen.half_width},
          {"pixels", screen.pixels},
          {"method", trace.method},
          {"tol", trace.tol},
          {"step", trace.step}};
}

std::string command_line(const ErrorMapOptions& options) {
  const TraceSettings& trace = options.map.transport.trace;
  std::string line = "xprimeray errormap --metric " + options.metric;
  for (const std::string& text : options.set) line += " --set " + text;
  return line + fmt::format(" --observer {} --screen {} --pixels {} --method {} --tol {} --step {}", options.observer,
                            options.map.screen.half_width, options.pixels, trace.method, trace.tol, trace.step);
}

void resolve(ErrorMapOptions& options) {
  ErrorMapSettings& map = options.map;
  if (options.out.empty()) refuse("--out is missing, a directory");
  if (map.threads < 0) refuse("--threads is negative, needs 0 (all cores) or more");
  check_lanes("errormap", map.lanes);
  map.transport.metric = options.metric;
  for (const std::string& text : options.set) add_parameter(map.transport.parameters, text);
  for (const NamedValue& parameter : map.transport.parameters) {
    if (parameter.name == "M") map.screen.mass = parameter.value;
    if (parameter.name == "a") map.screen.spin = parameter.value;
  }
  set_observer(map.screen, options.observer);
  set_pixels(map.screen, options.pixels);
}

int run_errormap(ErrorMapOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  resolve(options);
  check_error_map_directory(options.out);
  catch_interrupts();
  const double begin = seconds_now();
  ErrorMapSettings& map = options.map;
  map.interrupted = interrupted;
  ErrorMapInputs inputs;
  {
    ProgressLine line("errormap", !options.output.quiet && !options.output.json);
    map.progress = [&](std::int64_t done, std::int64_t all) { line.update(done, all); };
    inputs.map = error_map(map);
  }
  inputs.summary = summary_of(inputs.map);
  inputs.title = title_of(map);
  inputs.command = command_line(options);
  inputs.configuration = configuration(options);
  inputs.provenance = provenance();
  inputs.seconds = seconds_now() - begin;
  inputs.figure_tools = found_figure_tools("error_map.py");
  const std::vector<std::string> problems = write_error_map(inputs, options.out);
  const ErrorSummary& all = inputs.summary.front();
  if (options.output.json) {
    fmt::print("{}\n", Json{{"event", "result"},
                            {"pixels", all.pixels},
                            {"wrong_status", all.wrong_status},
                            {"median", json_number(all.median)},
                            {"p99", json_number(all.p99)},
                            {"max", json_number(all.most)},
                            {"rays_hash", inputs.map.rays_hash}}
                           .dump());
  } else if (!options.output.quiet) {
    fmt::print("{}\n{}", inputs.title, error_map_table(inputs.summary));
    fmt::print("{:.1f} s; rays_hash {}; {}\n", inputs.seconds, inputs.map.rays_hash,
               (std::filesystem::path(options.out) / "errormap.md").string());
  }
  for (const std::string& problem : problems) fmt::print(stderr, "xprimeray: {}\n", problem);
  return all.wrong_status > 0 ? 1 : 0;
}

}  // namespace

Command register_errormap(CLI::App& program) {
  auto options = std::make_shared<ErrorMapOptions>();
  options->map.transport.trace.method = "dop853";
  CLI::App& app =
      *program.add_subcommand("errormap", "Every pixel of a camera against the closed form: Kerr, Schwarzschild");
  options->app = &app;
  TraceSettings& trace = options->map.transport.trace;
  app.add_option("--metric", options->metric, "kerr or schwarzschild")->capture_default_str();
  app.add_option("--set", options->set, "A parameter of it: --set a=0.9 (repeat for more)")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app.add_option("--observer", options->observer,
                 "Where the camera stands at rest: its r and its inclination to the spin")
      ->capture_default_str();
  app.add_option("--screen", options->map.screen.half_width, "Half-width of the screen, a length")
      ->capture_default_str();
  app.add_option("--pixels", options->pixels, "Columns x rows")->capture_default_str();
  app.add_option("--method", trace.method, "As in `xprimeray list methods`")->capture_default_str();
  app.add_option("--tol", trace.tol, "Tolerance of adaptive methods")->capture_default_str();
  app.add_option("--step", trace.step, "Step of the others, in lambda for |p_t| = 1")->capture_default_str();
  app.add_option("--threads", options->map.threads, "0: one for each core; no result depends on it")
      ->capture_default_str();
  app.add_option("--lanes", options->map.lanes,
                 "Rays side by side, 1, 2, 4 or 8; 0: best here; no result depends on it")
      ->capture_default_str();
  app.add_option("--out", options->out, "Directory to write: map.h5, map.exr, errormap.md, figures/");
  app.add_option("--config", options->config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options->output);
  add_example(app,
              "  xprimeray errormap --metric kerr --set a=0.9 --observer r=1000,inclination=60deg --screen 12 \\\n"
              "      --pixels 128x128 --method dop853 --tol 1e-10 --out map/\n"
              "Exit code 1 where a ray ends otherwise than the closed form says.");
  return {&app, [options] { return run_errormap(*options); }};
}

}  // namespace xpr::cli
