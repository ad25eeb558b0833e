// A table of reference_data/: numbers as text, to the digits that are meant, under a header that says where they come
// from and holds a hash of it all. Files are read as they are written: a change by hand is found out.
//
//   # xprimeray reference table 1
//   # name: schwarzschild_deflection
//   # quantity: ...            what the numbers are
//   # units: b M; alpha rad    of every column that is a number
//   # origin: computed         or: printed, digitised
//   # method: ...
//   # digits: 30               significant, of the columns that are not inputs; inputs are doubles
//   # rank: closed form        as reports name it
//   # cites: Darwin1959        keys of references.bib, separated by spaces
//   # maker: xprimeray reference --regenerate schwarzschild_deflection
//   # hash: xxh3-128 ...       over every other byte of the file
//   M,b,alpha                  then RFC 4180
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace xpr {

struct ReferenceTable {
  std::string name;  ///< the file is <name>.csv
  std::string quantity;
  std::string units;
  std::string origin;
  std::string method;
  int digits = 0;
  std::string rank;
  std::string cites;
  std::string maker;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< one text for each column
};

/// The whole file, hash included. Throws std::invalid_argument for a text with a comma, quote or line break in it, a
/// header that is empty, and rows of another length than `columns`.
[[nodiscard]] std::string reference_text(const ReferenceTable& table);

/// Reads what reference_text writes; `place` is how errors name it. Throws InputError: what is no reference table, a
/// header line that is missing, a row of another length, and a hash that the content does not have.
[[nodiscard]] ReferenceTable parse_reference(std::string_view text, const std::string& place);

/// The same from a file, whose name has to be that of the table.
[[nodiscard]] ReferenceTable read_reference(const std::filesystem::path& path);

/// The *.csv files of a folder in alphabetical order. Throws InputError where there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> reference_files(const std::filesystem::path& folder);

/// The index of a column. Throws std::out_of_range with the name.
[[nodiscard]] std::size_t column_index(const ReferenceTable& table, std::string_view name);

}  // namespace xpr
