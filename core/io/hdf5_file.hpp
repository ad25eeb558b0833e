// An HDF5 file behind one class: named 1-D datasets with units and long names, written so that equal content gives
// equal bytes (no object times), read back with errors that say what is wrong in one line.
//
// Paths inside a file are absolute: "/cases/flat/value". Doubles are IEEE 64-bit little-endian, integers signed 64-bit
// little-endian, strings variable-length UTF-8, enums signed 8-bit with names: what h5py opens without surprises.
// The library is Debian's serial one, which is not thread-safe: use files from one thread at a time.
// Errors: InputError for what is wrong with a file or its path, FaultError for a full or failing disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace xpr {

/// What a dataset measures; both become attributes.
struct DatasetText {
  std::string units = "1";  ///< UDUNITS spelling, "1" for pure numbers
  std::string long_name;
};

class Hdf5File {
 public:
  /// A new, empty file; one that stands there is replaced.
  [[nodiscard]] static Hdf5File create(const std::filesystem::path& path);
  /// Opens for reading only.
  [[nodiscard]] static Hdf5File open(const std::filesystem::path& path);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// Closes without a word; call close() to learn whether everything reached the disk.
  ~Hdf5File();

  /// Flushes and closes. Throws where that fails.
  void close();

  /// A group with all groups above it. No error where it exists.
  void make_group(const std::string& path);

  /// A dataset of one dimension with all groups above it.
  void write(const std::string& path, std::span<const double> values, const DatasetText& text);
  void write(const std::string& path, std::span<const std::int64_t> values, const DatasetText& text);
  void write(const std::string& path, std::span<const std::string> values, const DatasetText& text);
  /// Codes index `names`; at most 127 names.
  void write_enum(const std::string& path, std::span<const std::int64_t> codes, std::span<const std::string_view> names,
                  const DatasetText& text);

  /// Empty datasets that append() makes longer, `chunk` values at a time on the disk.
  void create_doubles(const std::string& path, const DatasetText& text, std::size_t chunk);
  void create_integers(const std::string& path, const DatasetText& text, std::size_t chunk);
  void create_enum(const std::string& path, std::span<const std::string_view> names, const DatasetText& text,
                   std::size_t chunk);
  void append(const std::string& path, std::span<const double> values);
  /// To integers and enums.
  void append(const std::string& path, std::span<const std::int64_t> values);

  /// Declares a dataset to be a dimension scale of that name, and attaches it to dimension 0 of another dataset.
  void make_scale(const std::string& scale, const std::string& name);
  void attach_scale(const std::string& dataset, const std::string& scale);

  /// Attributes of a group ("/" for the file) or dataset.
  void set_attribute(const std::string& path, const std::string& name, std::string_view value);
  void set_attribute(const std::string& path, const std::string& name, double value);
  void set_attribute(const std::string& path, const std::string& name, std::int64_t value);

  [[nodiscard]] bool exists(const std::string& path) const;
  /// Names of what a group holds, sorted.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;
  [[nodiscard]] bool is_group(const std::string& path) const;

  /// Length of a dataset. Throws InputError where it is missing or not of one dimension.
  [[nodiscard]] std::size_t size(const std::string& path) const;
  /// `count` values from `start`. Throw InputError where the dataset is of another type.
  [[nodiscard]] std::vector<double> read_doubles(const std::string& path, std::size_t start, std::size_t count) const;
  [[nodiscard]] std::vector<std::int64_t> read_integers(const std::string& path, std::size_t start,
                                                        std::size_t count) const;
  /// Whole datasets.
  [[nodiscard]] std::vector<double> read_doubles(const std::string& path) const;
  [[nodiscard]] std::vector<std::int64_t> read_integers(const std::string& path) const;
  [[nodiscard]] std::vector<std::string> read_strings(const std::string& path) const;
  /// The names that the values stand for.
  [[nodiscard]] std::vector<std::string> read_enum(const std::string& path, std::size_t start, std::size_t count) const;
  [[nodiscard]] std::vector<std::string> read_enum(const std::string& path) const;

  [[nodiscard]] bool has_attribute(const std::string& path, const std::string& name) const;
  [[nodiscard]] std::string text_attribute(const std::string& path, const std::string& name) const;
  [[nodiscard]] double number_attribute(const std::string& path, const std::string& name) const;

 private:
  using Id = std::int64_t;  // HDF5's hid_t, without its header
  Hdf5File(std::filesystem::path path, Id file, bool writing);

  [[noreturn]] void fail(const std::string& what) const;
  void write_text(Id dataset, const std::string& path, const DatasetText& text);
  void write_dataset(const std::string& path, Id file_type, Id memory_type, std::size_t count, const void* data,
                     const DatasetText& text);
  void create_extendable(const std::string& path, Id file_type, const DatasetText& text, std::size_t chunk);
  void append_raw(const std::string& path, Id memory_type, std::size_t count, const void* data);
  void read_raw(const std::string& path, Id memory_type, std::size_t start, std::size_t count, void* out) const;
  void set_attribute_raw(const std::string& path, const std::string& name, Id file_type, Id memory_type,
                         const void* data);

  std::filesystem::path path_;
  Id file_ = -1;
  bool writing_ = false;
};

/// Version of the HDF5 library in use, such as "1.10.8".
[[nodiscard]] std::string hdf5_version();

}  // namespace xpr
