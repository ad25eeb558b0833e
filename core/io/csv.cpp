#include "core/io/csv.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/io/errors.hpp"

namespace xpr {
namespace {

constexpr std::size_t buffer_size = 1 << 16;
constexpr std::size_t longest_record = 1 << 20;
constexpr int end_of_file = -1;

template <class T>
NumberFault parse(std::string_view text, T& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return NumberFault::not_a_number;
  if (error == std::errc::result_out_of_range) return NumberFault::out_of_range;
  return error == std::errc() ? NumberFault::none : NumberFault::not_a_number;
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

NumberFault parse_number(std::string_view text, double& value) { return parse(text, value); }
NumberFault parse_number(std::string_view text, std::int64_t& value) { return parse(text, value); }

CsvReader::CsvReader(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)), buffer_(buffer_size) {
  if (descriptor_ < 0) throw_system_error(path_, "cannot be read", errno);
  try {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (fill() && std::string_view(buffer_.data(), filled_).starts_with(byte_order_mark)) used_ = 3;
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

CsvReader::~CsvReader() { ::close(descriptor_); }

void CsvReader::fail(const std::string& what) const {
  throw InputError(path_.string() + ": line " + std::to_string(record_line_) + ": " + what);
}

bool CsvReader::fill() {
  ssize_t n = 0;
  do {
    n = ::read(descriptor_, buffer_.data(), buffer_.size());
  } while (n < 0 && errno == EINTR);
  if (n < 0) throw_system_error(path_, "cannot be read", errno);
  used_ = 0;
  filled_ = static_cast<std::size_t>(n);
  return n > 0;
}

int CsvReader::peek() {
  if (used_ == filled_ && !fill()) return end_of_file;
  return static_cast<unsigned char>(buffer_[used_]);
}

int CsvReader::get() {
  const int c = peek();
  if (c == end_of_file) return c;
  ++used_;
  if (c == '\n') ++line_;
  if (c == '\0') fail("holds a zero byte: this is no text");
  if (text_.size() > longest_record) fail("is longer than 1 MiB: a quote may be unclosed");
  return c;
}

void CsvReader::read_quoted() {
  for (;;) {
    const int c = get();
    if (c == end_of_file) fail("a quoted field is not closed");
    if (c != '"') {
      text_ += static_cast<char>(c);
    } else if (peek() == '"') {
      text_ += static_cast<char>(get());
    } else {
      break;
    }
  }
  const int after = peek();
  if (after != ',' && after != '\n' && after != '\r' && after != end_of_file) {
    fail("text follows the closing quote of field " + std::to_string(ends_.size() + 1));
  }
}

void CsvReader::read_plain() {
  for (;;) {
    const int c = peek();
    if (c == ',' || c == '\n' || c == '\r' || c == end_of_file) return;
    if (c == '"') fail("a quote stands inside the unquoted field " + std::to_string(ends_.size() + 1));
    text_ += static_cast<char>(get());
  }
}

void CsvReader::end_field() { ends_.push_back(text_.size()); }

bool CsvReader::next() {
  text_.clear();
  ends_.clear();
  fields_.clear();
  record_line_ = line_;
  if (peek() == end_of_file) return false;
  for (bool more = true; more;) {
    if (peek() == '"') {
      static_cast<void>(get());
      read_quoted();
    } else {
      read_plain();
    }
    end_field();
    const int c = get();
    more = c == ',';
    if (c == '\r' && get() != '\n') fail("a carriage return is not followed by a line feed");
  }
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    fields_.push_back(std::string_view(text_).substr(begin, end - begin));
    begin = end;
  }
  return true;
}

CsvWriter::CsvWriter(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw_system_error(path_, "cannot be written", errno);
}

CsvWriter::~CsvWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void CsvWriter::separate() {
  if (!std::exchange(first_in_record_, false)) buffer_ += ',';
}

void CsvWriter::field(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    buffer_ += text;
    return;
  }
  buffer_ += '"';
  for (const char c : text) buffer_.append(c == '"' ? 2 : 1, c);
  buffer_ += '"';
}

void CsvWriter::field(double value) {
  separate();
  buffer_ += number_text(value);
}

void CsvWriter::field(std::int64_t value) {
  separate();
  buffer_ += std::to_string(value);
}

void CsvWriter::end_record() {
  buffer_ += '\n';
  first_in_record_ = true;
  if (buffer_.size() >= buffer_size) flush();
}

void CsvWriter::flush() {
  std::string_view left = buffer_;
  while (!left.empty()) {
    const ssize_t n = ::write(descriptor_, left.data(), left.size());
    if (n >= 0) {
      left.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno != EINTR) {
      throw_system_error(path_, "cannot be written", errno);
    }
  }
  buffer_.clear();
}

void CsvWriter::close() {
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0) throw_system_error(path_, "cannot be written", errno);
}

}  // namespace xpr
