// CSV as RFC 4180 has it, read and written as a stream: one record in memory at a time, no locale.
//
// Fields may be quoted, records end in CRLF or LF, a UTF-8 byte order mark is skipped; records are written with LF.
// Spaces belong to a field. Numbers are written in the fewest digits that read back to the same bits; `nan`, `inf` and
// `-inf` are spelled so. Errors name the file and the line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace xpr {

/// Reads one record after the other.
class CsvReader {
 public:
  /// Throws InputError where the file cannot be opened.
  explicit CsvReader(std::filesystem::path path);
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;
  ~CsvReader();

  /// Goes to the next record; false at the end. Throws InputError for a stray or unclosed quote, a byte that is no
  /// text, or a record longer than 1 MiB; FaultError where the disk fails.
  [[nodiscard]] bool next();
  /// The record's fields, good until the next call of next().
  [[nodiscard]] const std::vector<std::string_view>& fields() const { return fields_; }
  /// The line on which the record begins, the first being 1.
  [[nodiscard]] std::int64_t line() const { return record_line_; }

 private:
  [[nodiscard]] int get();
  [[nodiscard]] int peek();
  [[nodiscard]] bool fill();
  void read_quoted();
  void read_plain();
  void end_field();
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  int descriptor_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::size_t filled_ = 0;
  std::int64_t line_ = 1;
  std::int64_t record_line_ = 0;
  std::string text_;               // the record's fields, one after the other
  std::vector<std::size_t> ends_;  // where each of them ends
  std::vector<std::string_view> fields_;
};

/// Writes one record after the other.
class CsvWriter {
 public:
  /// Throws InputError where the file cannot be created; one that stands there is overwritten.
  explicit CsvWriter(std::filesystem::path path);
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  /// Closes without a word; call close() to learn whether everything was written.
  ~CsvWriter();

  void field(std::string_view text);  ///< quoted where it needs to be
  void field(double value);
  void field(std::int64_t value);
  void end_record();
  /// Throws FaultError where the disk is full, here or at an earlier call.
  void close();

 private:
  void separate();
  void flush();

  std::filesystem::path path_;
  int descriptor_;
  std::string buffer_;
  bool first_in_record_ = true;
};

/// The shortest decimal text that reads back to the same bits; "nan", "inf", "-inf".
[[nodiscard]] std::string number_text(double value);

enum class NumberFault { none, not_a_number, out_of_range };

/// The whole of `text` as a number, whatever the locale; "nan", "inf" and "-inf" are numbers here.
[[nodiscard]] NumberFault parse_number(std::string_view text, double& value);
[[nodiscard]] NumberFault parse_number(std::string_view text, std::int64_t& value);

}  // namespace xpr
