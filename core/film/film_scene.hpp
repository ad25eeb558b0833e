// A snapshot made ready to be exposed: its spacetime or fields, its rays' tracer, its colours.
#pragma once

#include <memory>

#include "core/film/film.hpp"
#include "core/scene/snapshot.hpp"

namespace xpr {

class FilmScene {
 public:
  /// `lanes` 0: the width that traces fastest here. The geometry must outlive this. Throws std::invalid_argument: a
  /// camera or an observer that cannot be there, a tier that the scene's spacetime does not have.
  FilmScene(std::shared_ptr<const SceneSnapshot> scene, const SceneGeometry& geometry, int lanes);

  [[nodiscard]] const FilmTracer& tracer() const { return *tracer_; }
  [[nodiscard]] Shader shader() const;
  [[nodiscard]] int lanes() const { return lanes_; }

 private:
  std::shared_ptr<const SceneSnapshot> scene_;
  int lanes_;
  std::unique_ptr<FilmTracer> tracer_;
};

}  // namespace xpr
