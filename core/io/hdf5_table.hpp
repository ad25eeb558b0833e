// A table of named columns in a group of an HDF5 file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/hdf5_file.hpp"
#include "core/io/table.hpp"

namespace xpr {

class Hdf5TableReader final : public TableReader {
 public:
  Hdf5TableReader(std::filesystem::path path, TableSchema schema);
  [[nodiscard]] TableBlock read(std::size_t most) override;
  [[nodiscard]] std::string_view place_word() const override { return "row"; }
  [[nodiscard]] std::string attribute(const std::string& name) const override;

 private:
  void check_columns();
  void check_length(const std::string& dataset);
  [[nodiscard]] ColumnData read_column(std::size_t column, std::size_t count) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  TableSchema schema_;
  Hdf5File file_;
  std::vector<bool> present_;
  std::size_t rows_ = 0;
  std::size_t next_row_ = 0;
};

class Hdf5TableWriter final : public TableWriter {
 public:
  Hdf5TableWriter(const std::filesystem::path& path, TableSchema schema,
                  std::span<const std::pair<std::string, std::string>> attributes);
  void write(const TableBlock& block) override;
  void close() override { file_.close(); }

 private:
  TableSchema schema_;
  Hdf5File file_;
};

}  // namespace xpr
