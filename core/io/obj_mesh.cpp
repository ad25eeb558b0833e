#include <fmt/format.h>

// As Debian's libtinyobjloader_double was compiled.
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/mesh_formats.hpp"

namespace xpr {
namespace {

/// What tinyobjloader passes over in silence: it takes `1,5`, `nan` and missing numbers for 0, does not round numbers
/// to the nearest double, and has no line numbers. So numbers and references are read and checked here, line by line;
/// polygons, groups and materials are left to it.
class ObjText {
 public:
  ObjText(const std::filesystem::path& path, std::string_view text) : path_(path) {
    std::size_t begin = 0;
    while (begin < text.size()) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      ++line_;
      read_line(text.substr(begin, end - begin));
      begin = end + 1;
    }
    check_references();
  }

  std::vector<double> vertices, normals, uv;  // three, three and two numbers each
  std::vector<std::string> materials;         // in the order of their first use

 private:
  /// How many vertices, uv and normals a corner's numbers may go up to, and where the largest stands.
  struct Reference {
    const char* what;
    std::int64_t largest = 0;
    std::size_t line = 0;
  };

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", path_.string(), line, what));
  }

  [[nodiscard]] static std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    const std::string_view blanks = " \t\r";
    for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
      words.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(blanks, end);
    }
    return words;
  }

  void read_line(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0].front() == '#') return;
    if (words[0] == "v") read_numbers(words, "vertex", 3, vertices);
    if (words[0] == "vn") read_numbers(words, "normal", 3, normals);
    if (words[0] == "vt") read_numbers(words, "uv", 2, uv);
    if (words[0] == "f") read_face(words);
    if (words[0] == "usemtl") {
      if (words.size() < 2) fail(line_, "usemtl names no material");
      if (std::find(materials.begin(), materials.end(), words[1]) == materials.end()) materials.emplace_back(words[1]);
    }
  }

  void read_numbers(const std::vector<std::string_view>& words, const char* what, std::size_t needed,
                    std::vector<double>& into) {
    if (words.size() <= needed) {
      fail(line_, fmt::format("a {} has {} numbers, needs {}", what, words.size() - 1, needed));
    }
    for (std::size_t k = 1; k <= needed; ++k) {
      double value = 0.0;
      if (parse_number(words[k], value) != NumberFault::none) {
        fail(line_, fmt::format("'{}' in a {} is no number", words[k], what));
      }
      into.push_back(value);
    }
  }

  void read_face(const std::vector<std::string_view>& words) {
    if (words.size() < 4) fail(line_, fmt::format("a face has {} corners, needs 3", words.size() - 1));
    for (std::size_t k = 1; k < words.size(); ++k) {
      const std::size_t so_far[3] = {vertices.size() / 3, uv.size() / 2, normals.size() / 3};
      std::string_view rest = words[k];
      for (std::size_t part = 0; part < 3; ++part) {
        const std::size_t slash = std::min(rest.find('/'), rest.size());
        // Vertex alone, vertex/uv, vertex//normal, vertex/uv/normal.
        if (slash > 0 || part == 0) refer(words[k], rest.substr(0, slash), so_far[part], references_[part]);
        if (slash == rest.size()) break;
        rest.remove_prefix(slash + 1);
        if (part == 2) fail(line_, fmt::format("the corner '{}' has more than three numbers", words[k]));
      }
    }
  }

  void refer(std::string_view corner, std::string_view word, std::size_t so_far, Reference& reference) {
    std::int64_t index = 0;
    if (parse_number(word, index) != NumberFault::none) {
      fail(line_, fmt::format("the corner '{}' has no number for its {}", corner, reference.what));
    }
    const auto known = static_cast<std::int64_t>(so_far);
    if (index == 0 || index < -known) {
      fail(line_,
           fmt::format("the corner '{}' refers to {} {}, there are {} so far", corner, reference.what, index, known));
    }
    if (index > reference.largest) reference = {reference.what, index, line_};
  }

  void check_references() const {
    const std::size_t known[3] = {vertices.size() / 3, uv.size() / 2, normals.size() / 3};
    for (std::size_t part = 0; part < 3; ++part) {
      const Reference& reference = references_[part];
      if (reference.largest <= static_cast<std::int64_t>(known[part])) continue;
      fail(reference.line,
           fmt::format("a corner refers to {} {}, the file has {}", reference.what, reference.largest, known[part]));
    }
  }

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  Reference references_[3] = {{"vertex"}, {"uv"}, {"normal"}};
};

/// Gives the names that the text uses as materials, without a look at any .mtl file.
class NamesOnly final : public tinyobj::MaterialReader {
 public:
  explicit NamesOnly(const std::vector<std::string>& names) : names_(names) {}
  bool operator()(const std::string&, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* known,
                  std::string*, std::string*) override {
    if (!known->empty()) return true;
    for (const std::string& name : names_) {
      known->emplace(name, static_cast<int>(materials->size()));
      materials->emplace_back().name = name;
    }
    return true;
  }

 private:
  const std::vector<std::string>& names_;
};

/// Corners that agree in vertex, uv and normal become one vertex of the mesh.
class Joined {
 public:
  Joined(const ObjText& text, bool with_uv, bool with_normals)
      : text_(text), with_uv_(with_uv), with_normals_(with_normals) {}

  std::uint32_t vertex(const tinyobj::index_t& corner) {
    const std::array<int, 3> key{corner.vertex_index, with_uv_ ? corner.texcoord_index : -1,
                                 with_normals_ ? corner.normal_index : -1};
    const auto [at, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.push_back(three(text_.vertices, key[0]));
      if (with_uv_) {
        const std::size_t first = 2 * static_cast<std::size_t>(key[1]);
        mesh.uv.push_back({text_.uv[first], text_.uv[first + 1]});
      }
      if (with_normals_) mesh.normals.push_back(three(text_.normals, key[2]));
    }
    return at->second;
  }

  TriangleMesh mesh;

 private:
  [[nodiscard]] static Vec3 three(const std::vector<double>& from, int index) {
    const std::size_t first = 3 * static_cast<std::size_t>(index);
    return {from[first], from[first + 1], from[first + 2]};
  }

  const ObjText& text_;
  bool with_uv_, with_normals_;
  std::map<std::array<int, 3>, std::uint32_t> known_;
};

}  // namespace

TriangleMesh mesh_from_obj(const std::filesystem::path& path, const std::string& bytes) {
  const ObjText text(path, bytes);
  // The reader of materials is asked at a line `mtllib`; one more at the head makes sure of it.
  std::istringstream in("mtllib names\n" + bytes);
  NamesOnly names(text.materials);
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &in, &names, true)) {
    throw InputError(fmt::format("{}: {}", path.string(), error.substr(0, error.find('\n'))));
  }
  bool with_uv = true, with_normals = true;
  for (const tinyobj::shape_t& shape : shapes) {
    for (const tinyobj::index_t& corner : shape.mesh.indices) {
      with_uv = with_uv && corner.texcoord_index >= 0;
      with_normals = with_normals && corner.normal_index >= 0;
    }
  }
  Joined joined(text, with_uv, with_normals);
  TriangleMesh& mesh = joined.mesh;
  for (const tinyobj::shape_t& shape : shapes) {
    for (std::size_t face = 0; face < shape.mesh.num_face_vertices.size(); ++face) {
      const tinyobj::index_t* corner = &shape.mesh.indices[3 * face];
      const std::uint32_t a = joined.vertex(corner[0]), b = joined.vertex(corner[1]), c = joined.vertex(corner[2]);
      mesh.triangles.push_back({a, b, c});
      if (!materials.empty()) {
        // Faces before the first usemtl take the first material.
        mesh.materials.push_back(static_cast<std::uint32_t>(std::max(0, shape.mesh.material_ids[face])));
      }
    }
  }
  mesh.material_names = text.materials;
  return std::move(mesh);
}

}  // namespace xpr
