#include "core/io/hdf5_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/csv.hpp"
#include "core/io/errors.hpp"

namespace xpr {
namespace {

// Values of one column that lie together on the disk: as many as trace writes at a time.
constexpr std::size_t chunk_rows = 4096;

}  // namespace

Hdf5TableReader::Hdf5TableReader(std::filesystem::path path, TableSchema schema)
    : path_(std::move(path)),
      schema_(std::move(schema)),
      file_(Hdf5File::open(path_)),
      present_(schema_.columns.size(), false) {
  check_columns();
}

void Hdf5TableReader::fail(const std::string& what) const { throw InputError(path_.string() + ": " + what); }

void Hdf5TableReader::check_columns() {
  if (!file_.is_group(schema_.group)) fail("no group " + schema_.group);
  for (const std::string& name : file_.members(schema_.group)) {
    const auto known = [&](const Column& column) { return column.name == name; };
    if (std::none_of(schema_.columns.begin(), schema_.columns.end(), known)) {
      fail("group " + schema_.group + ": " + unknown_column(name, schema_));
    }
  }
  for (std::size_t k = 0; k < schema_.columns.size(); ++k) {
    const std::string dataset = schema_.group + "/" + schema_.columns[k].name;
    present_[k] = file_.exists(dataset);
    if (present_[k]) {
      check_length(dataset);
      static_cast<void>(read_column(k, 0));
    } else if (schema_.columns[k].required) {
      fail("dataset " + dataset + " is missing");
    }
  }
}

void Hdf5TableReader::check_length(const std::string& dataset) {
  const std::size_t length = file_.size(dataset);
  const std::string first = schema_.group + "/" + schema_.columns[0].name;
  if (dataset == first) rows_ = length;
  if (length != rows_) {
    fail("dataset " + dataset + " has " + std::to_string(length) + " values where " + first + " has " +
         std::to_string(rows_));
  }
}

ColumnData Hdf5TableReader::read_column(std::size_t k, std::size_t count) const {
  const Column& column = schema_.columns[k];
  const std::string dataset = schema_.group + "/" + column.name;
  if (column.type == ColumnType::integer) return file_.read_integers(dataset, next_row_, count);
  if (column.type == ColumnType::name) {
    std::vector<std::int64_t> codes;
    const std::vector<std::string> words = file_.read_enum(dataset, next_row_, count);
    for (std::size_t row = 0; row < words.size(); ++row) {
      const auto found = std::find(column.names.begin(), column.names.end(), words[row]);
      if (found == column.names.end()) {
        fail("dataset " + dataset + ", row " + std::to_string(next_row_ + row) + ": '" + words[row] +
             "' is not a known name");
      }
      codes.push_back(found - column.names.begin());
    }
    return codes;
  }
  std::vector<double> values = file_.read_doubles(dataset, next_row_, count);
  for (std::size_t row = 0; column.finite && row < values.size(); ++row) {
    if (std::isfinite(values[row])) continue;
    fail("dataset " + dataset + ", row " + std::to_string(next_row_ + row) + ": '" + number_text(values[row]) +
         "' needs to be a finite number");
  }
  return values;
}

TableBlock Hdf5TableReader::read(std::size_t most) {
  TableBlock block = empty_block(schema_);
  block.rows = std::min(most, rows_ - next_row_);
  for (std::size_t k = 0; k < schema_.columns.size(); ++k) {
    if (present_[k]) block.columns[k] = read_column(k, block.rows);
  }
  for (std::size_t row = 0; row < block.rows; ++row) {
    block.places.push_back(static_cast<std::int64_t>(next_row_ + row));
  }
  next_row_ += block.rows;
  return block;
}

std::string Hdf5TableReader::attribute(const std::string& name) const {
  return file_.has_attribute(schema_.group, name) ? file_.text_attribute(schema_.group, name) : std::string();
}

Hdf5TableWriter::Hdf5TableWriter(const std::filesystem::path& path, TableSchema schema,
                                 std::span<const std::pair<std::string, std::string>> attributes)
    : schema_(std::move(schema)), file_(Hdf5File::create(path)) {
  for (const Column& column : schema_.columns) {
    const std::string dataset = schema_.group + "/" + column.name;
    if (column.type == ColumnType::real) file_.create_doubles(dataset, column.text, chunk_rows);
    if (column.type == ColumnType::integer) file_.create_integers(dataset, column.text, chunk_rows);
    if (column.type == ColumnType::name) file_.create_enum(dataset, column.names, column.text, chunk_rows);
  }
  for (const auto& [name, value] : attributes) file_.set_attribute(schema_.group, name, std::string_view(value));
}

void Hdf5TableWriter::write(const TableBlock& block) {
  for (std::size_t k = 0; k < schema_.columns.size(); ++k) {
    const std::string dataset = schema_.group + "/" + schema_.columns[k].name;
    if (schema_.columns[k].type == ColumnType::real) {
      file_.append(dataset, block.reals(k));
    } else {
      file_.append(dataset, block.integers(k));
    }
  }
}

}  // namespace xpr
