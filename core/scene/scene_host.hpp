// The seam between a scene and whoever has it: a host, such as a scene file or an engine, tells a builder what there
// is, in any order; the builder checks it, fixes the order and makes the snapshot.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/io/source_place.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

/// What a flag on the command line says in place of the scene.
struct SceneFlags {
  std::optional<std::string> preset = {};
  std::optional<int> tier = {};
  std::optional<std::string> method = {};
  std::optional<double> tol = {};
  std::optional<double> scale = {};
  std::optional<std::int64_t> samples = {};
};

/// Collects what a host says. What is not said keeps its default. The place of each part is where errors point to.
class SceneBuilder {
 public:
  void set(SceneHeader header, SourcePlace place) { header_ = {std::move(header), std::move(place)}; }
  void set(SceneCamera camera, SourcePlace place) { camera_ = {std::move(camera), std::move(place)}; }
  void set(SceneObserver observer, SourcePlace place) { observer_ = {std::move(observer), std::move(place)}; }
  void set(SceneTransport transport, SourcePlace place) { transport_ = {std::move(transport), std::move(place)}; }
  void set(SceneSpacetime spacetime, SourcePlace place) { spacetime_ = {std::move(spacetime), std::move(place)}; }
  void set(FieldGains gains, SourcePlace place) { gains_ = {gains, std::move(place)}; }
  void set(SceneSky sky, SourcePlace place) { sky_ = {std::move(sky), std::move(place)}; }
  void set(SceneFilm film, SourcePlace place) { film_ = {std::move(film), std::move(place)}; }
  /// Of `research` only the preset and the scene's own overrides are looked at.
  void set(SceneResearch research, SourcePlace place) { research_ = {std::move(research), std::move(place)}; }
  void add(FieldSource field, SourcePlace place) { fields_.push_back({std::move(field), std::move(place)}); }

  void set_flags(SceneFlags flags) { flags_ = std::move(flags); }

  /// The whole scene. Throws InputError: the place and what is wrong there.
  [[nodiscard]] std::shared_ptr<const SceneSnapshot> finish() const;

 private:
  template <class T>
  struct Said {
    T what{};
    SourcePlace place{};
  };

  [[nodiscard]] SceneHeader finished_header() const;
  [[nodiscard]] SceneCamera finished_camera() const;
  [[nodiscard]] FieldSet finished_fields() const;
  [[nodiscard]] SceneFilm finished_film() const;
  [[nodiscard]] SceneTransport finished_transport() const;
  void check_observer() const;
  void check_spacetime() const;
  void check_sky() const;
  void finish_research(SceneSnapshot& scene) const;

  Said<SceneHeader> header_;
  Said<SceneCamera> camera_;
  Said<SceneObserver> observer_;
  Said<SceneTransport> transport_;
  Said<SceneSpacetime> spacetime_;
  Said<FieldGains> gains_;
  Said<SceneSky> sky_;
  Said<SceneFilm> film_;
  Said<SceneResearch> research_;
  std::vector<Said<FieldSource>> fields_;
  SceneFlags flags_;
};

/// Whoever has a scene.
class SceneHost {
 public:
  virtual ~SceneHost() = default;
  /// Tells the builder everything, in any order. Throws InputError for what cannot be told.
  virtual void describe(SceneBuilder& builder) const = 0;
};

/// The snapshot of what a host has. Throws InputError.
[[nodiscard]] std::shared_ptr<const SceneSnapshot> make_snapshot(const SceneHost& host, SceneFlags flags = {});

}  // namespace xpr
