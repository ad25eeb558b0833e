#include "core/io/table.hpp"

#include "core/io/csv_table.hpp"
#include "core/io/errors.hpp"
#include "core/io/hdf5_table.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {

TableFormat table_format(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  const std::string ending = path.extension().string();
  if (ending == ".csv") return TableFormat::csv;
  if (ending == ".h5" || ending == ".hdf5") return TableFormat::hdf5;
  if (std::filesystem::is_other(status)) return TableFormat::csv;
  throw InputError(path.string() + ": a table's name ends in .csv or .h5");
}

std::unique_ptr<TableReader> open_table(const std::filesystem::path& path, const TableSchema& schema) {
  if (table_format(path) == TableFormat::csv) return std::make_unique<CsvTableReader>(path, schema);
  return std::make_unique<Hdf5TableReader>(path, schema);
}

std::unique_ptr<TableWriter> create_table(const std::filesystem::path& path, TableFormat format,
                                          const TableSchema& schema,
                                          std::span<const std::pair<std::string, std::string>> attributes) {
  if (format == TableFormat::csv) return std::make_unique<CsvTableWriter>(path, schema);
  return std::make_unique<Hdf5TableWriter>(path, schema, attributes);
}

void add_to_hash(CanonicalHash& hash, const TableSchema& schema, const TableBlock& block) {
  for (std::size_t k = 0; k < schema.columns.size(); ++k) {
    const Column& column = schema.columns[k];
    DatasetHash& dataset = hash.dataset(column.name);
    if (column.type == ColumnType::real) {
      dataset.add(std::span<const double>(block.reals(k)));
    } else if (column.type == ColumnType::integer) {
      dataset.add(std::span<const std::int64_t>(block.integers(k)));
    } else {
      for (const std::int64_t code : block.integers(k)) dataset.add(column.names[static_cast<std::size_t>(code)]);
    }
  }
}

TableBlock empty_block(const TableSchema& schema) {
  TableBlock block;
  for (const Column& column : schema.columns) {
    if (column.type == ColumnType::real) {
      block.columns.emplace_back(std::vector<double>{});
    } else {
      block.columns.emplace_back(std::vector<std::int64_t>{});
    }
  }
  return block;
}

std::string unknown_column(std::string_view name, const TableSchema& schema) {
  std::vector<std::string_view> known;
  std::string list;
  for (const Column& column : schema.columns) {
    known.push_back(column.name);
    list += (list.empty() ? "" : ", ") + column.name;
  }
  const std::string near = nearest_name(name, known);
  return "unknown column '" + std::string(name) + "'; " +
         (near.empty() ? "columns are " + list : "did you mean '" + near + "'?");
}

}  // namespace xpr
