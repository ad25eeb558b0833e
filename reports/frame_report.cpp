#include "reports/frame_report.hpp"

#include <fmt/format.h>

#include "core/film/film_class.hpp"
#include "core/film/frame_file.hpp"
#include "core/film/tone.hpp"
#include "core/io/atomic_output.hpp"
#include "core/io/exr.hpp"
#include "core/io/hash.hpp"
#include "core/io/hdf5_file.hpp"
#include "core/io/png.hpp"
#include "reports/origin.hpp"

namespace xpr {
namespace {

void write_h5(const FrameInputs& inputs, const std::string& hash, const std::filesystem::path& path) {
  Hdf5File file = Hdf5File::create(path);
  file.set_attribute("/", "schema", "xprimeray-frame");
  file.set_attribute("/", "schema_version", std::int64_t{1});
  file.set_attribute("/", "title", inputs.title);
  write_planes(file, inputs.frame);
  write_origin(file, {inputs.provenance, inputs.command, inputs.configuration, {{"frame_hash", hash}}});
  file.set_attribute("/volatile", "seconds", inputs.seconds);
  file.set_attribute("/volatile", "threads", std::int64_t{inputs.threads});
  file.set_attribute("/volatile", "lanes", std::int64_t{inputs.lanes});
  file.close();
}

void write_image(const FilmFrame& frame, const std::filesystem::path& path) {
  std::vector<ImageChannel> channels;
  for (const FilmPlane& plane : frame.planes) channels.push_back({plane.name, plane.values});
  write_exr(path, frame.columns, frame.rows, channels);
}

Json classes_json(const FilmTelemetry& telemetry) {
  Json classes = Json::object();
  for (std::size_t k = 0; k < telemetry.classes.size(); ++k) {
    classes[std::string(film_class_names[k])] = telemetry.classes[k];
  }
  return classes;
}

Json statuses_json(const FilmTelemetry& telemetry) {
  Json statuses = Json::object();
  for (std::size_t k = 0; k < telemetry.statuses.size(); ++k) {
    if (telemetry.statuses[k] > 0) statuses[std::string(status_names[k])] = telemetry.statuses[k];
  }
  return statuses;
}

std::int64_t pixels_of(const FilmFrame& frame) { return std::int64_t{frame.columns} * frame.rows; }

/// Pixels of sealed scenes: everything but what got away, ran out or is not understood.
double closed_part(const FilmFrame& frame) {
  const auto& classes = frame.telemetry.classes;
  std::int64_t open = 0;
  for (const FilmClass k : {FilmClass::escaped_no_hit, FilmClass::budget_exhausted, FilmClass::unclassified}) {
    open += classes[static_cast<std::size_t>(k)];
  }
  return 1.0 - static_cast<double>(open) / static_cast<double>(pixels_of(frame));
}

std::string json_text(const FrameInputs& inputs, const std::string& hash) {
  const FilmFrame& frame = inputs.frame;
  const GeometryCounts& geometry = frame.telemetry.geometry;
  const Json out = {{"schema", "xprimeray-frame-summary"},
                    {"schema_version", 1},
                    {"title", inputs.title},
                    {"banner", inputs.banner},
                    {"columns", frame.columns},
                    {"rows", frame.rows},
                    {"frame_hash", hash},
                    {"classes", classes_json(frame.telemetry)},
                    {"statuses", statuses_json(frame.telemetry)},
                    {"closed", closed_part(frame)},
                    {"rays", frame.telemetry.rays},
                    {"steps", frame.telemetry.steps},
                    {"geometry",
                     {{"paths", geometry.paths},
                      {"nodes", geometry.nodes},
                      {"triangles", geometry.triangles},
                      {"hits", geometry.hits}}},
                    {"configuration", inputs.configuration},
                    {"command", inputs.command},
                    {"version", inputs.provenance.version},
                    {"commit", inputs.provenance.commit},
                    {"seconds", inputs.seconds}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string page_of(const FrameInputs& inputs, const std::string& hash) {
  const FilmFrame& frame = inputs.frame;
  std::string page = fmt::format("# Frame: {}\n\n", inputs.title);
  if (!inputs.banner.empty()) page += fmt::format("`{}`\n\n", inputs.banner);
  page += fmt::format("![{}](frame.png)\n\n{}\n\n| class | pixels | part |\n| --- | ---: | ---: |\n", inputs.title,
                      health_line(inputs));
  for (std::size_t k = 0; k < frame.telemetry.classes.size(); ++k) {
    const std::int64_t count = frame.telemetry.classes[k];
    if (count == 0) continue;
    page += fmt::format("| {} | {} | {:.2f} % |\n", film_class_names[k], count,
                        100.0 * static_cast<double>(count) / static_cast<double>(pixels_of(frame)));
  }
  page += fmt::format("\nReproduce: `{}`\n\nframe_hash {}; {} {}; every number: frame.h5, channels: frame.exr.\n",
                      inputs.command, hash, inputs.provenance.version, inputs.provenance.commit);
  return page;
}

}  // namespace

std::string frame_hash(const FilmFrame& frame) {
  CanonicalHash hash;
  for (const FilmPlane& plane : frame.planes) hash.dataset(plane.name).add(std::span<const double>(plane.values));
  return hash.hex();
}

void check_frame_directory(const std::filesystem::path& directory) {
  const AtomicDirectory probe(directory, frame_file_name);
}

void write_frame(const FrameInputs& inputs, const std::filesystem::path& directory) {
  AtomicDirectory out(directory, frame_file_name);
  const std::string hash = frame_hash(inputs.frame);
  write_h5(inputs, hash, out.path() / frame_file_name);
  write_image(inputs.frame, out.path() / "frame.exr");
  write_png(out.path() / "frame.png", inputs.frame.columns, inputs.frame.rows, displayed(inputs.frame));
  write_file(out.path() / "frame.json", json_text(inputs, hash));
  write_file(out.path() / "frame.md", page_of(inputs, hash));
  out.commit();
}

std::string health_line(const FrameInputs& inputs) {
  const FilmFrame& frame = inputs.frame;
  const auto pixels = static_cast<double>(pixels_of(frame));
  const auto hits = static_cast<double>(frame.telemetry.classes[static_cast<std::size_t>(FilmClass::geom_hit)]);
  const auto rays = static_cast<double>(frame.telemetry.rays);
  return fmt::format("{} x {} pixels, {} rays, {:.1f} steps a ray, hit rate {:.4f}, closed {:.4f}, candidates {} a ray",
                     frame.columns, frame.rows, frame.telemetry.rays, static_cast<double>(frame.telemetry.steps) / rays,
                     hits / pixels, closed_part(frame),
                     frame.telemetry.geometry.paths == 0
                         ? std::string("na")
                         : fmt::format("{:.2f}", static_cast<double>(frame.telemetry.geometry.triangles) / rays));
}

}  // namespace xpr
