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

struct MeshDescription {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;  ///< clean: drop_defects has been over it
  std::string source;                        ///< the file or the shape that it came from
};

struct MaterialDescription {
  std::string name;
  MaterialKind kind = MaterialKind::lit;
  Colour colour_a{0.8, 0.8, 0.8};
  Colour colour_b{0.2, 0.2, 0.2};
  std::array<std::int64_t, 2> squares{8, 8};
};

struct InstanceDescription {
  std::string path;
  std::string parent;    ///< path of the instance whose transform comes after this one's; empty: none
  std::string mesh;      ///< by name; empty: a group, which only carries others
  std::string material;  ///< by name; empty: those that the mesh names itself, else "default"
  Affine3 transform;
  bool solid = false;
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

  void add(MeshDescription mesh, SourcePlace place) { meshes_.push_back({std::move(mesh), std::move(place)}); }
  void add(MaterialDescription material, SourcePlace place) {
    materials_.push_back({std::move(material), std::move(place)});
  }
  void add(InstanceDescription instance, SourcePlace place) {
    instances_.push_back({std::move(instance), std::move(place)});
  }
  void warn(std::string line) { warnings_.push_back(std::move(line)); }

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
  [[nodiscard]] SceneMaterials finished_materials() const;
  void finish_instances(SceneSnapshot& scene) const;
  [[nodiscard]] Affine3 to_world(const Said<InstanceDescription>& instance) const;
  [[nodiscard]] std::shared_ptr<const TriangleMesh> with_scene_materials(const Said<MeshDescription>& mesh,
                                                                         const SceneMaterials& materials) const;
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
  std::vector<Said<MeshDescription>> meshes_;
  std::vector<Said<MaterialDescription>> materials_;
  std::vector<Said<InstanceDescription>> instances_;
  std::vector<std::string> warnings_;
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
