#include "core/io/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/io/errors.hpp"

namespace xpr {

CsvTableReader::CsvTableReader(std::filesystem::path path, TableSchema schema)
    : path_(std::move(path)), schema_(std::move(schema)), reader_(path_) {
  read_header();
}

void CsvTableReader::fail(const std::string& what) const {
  throw InputError(path_.string() + ": line " + std::to_string(reader_.line()) + ": " + what);
}

void CsvTableReader::fail(const Column& column, std::string_view text, const std::string& what) const {
  throw InputError(path_.string() + ": line " + std::to_string(reader_.line()) + ", column " + column.name + ": '" +
                   std::string(text.substr(0, 40)) + "' " + what);
}

void CsvTableReader::read_header() {
  std::string wanted;
  for (const Column& column : schema_.columns) {
    if (column.required) wanted += (wanted.empty() ? "" : ",") + column.name;
  }
  if (!reader_.next()) throw InputError(path_.string() + ": is empty, needs a header row with " + wanted);
  for (const std::string_view name : reader_.fields()) {
    const auto found =
        std::find_if(schema_.columns.begin(), schema_.columns.end(), [&](const Column& c) { return c.name == name; });
    if (found == schema_.columns.end()) fail(unknown_column(name.substr(0, 40), schema_));
    const auto column = static_cast<std::size_t>(found - schema_.columns.begin());
    if (std::count(column_of_field_.begin(), column_of_field_.end(), column) > 0) {
      fail("column '" + std::string(name) + "' appears twice");
    }
    column_of_field_.push_back(column);
  }
  for (std::size_t k = 0; k < schema_.columns.size(); ++k) {
    if (!schema_.columns[k].required) continue;
    if (std::count(column_of_field_.begin(), column_of_field_.end(), k) == 0) {
      fail("column '" + schema_.columns[k].name + "' is missing, needs " + wanted);
    }
  }
}

void CsvTableReader::add_value(TableBlock& block, std::size_t column_index, std::string_view text) const {
  const Column& column = schema_.columns[column_index];
  ColumnData& data = block.columns[column_index];
  if (column.type == ColumnType::real) {
    double value = 0.0;
    const NumberFault fault = parse_number(text, value);
    if (fault == NumberFault::out_of_range) fail(column, text, "is outside the range of a double");
    if (fault != NumberFault::none) fail(column, text, "is not a number");
    if (column.finite && !std::isfinite(value)) fail(column, text, "needs to be a finite number");
    std::get<std::vector<double>>(data).push_back(value);
    return;
  }
  std::int64_t value = 0;
  if (column.type == ColumnType::integer) {
    const NumberFault fault = parse_number(text, value);
    if (fault == NumberFault::out_of_range) fail(column, text, "is outside the range of a 64-bit integer");
    if (fault != NumberFault::none) fail(column, text, "is not an integer");
  } else {
    const auto found = std::find(column.names.begin(), column.names.end(), text);
    if (found == column.names.end()) fail(column, text, "is not a known name");
    value = found - column.names.begin();
  }
  std::get<std::vector<std::int64_t>>(data).push_back(value);
}

TableBlock CsvTableReader::read(std::size_t most) {
  TableBlock block = empty_block(schema_);
  while (block.rows < most && reader_.next()) {
    const auto& fields = reader_.fields();
    if (fields.size() == 1 && fields[0].empty() && column_of_field_.size() > 1) fail("is blank");
    if (fields.size() != column_of_field_.size()) {
      fail("has " + std::to_string(fields.size()) + " fields where the header has " +
           std::to_string(column_of_field_.size()));
    }
    for (std::size_t k = 0; k < fields.size(); ++k) add_value(block, column_of_field_[k], fields[k]);
    block.places.push_back(reader_.line());
    ++block.rows;
  }
  return block;
}

CsvTableWriter::CsvTableWriter(const std::filesystem::path& path, TableSchema schema)
    : schema_(std::move(schema)), writer_(path) {
  for (const Column& column : schema_.columns) writer_.field(column.name);
  writer_.end_record();
}

void CsvTableWriter::write(const TableBlock& block) {
  for (std::size_t row = 0; row < block.rows; ++row) {
    for (std::size_t k = 0; k < schema_.columns.size(); ++k) {
      const Column& column = schema_.columns[k];
      if (column.type == ColumnType::real) {
        writer_.field(block.reals(k)[row]);
      } else if (column.type == ColumnType::integer) {
        writer_.field(block.integers(k)[row]);
      } else {
        writer_.field(column.names[static_cast<std::size_t>(block.integers(k)[row])]);
      }
    }
    writer_.end_record();
  }
}

}  // namespace xpr
