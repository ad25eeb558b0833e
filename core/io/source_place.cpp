#include "core/io/source_place.hpp"

#include <fmt/format.h>

#include "core/io/errors.hpp"

namespace xpr {
namespace {

std::string text_of(const SourcePlace& place, int line) {
  return line > 0 ? fmt::format("{}: line {}: {}", place.source, line, place.section)
                  : fmt::format("{}: {}", place.source, place.section);
}

}  // namespace

void SourcePlace::fail(std::string_view key, std::string_view what) const {
  const auto found = key_line.find(key);
  throw InputError(fmt::format("{} {} {}", text_of(*this, found == key_line.end() ? line : found->second), key, what));
}

void SourcePlace::fail(std::string_view what) const {
  throw InputError(fmt::format("{}: {}", text_of(*this, line), what));
}

}  // namespace xpr
