#include <fmt/format.h>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/geometry/affine3.hpp"
#include "core/io/errors.hpp"
#include "core/io/mesh_formats.hpp"

namespace xpr {
namespace {

/// The numbers of an accessor, where they lie; checked to lie in their buffer.
struct Numbers {
  const unsigned char* first = nullptr;
  std::size_t count = 0, stride = 0;
  int component = 0;

  [[nodiscard]] float real(std::size_t item, std::size_t k) const { return as<float>(item, k); }
  [[nodiscard]] std::uint32_t index(std::size_t item) const {
    if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return as<std::uint8_t>(item, 0);
    if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return as<std::uint16_t>(item, 0);
    return as<std::uint32_t>(item, 0);
  }

 private:
  template <class T>
  [[nodiscard]] T as(std::size_t item, std::size_t k) const {
    T value;
    std::memcpy(&value, first + item * stride + k * sizeof(T), sizeof(T));
    return value;
  }
};

/// One glTF model on its way to becoming a mesh.
class GltfScene {
 public:
  GltfScene(const std::filesystem::path& path, const tinygltf::Model& model) : path_(path), model_(model) {
    for (const std::string& extension : model.extensionsRequired) {
      if (extension.rfind("KHR_materials_", 0) != 0) fail("the extension", extension, "is required and not known here");
    }
    for (std::size_t m = 0; m < model.materials.size(); ++m) {
      const std::string& name = model.materials[m].name;
      mesh_.material_names.push_back(name.empty() ? fmt::format("material {}", m) : name);
    }
    seen_.resize(model.nodes.size());
    for (const int root : roots()) add_node(root, {}, "the scene");
    if (!with_normals_) mesh_.normals.clear();
    if (!with_uv_) mesh_.uv.clear();
    if (mesh_.material_names.empty()) mesh_.materials.clear();
  }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  template <class Which>
  [[noreturn]] void fail(const char* what, const Which& which, const std::string& wrong) const {
    throw InputError(fmt::format("{}: {} {} {}", path_.string(), what, which, wrong));
  }

  /// list[index], or an error that says who refers to what is not there.
  template <class T>
  const T& at(const std::vector<T>& list, int index, const char* what, const std::string& from) const {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
      fail(what, index, fmt::format("is not there ({} of them), but {} refers to it", list.size(), from));
    }
    return list[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] std::vector<int> roots() const {
    if (model_.scenes.empty()) throw InputError(path_.string() + ": has no scene");
    return at(model_.scenes, model_.defaultScene < 0 ? 0 : model_.defaultScene, "scene", "the file").nodes;
  }

  void add_node(int index, const Affine3& above, const std::string& from) {
    const tinygltf::Node& node = at(model_.nodes, index, "node", from);
    const auto place = static_cast<std::size_t>(index);
    if (seen_[place]) fail("node", index, "is reached twice: it stands in a cycle or has two parents");
    seen_[place] = true;
    const Affine3 to_scene = above * local_map(node, index);
    const std::string name = fmt::format("node {}", index);
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = at(model_.meshes, node.mesh, "mesh", name);
      for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
        add_primitive(mesh.primitives[p], to_scene, fmt::format("primitive {} of mesh {}", p, node.mesh), index);
      }
    }
    for (const int child : node.children) add_node(child, to_scene, name);
  }

  [[nodiscard]] Affine3 local_map(const tinygltf::Node& node, int index) const {
    const auto sized = [&](const std::vector<double>& v, std::size_t n, const char* what) {
      if (!v.empty() && v.size() != n)
        fail("node", index, fmt::format("has {} numbers for its {}, needs {}", v.size(), what, n));
      return !v.empty();
    };
    if (sized(node.matrix, 16, "matrix")) {
      const std::vector<double>& m = node.matrix;  // by columns
      return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    Affine3 map;
    if (sized(node.rotation, 4, "rotation")) {
      const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
      const double twice = 2.0 / (x * x + y * y + z * z + w * w);
      map.x_axis = {1 - twice * (y * y + z * z), twice * (x * y + z * w), twice * (x * z - y * w)};
      map.y_axis = {twice * (x * y - z * w), 1 - twice * (x * x + z * z), twice * (y * z + x * w)};
      map.z_axis = {twice * (x * z + y * w), twice * (y * z - x * w), 1 - twice * (x * x + y * y)};
    }
    if (sized(node.scale, 3, "scale")) {
      map.x_axis = node.scale[0] * map.x_axis;
      map.y_axis = node.scale[1] * map.y_axis;
      map.z_axis = node.scale[2] * map.z_axis;
    }
    if (sized(node.translation, 3, "translation")) {
      map.shift = {node.translation[0], node.translation[1], node.translation[2]};
    }
    return map;
  }

  /// The numbers behind an accessor of the type that is needed.
  [[nodiscard]] Numbers numbers(int accessor_index, int type, bool indices, const std::string& from) const {
    const tinygltf::Accessor& accessor = at(model_.accessors, accessor_index, "accessor", from);
    const auto bad = [&](const std::string& wrong) { fail("accessor", accessor_index, wrong); };
    if (accessor.sparse.isSparse) bad("is sparse, which is not read here");
    const bool whole = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != type || (indices ? !whole : accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)) {
      bad(fmt::format("has component type {} and type {}, {} of {} needs other ones", accessor.componentType,
                      accessor.type, indices ? "the list of corners" : "an attribute", from));
    }
    const tinygltf::BufferView& view =
        at(model_.bufferViews, accessor.bufferView, "buffer view", fmt::format("accessor {}", accessor_index));
    const tinygltf::Buffer& buffer =
        at(model_.buffers, view.buffer, "buffer", fmt::format("buffer view {}", accessor.bufferView));
    const int stride = accessor.ByteStride(view);
    const auto item =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
                                 tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    const std::size_t size = buffer.data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset) {
      fail("buffer view", accessor.bufferView,
           fmt::format("has bytes {} + {}, its buffer {}", view.byteOffset, view.byteLength, size));
    }
    if (stride < static_cast<int>(item)) bad(fmt::format("has the stride {}, an item has {} bytes", stride, item));
    const auto step = static_cast<std::size_t>(stride);
    const bool fits = accessor.count == 0 ||
                      (accessor.byteOffset <= view.byteLength && view.byteLength - accessor.byteOffset >= item &&
                       (view.byteLength - accessor.byteOffset - item) / step >= accessor.count - 1);
    if (!fits) {
      bad(fmt::format("has {} items from byte {} on, {} bytes apart: more than the {} bytes of its buffer view",
                      accessor.count, accessor.byteOffset, step, view.byteLength));
    }
    return {buffer.data.data() + view.byteOffset + accessor.byteOffset, accessor.count, step, accessor.componentType};
  }

  [[nodiscard]] std::optional<Numbers> attribute(const tinygltf::Primitive& primitive, const char* name, int type,
                                                 const std::string& from, std::size_t count) const {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    const Numbers out = numbers(found->second, type, false, from);
    if (out.count != count)
      fail("accessor", found->second, fmt::format("has {} items, {} has {} positions", out.count, from, count));
    return out;
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Affine3& to_scene, const std::string& from, int node) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end())
      throw InputError(fmt::format("{}: {} has no POSITION", path_.string(), from));
    const Numbers points = numbers(position->second, TINYGLTF_TYPE_VEC3, false, from);
    const auto normals = attribute(primitive, "NORMAL", TINYGLTF_TYPE_VEC3, from, points.count);
    const auto uv = attribute(primitive, "TEXCOORD_0", TINYGLTF_TYPE_VEC2, from, points.count);
    with_normals_ = with_normals_ && normals;
    with_uv_ = with_uv_ && uv;
    const std::size_t first = mesh_.vertices.size();
    if (points.count > std::numeric_limits<std::uint32_t>::max() - first) {
      throw InputError(path_.string() + ": more than 2^32 vertices");
    }
    const Affine3 back = inverse_of(to_scene, node);
    for (std::size_t i = 0; i < points.count; ++i) {
      mesh_.vertices.push_back(to_scene.point(three(points, i)));
      mesh_.normals.push_back(normals ? normalized(back.transposed(three(*normals, i))) : Vec3{});
      mesh_.uv.push_back(uv ? std::array<double, 2>{uv->real(i, 0), uv->real(i, 1)} : std::array<double, 2>{});
    }
    std::vector<std::uint32_t> corners = corners_of(primitive, points.count, from);
    for (std::uint32_t& corner : corners) corner += static_cast<std::uint32_t>(first);
    add_triangles(corners, primitive, to_scene.determinant() < 0.0, from);
  }

  [[nodiscard]] Affine3 inverse_of(const Affine3& map, int node) const {
    try {
      return map.inverse();
    } catch (const std::invalid_argument& error) {
      fail("node", node, fmt::format("cannot be placed: {}", error.what()));
    }
  }

  [[nodiscard]] static Vec3 three(const Numbers& from, std::size_t i) {
    return {from.real(i, 0), from.real(i, 1), from.real(i, 2)};
  }

  [[nodiscard]] std::vector<std::uint32_t> corners_of(const tinygltf::Primitive& primitive, std::size_t vertices,
                                                      const std::string& from) const {
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
      for (std::size_t i = 0; i < vertices; ++i) corners.push_back(static_cast<std::uint32_t>(i));
      return corners;
    }
    const Numbers list = numbers(primitive.indices, TINYGLTF_TYPE_SCALAR, true, from);
    for (std::size_t i = 0; i < list.count; ++i) {
      corners.push_back(list.index(i));
      if (corners.back() >= vertices) {
        fail("accessor", primitive.indices,
             fmt::format("has the corner {} at place {}, {} has the vertices 0 to {}", corners.back(), i, from,
                         static_cast<std::int64_t>(vertices) - 1));
      }
    }
    return corners;
  }

  void add_triangles(const std::vector<std::uint32_t>& c, const tinygltf::Primitive& primitive, bool mirrored,
                     const std::string& from) {
    std::uint32_t material = 0;
    if (primitive.material >= 0) {
      static_cast<void>(at(model_.materials, primitive.material, "material", from));
      material = static_cast<std::uint32_t>(primitive.material);
    }
    const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
      mesh_.triangles.push_back(mirrored ? std::array{i, k, j} : std::array{i, j, k});
      mesh_.materials.push_back(material);
    };
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      if (c.size() % 3 != 0)
        throw InputError(
            fmt::format("{}: {} has {} corners, not three for each triangle", path_.string(), from, c.size()));
      for (std::size_t i = 0; i + 2 < c.size(); i += 3) add(c[i], c[i + 1], c[i + 2]);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t i = 0; i + 2 < c.size(); ++i) add(c[i], c[i + 1 + i % 2], c[i + 2 - i % 2]);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      for (std::size_t i = 1; i + 1 < c.size(); ++i) add(c[0], c[i], c[i + 1]);
    } else {
      throw InputError(fmt::format("{}: {} has the mode {}, which makes no triangles", path_.string(), from, mode));
    }
  }

  const std::filesystem::path& path_;
  const tinygltf::Model& model_;
  TriangleMesh mesh_;
  std::vector<bool> seen_;
  bool with_normals_ = true, with_uv_ = true;
};

/// The first line of what tinygltf says, which may be many.
[[nodiscard]] std::string first_line(const std::string& text) {
  return text.empty() ? "is no glTF 2.0" : text.substr(0, text.find('\n'));
}

}  // namespace

TriangleMesh mesh_from_gltf(const std::filesystem::path& path, const std::string& bytes, bool binary) {
  if (bytes.size() > std::numeric_limits<unsigned int>::max())
    throw InputError(path.string() + ": is longer than 4 GiB");
  const auto size = static_cast<unsigned int>(bytes.size());
  const std::string folder = path.parent_path().empty() ? "." : path.parent_path().string();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  bool well = false;
  try {
    well = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                  : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  if (!well) throw InputError(fmt::format("{}: {}", path.string(), first_line(error)));
  return GltfScene(path, model).take();
}

}  // namespace xpr
