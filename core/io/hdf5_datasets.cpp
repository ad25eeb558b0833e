// Hdf5File's datasets: written whole or piece by piece, read back with their types checked.
#include "core/io/hdf5_file.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <array>

#include "core/io/hdf5_handle.hpp"

namespace xpr {

using hdf5::creation_list;
using hdf5::Handle;
using hdf5::links_with_parents;
using hdf5::text_type;
using hdf5::type_words;

namespace {

Handle enum_type(hid_t base, std::span<const std::string_view> names) {
  Handle type(H5Tenum_create(base), H5Tclose);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto code = static_cast<signed char>(k);
    H5Tenum_insert(type.id(), std::string(names[k]).c_str(), &code);
  }
  return type;
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

}  // namespace

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

}  // namespace xpr
