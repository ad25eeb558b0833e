#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/io/hash.hpp"

namespace xpr {
namespace {

TEST(CanonicalHash, does_not_depend_on_blocks_or_on_the_order_of_datasets) {
  CanonicalHash whole;
  const std::vector<double> x{1.0, 2.0, 3.0};
  whole.dataset("x").add(std::span<const double>(x));
  whole.dataset("id").add(std::int64_t{7});
  CanonicalHash parts;
  parts.dataset("id").add(std::int64_t{7});
  for (const double value : x) parts.dataset("x").add(value);
  EXPECT_EQ(whole.hex(), parts.hex());
  EXPECT_EQ(whole.hex().size(), 32u);
}

TEST(CanonicalHash, is_the_published_xxh3_of_the_canonical_bytes) {
  // XXH3-128 of no bytes at all, as the xxHash specification prints it.
  const std::array<unsigned char, 16> of_nothing{0x99, 0xaa, 0x06, 0xd3, 0x01, 0x47, 0x98, 0xd8,
                                                 0x60, 0x01, 0xc3, 0x24, 0x46, 0x8d, 0x49, 0x7f};
  EXPECT_EQ(DatasetHash().digest(), of_nothing);
}

TEST(CanonicalHash, sees_every_bit_but_the_payload_of_a_nan) {
  const auto of = [](double value) {
    CanonicalHash hash;
    hash.dataset("x").add(value);
    return hash.hex();
  };
  const double other_nan = std::bit_cast<double>(0xfff8000000000123ULL);
  EXPECT_EQ(of(std::numeric_limits<double>::quiet_NaN()), of(other_nan));
  EXPECT_NE(of(0.0), of(-0.0));
  EXPECT_NE(of(1.0), of(std::nextafter(1.0, 2.0)));
}

TEST(CanonicalHash, tells_names_counts_and_lengths_apart) {
  const auto of = [](const std::string& name, std::vector<std::string> words) {
    CanonicalHash hash;
    for (const std::string& word : words) hash.dataset(name).add(std::string_view(word));
    return hash.hex();
  };
  EXPECT_NE(of("a", {"xy"}), of("b", {"xy"}));
  EXPECT_NE(of("a", {"x", "y"}), of("a", {"xy"}));
  EXPECT_NE(of("a", {"x", ""}), of("a", {"", "x"}));
  EXPECT_NE(of("a", {""}), of("a", {}));
}

}  // namespace
}  // namespace xpr
