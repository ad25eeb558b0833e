// Hdf5File's attributes.
#include "core/io/hdf5_file.hpp"

#include <hdf5.h>

#include "core/io/hdf5_handle.hpp"

namespace xpr {

using hdf5::Handle;
using hdf5::text_type;
using hdf5::type_words;

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

}  // namespace xpr
