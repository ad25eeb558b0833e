// Tables of named columns as streams of row blocks, CSV and HDF5 alike: what the ray table stands on.
//
// CSV: one header row, columns in any order. HDF5: a group with one dataset of one dimension for each column under its
// name. Either way a table holds the columns of its schema and no others, and what is wrong with it is said in one
// line: file, line or row, column, what is there, what should be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/io/hash.hpp"
#include "core/io/hdf5_file.hpp"

namespace xpr {

/// float64; int64; or one of a list of names (an enum in HDF5).
enum class ColumnType { real, integer, name };

struct Column {
  std::string name;
  ColumnType type = ColumnType::real;
  bool required = true;
  bool finite = false;  ///< nan and inf are errors
  DatasetText text;
  std::span<const std::string_view> names{};  ///< of ColumnType::name; values are indices into it
};

struct TableSchema {
  std::string group;  ///< in HDF5: "/rays"
  std::vector<Column> columns;
};

/// Values of one column; empty where the table lacks an optional column.
using ColumnData = std::variant<std::vector<double>, std::vector<std::int64_t>>;

/// Some rows of a table, a vector for each column of the schema.
struct TableBlock {
  std::size_t rows = 0;
  std::vector<ColumnData> columns;
  std::vector<std::int64_t> places;  ///< line (CSV) or row (HDF5, from 0) of each row as it stands in the file

  [[nodiscard]] const std::vector<double>& reals(std::size_t column) const {
    return std::get<std::vector<double>>(columns[column]);
  }
  [[nodiscard]] const std::vector<std::int64_t>& integers(std::size_t column) const {
    return std::get<std::vector<std::int64_t>>(columns[column]);
  }
};

enum class TableFormat { csv, hdf5 };

/// By the file's ending: .csv, .h5 or .hdf5; a path that is a pipe or a device is CSV. Throws InputError for others.
[[nodiscard]] TableFormat table_format(const std::filesystem::path& path);

class TableReader {
 public:
  virtual ~TableReader() = default;
  /// Up to `most` further rows; none at the end. Throws InputError for what is malformed.
  [[nodiscard]] virtual TableBlock read(std::size_t most) = 0;
  /// How messages name a place: "line" or "row".
  [[nodiscard]] virtual std::string_view place_word() const = 0;
  /// A text attribute of the table's group, empty where there is none (always, in CSV).
  [[nodiscard]] virtual std::string attribute(const std::string& name) const = 0;
};

/// Opens a table and checks its columns. Throws InputError.
[[nodiscard]] std::unique_ptr<TableReader> open_table(const std::filesystem::path& path, const TableSchema& schema);

class TableWriter {
 public:
  virtual ~TableWriter() = default;
  virtual void write(const TableBlock& block) = 0;
  /// Throws FaultError where not everything reached the disk.
  virtual void close() = 0;
};

/// Attributes go to the table's group in HDF5; CSV has none.
[[nodiscard]] std::unique_ptr<TableWriter> create_table(
    const std::filesystem::path& path, TableFormat format, const TableSchema& schema,
    std::span<const std::pair<std::string, std::string>> attributes = {});

/// Adds a block's columns to a hash; names count as text, so that the file's format does not matter.
void add_to_hash(CanonicalHash& hash, const TableSchema& schema, const TableBlock& block);

/// A block with an empty vector of the right type for each column.
[[nodiscard]] TableBlock empty_block(const TableSchema& schema);

/// The message for a column that no schema knows, with the nearest one it does know.
[[nodiscard]] std::string unknown_column(std::string_view name, const TableSchema& schema);

}  // namespace xpr
