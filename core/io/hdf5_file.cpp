#include "core/io/hdf5_file.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/io/errors.hpp"

namespace xpr {
namespace {

// One HDF5 identifier, closed when it goes out of scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] bool good() const { return id_ >= 0; }
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// What HDF5's error stack says: the deepest entry's words, and the errno that a system call left there, if any.
struct StackStory {
  std::string deepest;
  int error_number = 0;
};

herr_t read_stack_entry(unsigned, const H5E_error2_t* entry, void* data) {
  auto& story = *static_cast<StackStory*>(data);
  if (entry->desc == nullptr) return 0;
  story.deepest = entry->desc;
  if (const char* mark = std::strstr(entry->desc, "errno = ")) story.error_number = std::atoi(mark + 8);
  return 0;
}

StackStory error_story() {
  StackStory story;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, read_stack_entry, &story);
  H5Eclear2(H5E_DEFAULT);
  return story;
}

// HDF5 prints its error stack and cleans up at exit unless told not to; after a full disk that clean-up never ends.
void prepare_library() {
  static const bool prepared = [] {
    H5dont_atexit();
    H5open();
    return true;
  }();
  static_cast<void>(prepared);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle creation_list(hid_t list_class) {
  Handle list(H5Pcreate(list_class), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  return list;
}

Handle links_with_parents() {
  Handle list(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(list.id(), 1);
  return list;
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Handle enum_type(hid_t base, std::span<const std::string_view> names) {
  Handle type(H5Tenum_create(base), H5Tclose);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto code = static_cast<signed char>(k);
    H5Tenum_insert(type.id(), std::string(names[k]).c_str(), &code);
  }
  return type;
}

std::string type_words(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return "float" + bits;
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") + bits;
    case H5T_STRING:
      return "text";
    case H5T_ENUM:
      return "an enum";
    default:
      return "of another type";
  }
}

bool is_type(hid_t type, H5T_class_t type_class, std::size_t size) {
  if (H5Tget_class(type) != type_class || H5Tget_size(type) != size) return false;
  return type_class != H5T_INTEGER || H5Tget_sign(type) == H5T_SGN_2;
}

std::vector<signed char> narrowed(std::span<const std::int64_t> codes) {
  std::vector<signed char> out(codes.size());
  std::transform(codes.begin(), codes.end(), out.begin(), [](std::int64_t k) { return static_cast<signed char>(k); });
  return out;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
  static_cast<std::vector<std::string>*>(data)->emplace_back(name);
  return 0;
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path path, Id file, bool writing)
    : path_(std::move(path)), file_(file), writing_(writing) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), writing_(other.writing_) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(writing_, other.writing_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  prepare_library();
  const Handle creation = creation_list(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  Hdf5File file(path, H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), true);
  if (file.file_ < 0) file.fail("cannot create the file");
  return file;
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  prepare_library();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  Hdf5File file(path, H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), false);
  if (file.file_ < 0) file.fail("cannot be read as HDF5");
  return file;
}

void Hdf5File::fail(const std::string& what) const {
  const StackStory story = error_story();
  if (story.error_number != 0) throw_system_error(path_, what, story.error_number);
  const std::string line = path_.string() + ": " + what + (story.deepest.empty() ? "" : " (" + story.deepest + ")");
  if (writing_) throw FaultError(line);
  throw InputError(line);
}

void Hdf5File::close() {
  if (file_ < 0) return;
  // Flushing first keeps a failure apart from a file that HDF5 can no longer close.
  const bool flushed = !writing_ || H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const StackStory story = flushed ? StackStory{} : error_story();
  const bool closed = H5Fclose(std::exchange(file_, -1)) >= 0;
  if (!flushed) {
    if (story.error_number != 0) throw_system_error(path_, "cannot write the file", story.error_number);
    throw FaultError(path_.string() + ": cannot write the file (" + story.deepest + ")");
  }
  if (!closed) fail("cannot close the file");
}

void Hdf5File::make_group(const std::string& path) {
  if (exists(path)) return;
  const Handle links = links_with_parents();
  const Handle creation = creation_list(H5P_GROUP_CREATE);
  const Handle group(H5Gcreate2(file_, path.c_str(), links.id(), creation.id(), H5P_DEFAULT), H5Gclose);
  if (!group.good()) fail("cannot create group " + path);
}

void Hdf5File::write_text(Id dataset, const std::string& path, const DatasetText& text) {
  if (dataset < 0) fail("cannot create dataset " + path);
  set_attribute(path, "units", text.units);
  set_attribute(path, "long_name", text.long_name);
}

void Hdf5File::write_dataset(const std::string& path, Id file_type, Id memory_type, std::size_t count, const void* data,
                             const DatasetText& text) {
  const hsize_t length = count;
  const Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  const Handle links = links_with_parents();
  const Handle creation = creation_list(H5P_DATASET_CREATE);
  const Handle dataset(H5Dcreate2(file_, path.c_str(), file_type, space.id(), links.id(), creation.id(), H5P_DEFAULT),
                       H5Dclose);
  write_text(dataset.id(), path, text);
  if (count > 0 && H5Dwrite(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    fail("cannot write dataset " + path);
  }
}

void Hdf5File::write(const std::string& path, std::span<const double> values, const DatasetText& text) {
  write_dataset(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data(), text);
}

void Hdf5File::write(const std::string& path, std::span<const std::int64_t> values, const DatasetText& text) {
  write_dataset(path, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data(), text);
}

void Hdf5File::write(const std::string& path, std::span<const std::string> values, const DatasetText& text) {
  std::vector<const char*> pointers(values.size());
  std::transform(values.begin(), values.end(), pointers.begin(), [](const std::string& s) { return s.c_str(); });
  const Handle type = text_type();
  write_dataset(path, type.id(), type.id(), values.size(), pointers.data(), text);
}

void Hdf5File::write_enum(const std::string& path, std::span<const std::int64_t> codes,
                          std::span<const std::string_view> names, const DatasetText& text) {
  const Handle file_type = enum_type(H5T_STD_I8LE, names);
  const Handle memory_type = enum_type(H5T_NATIVE_SCHAR, names);
  const std::vector<signed char> bytes = narrowed(codes);
  write_dataset(path, file_type.id(), memory_type.id(), bytes.size(), bytes.data(), text);
}

void Hdf5File::create_extendable(const std::string& path, Id file_type, const DatasetText& text, std::size_t chunk) {
  const hsize_t length = 0;
  const hsize_t unlimited = H5S_UNLIMITED;
  const hsize_t chunk_length = std::max<std::size_t>(chunk, 1);
  const Handle space(H5Screate_simple(1, &length, &unlimited), H5Sclose);
  const Handle links = links_with_parents();
  const Handle creation = creation_list(H5P_DATASET_CREATE);
  H5Pset_chunk(creation.id(), 1, &chunk_length);
  const Handle dataset(H5Dcreate2(file_, path.c_str(), file_type, space.id(), links.id(), creation.id(), H5P_DEFAULT),
                       H5Dclose);
  write_text(dataset.id(), path, text);
}

void Hdf5File::create_doubles(const std::string& path, const DatasetText& text, std::size_t chunk) {
  create_extendable(path, H5T_IEEE_F64LE, text, chunk);
}

void Hdf5File::create_integers(const std::string& path, const DatasetText& text, std::size_t chunk) {
  create_extendable(path, H5T_STD_I64LE, text, chunk);
}

void Hdf5File::create_enum(const std::string& path, std::span<const std::string_view> names, const DatasetText& text,
                           std::size_t chunk) {
  const Handle type = enum_type(H5T_STD_I8LE, names);
  create_extendable(path, type.id(), text, chunk);
}

void Hdf5File::append_raw(const std::string& path, Id memory_type, std::size_t count, const void* data) {
  if (count == 0) return;
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.good()) fail("no dataset " + path);
  const hsize_t start = size(path);
  const hsize_t added = count;
  const hsize_t length = start + added;
  if (H5Dset_extent(dataset.id(), &length) < 0) fail("cannot extend dataset " + path);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &start, nullptr, &added, nullptr);
  const Handle memory_space(H5Screate_simple(1, &added, nullptr), H5Sclose);
  if (H5Dwrite(dataset.id(), memory_type, memory_space.id(), space.id(), H5P_DEFAULT, data) < 0) {
    fail("cannot write dataset " + path);
  }
}

void Hdf5File::append(const std::string& path, std::span<const double> values) {
  append_raw(path, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void Hdf5File::append(const std::string& path, std::span<const std::int64_t> values) {
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.good()) fail("no dataset " + path);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (H5Tget_class(type.id()) == H5T_ENUM) {
    const std::vector<signed char> bytes = narrowed(values);
    const Handle native(H5Tget_native_type(type.id(), H5T_DIR_DEFAULT), H5Tclose);
    append_raw(path, native.id(), bytes.size(), bytes.data());
  } else {
    append_raw(path, H5T_NATIVE_INT64, values.size(), values.data());
  }
}

void Hdf5File::make_scale(const std::string& scale, const std::string& name) {
  const Handle dataset(H5Dopen2(file_, scale.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.good() || H5DSset_scale(dataset.id(), name.c_str()) < 0) {
    fail("cannot make " + scale + " a dimension scale");
  }
}

void Hdf5File::attach_scale(const std::string& dataset, const std::string& scale) {
  const Handle values(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle axis(H5Dopen2(file_, scale.c_str(), H5P_DEFAULT), H5Dclose);
  if (!values.good() || !axis.good() || H5DSattach_scale(values.id(), axis.id(), 0) < 0) {
    fail("cannot attach " + scale + " to " + dataset);
  }
}

void Hdf5File::set_attribute_raw(const std::string& path, const std::string& name, Id file_type, Id memory_type,
                                 const void* data) {
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.good()) fail("no object " + path);
  if (H5Aexists(object.id(), name.c_str()) > 0) H5Adelete(object.id(), name.c_str());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object.id(), name.c_str(), file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute.good() || H5Awrite(attribute.id(), memory_type, data) < 0) {
    fail("cannot write attribute " + name + " of " + path);
  }
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, std::string_view value) {
  const std::string text(value);
  const char* pointer = text.c_str();
  const Handle type = text_type();
  set_attribute_raw(path, name, type.id(), type.id(), &pointer);
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, double value) {
  set_attribute_raw(path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, std::int64_t value) {
  set_attribute_raw(path, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

bool Hdf5File::exists(const std::string& path) const {
  if (path == "/") return true;
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) {
      H5Eclear2(H5E_DEFAULT);
      return false;
    }
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Handle handle(exists(group) ? H5Gopen2(file_, group.c_str(), H5P_DEFAULT) : -1, H5Gclose);
  if (!handle.good()) fail("no group " + group);
  std::vector<std::string> names;
  if (H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names) < 0) {
    fail("cannot list group " + group);
  }
  return names;
}

bool Hdf5File::is_group(const std::string& path) const {
  if (!exists(path)) return false;
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  return object.good() && H5Iget_type(object.id()) == H5I_GROUP;
}

std::size_t Hdf5File::size(const std::string& path) const {
  if (!exists(path)) fail("no dataset " + path);
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.good()) fail(path + " is not a dataset");
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space.id());
  if (dimensions != 1) {
    fail("dataset " + path + " has " + std::to_string(dimensions) + " dimensions where 1 is needed");
  }
  hsize_t length = 0;
  H5Sget_simple_extent_dims(space.id(), &length, nullptr);
  return length;
}

void Hdf5File::read_raw(const std::string& path, Id memory_type, std::size_t start, std::size_t count,
                        void* out) const {
  const std::size_t length = size(path);
  if (start > length || count > length - start) {
    fail("dataset " + path + " has " + std::to_string(length) + " values where " + std::to_string(start + count) +
         " are needed");
  }
  if (count == 0) return;
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const hsize_t offset = start;
  const hsize_t extent = count;
  H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &offset, nullptr, &extent, nullptr);
  const Handle memory_space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  if (H5Dread(dataset.id(), memory_type, memory_space.id(), space.id(), H5P_DEFAULT, out) < 0) {
    fail("cannot read dataset " + path);
  }
}

std::vector<double> Hdf5File::read_doubles(const std::string& path, std::size_t start, std::size_t count) const {
  static_cast<void>(size(path));
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (!is_type(type.id(), H5T_FLOAT, 8)) fail("dataset " + path + " is " + type_words(type.id()) + ", needs float64");
  std::vector<double> out(count);
  read_raw(path, H5T_NATIVE_DOUBLE, start, count, out.data());
  return out;
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& path, std::size_t start, std::size_t count) const {
  static_cast<void>(size(path));
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (!is_type(type.id(), H5T_INTEGER, 8)) fail("dataset " + path + " is " + type_words(type.id()) + ", needs int64");
  std::vector<std::int64_t> out(count);
  read_raw(path, H5T_NATIVE_INT64, start, count, out.data());
  return out;
}

std::vector<double> Hdf5File::read_doubles(const std::string& path) const { return read_doubles(path, 0, size(path)); }

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& path) const {
  return read_integers(path, 0, size(path));
}

std::vector<std::string> Hdf5File::read_strings(const std::string& path) const {
  const std::size_t count = size(path);
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (H5Tis_variable_str(type.id()) <= 0) {
    fail("dataset " + path + " is " + type_words(type.id()) + ", needs variable-length text");
  }
  const Handle memory_type = text_type();
  std::vector<char*> pointers(count, nullptr);
  read_raw(path, memory_type.id(), 0, count, pointers.data());
  std::vector<std::string> out(pointers.begin(), pointers.end());
  const hsize_t length = count;
  const Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  if (count > 0) H5Dvlen_reclaim(memory_type.id(), space.id(), H5P_DEFAULT, pointers.data());
  return out;
}

std::vector<std::string> Hdf5File::read_enum(const std::string& path, std::size_t start, std::size_t count) const {
  static_cast<void>(size(path));
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (!is_type(type.id(), H5T_ENUM, 1)) fail("dataset " + path + " is " + type_words(type.id()) + ", needs an enum");
  const Handle native(H5Tget_native_type(type.id(), H5T_DIR_DEFAULT), H5Tclose);
  std::vector<signed char> codes(count);
  read_raw(path, native.id(), start, count, codes.data());
  std::vector<std::string> out;
  out.reserve(count);
  for (const signed char code : codes) {
    std::array<char, 64> name{};
    if (H5Tenum_nameof(native.id(), &code, name.data(), name.size()) < 0) {
      fail("dataset " + path + " holds " + std::to_string(code) + ", which its enum does not name");
    }
    out.emplace_back(name.data());
  }
  return out;
}

std::vector<std::string> Hdf5File::read_enum(const std::string& path) const { return read_enum(path, 0, size(path)); }

bool Hdf5File::has_attribute(const std::string& path, const std::string& name) const {
  return exists(path) && H5Aexists_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::text_attribute(const std::string& path, const std::string& name) const {
  const Handle attribute(
      has_attribute(path, name) ? H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) : -1,
      H5Aclose);
  if (!attribute.good()) fail("no attribute " + name + " of " + path);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.id()) != 1 || H5Tget_class(type.id()) != H5T_STRING) {
    fail("attribute " + name + " of " + path + " is " + type_words(type.id()) + ", needs one text");
  }
  if (H5Tis_variable_str(type.id()) > 0) {
    char* pointer = nullptr;
    if (H5Aread(attribute.id(), type.id(), &pointer) < 0) fail("cannot read attribute " + name + " of " + path);
    std::string out(pointer == nullptr ? "" : pointer);
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, &pointer);
    return out;
  }
  std::string out(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), out.data()) < 0) fail("cannot read attribute " + name + " of " + path);
  return out.substr(0, out.find('\0'));
}

double Hdf5File::number_attribute(const std::string& path, const std::string& name) const {
  const Handle attribute(
      has_attribute(path, name) ? H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) : -1,
      H5Aclose);
  if (!attribute.good()) fail("no attribute " + name + " of " + path);
  double out = 0.0;
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.id()) != 1 || H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &out) < 0) {
    fail("attribute " + name + " of " + path + " is not one number");
  }
  return out;
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace xpr
