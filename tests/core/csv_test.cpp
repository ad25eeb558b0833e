#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::slurp;
using testing::spill;
using testing::TemporaryDirectory;
using Records = std::vector<std::vector<std::string>>;

Records records_of(const std::filesystem::path& path) {
  CsvReader reader(path);
  Records records;
  while (reader.next()) records.emplace_back(reader.fields().begin(), reader.fields().end());
  return records;
}

Records parsed(const std::string& text) {
  const TemporaryDirectory directory;
  spill(directory / "a.csv", text);
  return records_of(directory / "a.csv");
}

std::string refused(const std::string& text) {
  return message_of<InputError>([&] { parsed(text); });
}

TEST(Csv, reads_what_rfc_4180_allows) {
  EXPECT_EQ(parsed("a,b\n1,2\n"), (Records{{"a", "b"}, {"1", "2"}}));
  EXPECT_EQ(parsed("a,b\r\n1,2\r\n"), (Records{{"a", "b"}, {"1", "2"}}));
  EXPECT_EQ(parsed("a,b\n1,2"), (Records{{"a", "b"}, {"1", "2"}}));
  EXPECT_EQ(parsed("\xef\xbb\xbf"
                   "a\n"),
            (Records{{"a"}}));
  EXPECT_EQ(parsed("\"a,b\",\"say \"\"x\"\"\",\"two\nlines\"\n"), (Records{{"a,b", "say \"x\"", "two\nlines"}}));
  EXPECT_EQ(parsed(",\n"), (Records{{"", ""}}));
  EXPECT_EQ(parsed("\"\",x\n"), (Records{{"", "x"}}));
  EXPECT_EQ(parsed(" a , b \n"), (Records{{" a ", " b "}}));
  EXPECT_TRUE(parsed("").empty());
}

TEST(Csv, counts_lines_through_quoted_line_feeds) {
  const TemporaryDirectory directory;
  spill(directory / "a.csv", "h\n\"x\ny\"\nlast\n");
  CsvReader reader(directory / "a.csv");
  std::vector<std::int64_t> lines;
  while (reader.next()) lines.push_back(reader.line());
  EXPECT_EQ(lines, (std::vector<std::int64_t>{1, 2, 4}));
}

TEST(Csv, says_where_it_is_malformed) {
  EXPECT_NE(refused("a\n\"x\n").find("line 2: a quoted field is not closed"), std::string::npos);
  EXPECT_NE(refused("a,b\nx,\"y\"z\n").find("line 2: text follows the closing quote of field 2"), std::string::npos);
  EXPECT_NE(refused("a,b\nx,y\"z\n").find("line 2: a quote stands inside the unquoted field 2"), std::string::npos);
  EXPECT_NE(refused("a\rb\n").find("line 1: a carriage return is not followed by a line feed"), std::string::npos);
  EXPECT_NE(refused(std::string("a\n\0b\n", 5)).find("line 2: holds a zero byte"), std::string::npos);
  EXPECT_NE(refused("\"" + std::string(2 << 20, 'x')).find("line 1: is longer than 1 MiB"), std::string::npos);
  EXPECT_NE(message_of<InputError>([] { CsvReader("/absent/a.csv"); }).find("No such file"), std::string::npos);
}

TEST(Csv, numbers_read_back_to_the_same_bits) {
  std::vector<double> values{0.0,
                             -0.0,
                             0.1,
                             1.0 / 3.0,
                             5e-324,
                             std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
  std::mt19937_64 random(20240117);
  for (int k = 0; k < 10'000; ++k) values.push_back(std::bit_cast<double>(random()));
  for (const double value : values) {
    double back = 0.0;
    ASSERT_EQ(parse_number(number_text(value), back), NumberFault::none) << number_text(value);
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(back));
    } else {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << number_text(value);
    }
  }
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Csv, takes_for_a_number_only_the_whole_field) {
  double real = 0.0;
  std::int64_t integer = 0;
  for (const std::string bad : {"", " 1", "1 ", "1,5", "0x10", "1.5e", "abc", "+-1", "1d3"}) {
    EXPECT_EQ(parse_number(bad, real), NumberFault::not_a_number) << bad;
  }
  EXPECT_EQ(parse_number("1e999", real), NumberFault::out_of_range);
  EXPECT_EQ(parse_number("+1.5", real), NumberFault::none);
  EXPECT_EQ(real, 1.5);
  for (const std::string bad : {"1.0", "1e3", "", "nan"}) {
    EXPECT_EQ(parse_number(bad, integer), NumberFault::not_a_number) << bad;
  }
  EXPECT_EQ(parse_number("9223372036854775808", integer), NumberFault::out_of_range);
  EXPECT_EQ(parse_number("-9223372036854775808", integer), NumberFault::none);
}

TEST(Csv, quotes_what_it_writes_where_it_must) {
  const TemporaryDirectory directory;
  CsvWriter writer(directory / "a.csv");
  for (const std::string text : {"plain", "a,b", "say \"x\"", "two\nlines"}) writer.field(text);
  writer.end_record();
  writer.field(0.5);
  writer.field(std::int64_t{-3});
  writer.end_record();
  writer.close();
  EXPECT_EQ(slurp(directory / "a.csv"), "plain,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\"\n0.5,-3\n");
  EXPECT_EQ(records_of(directory / "a.csv")[0], (std::vector<std::string>{"plain", "a,b", "say \"x\"", "two\nlines"}));
}

TEST(Csv, on_a_full_device_is_a_fault) {
  CsvWriter writer("/dev/full");
  writer.field(1.0);
  writer.end_record();
  EXPECT_NE(message_of<FaultError>([&] { writer.close(); }).find("No space left on device"), std::string::npos);
}

}  // namespace
}  // namespace xpr
