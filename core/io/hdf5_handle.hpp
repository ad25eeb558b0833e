// What the parts of Hdf5File share: HDF5's identifiers as objects, and the property lists and types that its files use.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace xpr::hdf5 {

/// One HDF5 identifier, closed when it goes out of scope.
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

/// A list for creating files, groups or datasets that keep no times.
[[nodiscard]] Handle creation_list(hid_t list_class);
/// For links that make the groups above them.
[[nodiscard]] Handle links_with_parents();
/// Variable-length UTF-8.
[[nodiscard]] Handle text_type();
/// A type as error messages name it: "float64", "an enum".
[[nodiscard]] std::string type_words(hid_t type);

}  // namespace xpr::hdf5
