// A table of named columns in a CSV file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/csv.hpp"
#include "core/io/table.hpp"

namespace xpr {

class CsvTableReader final : public TableReader {
 public:
  CsvTableReader(std::filesystem::path path, TableSchema schema);
  [[nodiscard]] TableBlock read(std::size_t most) override;
  [[nodiscard]] std::string_view place_word() const override { return "line"; }
  [[nodiscard]] std::string attribute(const std::string&) const override { return {}; }

 private:
  void read_header();
  void add_value(TableBlock& block, std::size_t column, std::string_view text) const;
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail(const Column& column, std::string_view text, const std::string& what) const;

  std::filesystem::path path_;
  TableSchema schema_;
  CsvReader reader_;
  std::vector<std::size_t> column_of_field_;
};

class CsvTableWriter final : public TableWriter {
 public:
  CsvTableWriter(const std::filesystem::path& path, TableSchema schema);
  void write(const TableBlock& block) override;
  void close() override { writer_.close(); }

 private:
  TableSchema schema_;
  CsvWriter writer_;
};

}  // namespace xpr
