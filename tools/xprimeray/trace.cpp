// xprimeray trace: a ray table in, a ray table out.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "core/io/atomic_output.hpp"
#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "core/io/provenance.hpp"
#include "core/io/ray_table.hpp"
#include "core/projection_names.hpp"
#include "core/trace_table.hpp"
#include "core/transport.hpp"
#include "metrics/catalogue.hpp"

namespace xpr::cli {
namespace {

struct TraceOptions {
  CLI::App* app = nullptr;
  OutputFlags output;
  std::string config;
  std::string rays;
  std::string out;
  std::vector<std::string> set;
  std::string project = "none";
  TransportSettings transport{.metric = ""};
  bool renormalise = false;
  int threads = 0;
  int lanes = 0;
};

// Settings as they are after defaults, for people who want to repeat the run.
Json resolved(const TraceOptions& options, const Transport& transport) {
  const TransportSettings& settings = transport.settings();
  const TraceSettings& trace = settings.trace;
  Json parameters = Json::object();
  for (const NamedValue& p : settings.parameters) parameters[std::string(p.name)] = json_number(p.value);
  Json json{{"metric", settings.metric}, {"set", parameters}, {"chart", settings.chart}};
  json["transport-chart"] = settings.transport_chart.empty() ? fmt::format("{} where p^t > 0, {} where p^t < 0",
                                                                           transport_chart(settings.metric, true),
                                                                           transport_chart(settings.metric, false))
                                                             : settings.transport_chart;
  json["method"] = trace.method;
  const bool adaptive = method_card(trace.method).adaptive;
  json[adaptive ? "tol" : "step"] = json_number(adaptive ? trace.tol : trace.step);
  json["project"] = options.project;
  if (trace.method.starts_with("tao")) json["tao-omega"] = json_number(trace.tao_omega);
  if (trace.r_min) json["r-min"] = json_number(*trace.r_min);
  json["r-max"] = trace.r_max ? json_number(*trace.r_max)
                              : Json(fmt::format("the larger of {} and 2 r of the start", 1000.0 * trace.length_unit));
  if (trace.l_min) json["l-min"] = json_number(*trace.l_min);
  if (trace.l_max) json["l-max"] = json_number(*trace.l_max);
  json["lambda-max"] = json_number(trace.lambda_max);
  json["max-steps"] = trace.max_steps;
  json["renormalise"] = options.renormalise;
  json["rays"] = options.rays;
  json["out"] = options.out;
  return json;
}

Json counts_by_status(const TraceTableResult& result) {
  Json json = Json::object();
  for (std::size_t k = 0; k < status_names.size(); ++k) {
    if (result.with_status[k] > 0) json[std::string(status_names[k])] = result.with_status[k];
  }
  return json;
}

Json meta(const TraceOptions& options, const Transport& transport, const TraceTableResult& result, double seconds) {
  Provenance origin = provenance();
  return {{"schema", std::string(traced_ray_schema_name)},
          {"schema_version", std::string(ray_schema_version)},
          {"configuration", resolved(options, transport)},
          {"rays", result.rays},
          {"status", counts_by_status(result)},
          {"steps", result.steps},
          {"evaluations", result.evaluations},
          {"rays_hash", result.rays_hash},
          {"volatile",
           {{"seconds", seconds},
            {"threads", options.threads},
            {"lanes", options.lanes},
            {"provenance", to_json(origin)}}}};
}

std::vector<std::pair<std::string, std::string>> table_attributes(const Transport& transport) {
  const TransportSettings& settings = transport.settings();
  Json parameters = Json::object();
  for (const NamedValue& p : settings.parameters) parameters[std::string(p.name)] = json_number(p.value);
  return {{"schema", std::string(traced_ray_schema_name)},
          {"schema_version", std::string(ray_schema_version)},
          {"metric", settings.metric},
          {"parameters", parameters.dump()},
          {"chart", settings.chart}};
}

// A table that says of which metric and chart it is must be of those that are asked for; without --chart, its own is
// taken.
void agree_with_table(TraceOptions& options) {
  if (table_format(options.rays) != TableFormat::hdf5) return;
  const Hdf5File file = Hdf5File::open(options.rays);
  const auto attribute = [&](const std::string& name) {
    return file.has_attribute("/rays", name) ? file.text_attribute("/rays", name) : std::string();
  };
  if (options.transport.chart.empty()) options.transport.chart = attribute("chart");
  const std::pair<std::string, std::string> asked[] = {{"metric", options.transport.metric},
                                                       {"chart", options.transport.chart}};
  for (const auto& [name, value] : asked) {
    const std::string own = attribute(name);
    if (!own.empty() && own != value) {
      throw InputError(fmt::format("{}: holds rays of {} '{}', asked for is '{}'", options.rays, name, own, value));
    }
  }
}

void report(const TraceOptions& options, const TraceTableResult& result, double seconds, bool to_stdout) {
  if (options.output.json) {
    const Json line{{"event", "end"},
                    {"out", options.out},
                    {"rays", result.rays},
                    {"status", counts_by_status(result)},
                    {"rays_hash", result.rays_hash},
                    {"seconds", seconds}};
    fmt::print(to_stdout ? stdout : stderr, "{}\n", line.dump());
  } else if (!options.output.quiet) {
    std::string counts;
    const Json by_status = counts_by_status(result);
    for (const auto& [status, count] : by_status.items()) {
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count.get<std::int64_t>(), status);
    }
    fmt::print(to_stdout ? stdout : stderr, "{}: {} rays{}{} in {:.1f} s, rays_hash {}\n", options.out, result.rays,
               counts.empty() ? "" : ": ", counts, seconds, result.rays_hash);
  }
}

int run_trace(TraceOptions& options) {
  if (!options.config.empty()) apply_config(*options.app, options.config);
  if (options.transport.metric.empty()) throw InputError("trace: --metric is missing; see xprimeray list metrics");
  if (options.rays.empty()) throw InputError("trace: --rays is missing, a ray table that ends in .csv or .h5");
  if (options.out.empty()) throw InputError("trace: --out is missing, a file that ends in .csv or .h5");
  if (options.threads < 0) throw InputError("trace: --threads is negative, needs 0 (all cores) or more");
  check_lanes("trace", options.lanes);
  options.transport.trace.projection = projection_named(options.project);
  for (const std::string& text : options.set) add_parameter(options.transport.parameters, text);
  const TableFormat format = table_format(options.out);
  agree_with_table(options);
  const Transport transport(options.transport);

  catch_interrupts();
  const double begin = seconds_now();
  TraceTableSettings settings{.renormalise = options.renormalise, .threads = options.threads, .lanes = options.lanes};
  settings.interrupted = interrupted;
  AtomicFile out(options.out);
  const std::int64_t rays = check_rays(options.rays, transport, settings);

  TraceTableResult result;
  {
    ProgressLine line("trace", !options.output.quiet && !options.output.json);
    settings.progress = [&](std::int64_t done, std::int64_t all) {
      line.update(done, all);
      if (!options.output.json) return;
      fmt::print(stdout, "{}\n", Json{{"event", "progress"}, {"done", done}, {"rays", all}}.dump());
      std::fflush(stdout);
    };
    const Card& chart = transport.chart().card();
    const auto reader = open_table(options.rays, ray_schema(chart));
    const auto writer = create_table(out.path(), format, traced_ray_schema(chart), table_attributes(transport));
    result = trace_table(transport, *reader, *writer, rays, settings);
    writer->close();
  }
  const double seconds = seconds_now() - begin;
  if (out.regular()) {
    AtomicFile beside(options.out + ".meta.json");
    beside.write(meta(options, transport, result, seconds).dump(2) + "\n");
    out.commit();
    beside.commit();
  } else {
    out.commit();
  }
  report(options, result, seconds, out.regular());
  return 0;
}

void add_options(CLI::App& app, TraceOptions& options) {
  TraceSettings& trace = options.transport.trace;
  app.add_option("--metric", options.transport.metric, "Spacetime, as in `xprimeray list metrics`");
  app.add_option("--set", options.set, "A parameter of it: --set a=0.9 (repeat for more)")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app.add_option("--chart", options.transport.chart, "Chart of the table, in and out (default: the metric's first)");
  app.add_option("--transport-chart", options.transport.transport_chart,
                 "Chart to trace in (default: the one that is regular where the ray goes)");
  app.add_option("--rays", options.rays, "Ray table to read: .csv or .h5");
  app.add_option("--out", options.out, "Ray table to write: .csv or .h5; settings go to FILE.meta.json");
  app.add_option("--method", trace.method, "As in `xprimeray list methods`")->capture_default_str();
  app.add_option("--tol", trace.tol, "Tolerance of adaptive methods")->capture_default_str();
  app.add_option("--step", trace.step, "Step of the others, in lambda for |p_t| = 1")->capture_default_str();
  app.add_option("--project", options.project, "What each step restores: none, energy, momentum or full")
      ->capture_default_str();
  app.add_option("--tao-omega", trace.tao_omega, "Coupling of Tao's two copies of phase space")->capture_default_str();
  app.add_option("--r-min", trace.r_min, "Going inward through it: captured (default: just outside the horizon)");
  app.add_option("--r-max", trace.r_max, "Going outward through it: escaped (default: 1000, or twice r of the start)");
  app.add_option("--l-min", trace.l_min, "Proper distance from a throat; through it: crossed");
  app.add_option("--l-max", trace.l_max, "The same on the other side");
  app.add_option("--lambda-max", trace.lambda_max, "Affine parameter at which to stop: max_affine");
  app.add_option("--max-steps", trace.max_steps, "Accepted steps at which to stop: max_steps")->capture_default_str();
  app.add_flag("--renormalise", options.renormalise, "Solve for p0 instead of refusing rays off the light cone");
  app.add_option("--threads", options.threads, "0: one for each core; the result does not depend on it")
      ->capture_default_str();
  app.add_option("--lanes", options.lanes, "Rays side by side, 1, 2, 4 or 8; 0: best here; no result depends on it")
      ->capture_default_str();
  app.add_option("--config", options.config, "TOML file with any of these options; a flag beats the file");
  add_output_flags(app, options.output);
}

}  // namespace

Command register_trace(CLI::App& program) {
  auto options = std::make_shared<TraceOptions>();
  options->app = program.add_subcommand("trace", "Trace a table of rays: CSV or HDF5 in, CSV or HDF5 out");
  add_options(*options->app, *options);
  add_example(*options->app,
              "  xprimeray trace --metric kerr --set a=0.9 --set M=1 --chart boyer-lindquist \\\n"
              "      --method dop853 --tol 1e-12 --r-max 100 --r-min 1.5 --rays in.csv --out out.csv");
  return {options->app, [options] { return run_trace(*options); }};
}

}  // namespace xpr::cli
