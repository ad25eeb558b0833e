// Packs do in every lane what double does, and masks choose lane by lane, at every width. These come first: on some
// compilers and instruction sets masked assignment of other SIMD libraries silently does nothing.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "metrics/scalar/elementary.hpp"

namespace xpr {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

std::uint64_t pattern(double x) { return std::bit_cast<std::uint64_t>(x); }

template <class Width>
class PackOfWidth : public ::testing::Test {
 public:
  static constexpr int width = Width::value;
  using PackType = Pack<width>;
  using MaskType = Mask<width>;

  /// A pack whose lane i is f(i).
  template <class F>
  static PackType fill(const F& f) {
    PackType p;
    for (int i = 0; i < width; ++i) set_lane(p, i, f(i));
    return p;
  }
};

using Widths = ::testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                std::integral_constant<int, 4>, std::integral_constant<int, 8>>;
TYPED_TEST_SUITE(PackOfWidth, Widths, );

TYPED_TEST(PackOfWidth, select_takes_each_lane_from_the_side_that_its_mask_names) {
  using Fixture = PackOfWidth<TypeParam>;
  constexpr int W = Fixture::width;
  const auto a = Fixture::fill([](int i) { return 1.0 + i; });
  const auto b = Fixture::fill([](int i) { return -1.0 - i; });
  for (unsigned bits = 0; bits < (1U << W); ++bits) {
    typename Fixture::MaskType mask;
    for (int i = 0; i < W; ++i) set_lane(mask, i, ((bits >> i) & 1U) != 0);
    const auto chosen = select(mask, a, b);
    const auto with_number = select(mask, a, 0.5);
    for (int i = 0; i < W; ++i) {
      const bool here = ((bits >> i) & 1U) != 0;
      EXPECT_EQ(lane(mask, i), here);
      EXPECT_EQ(lane(chosen, i), here ? 1.0 + i : -1.0 - i);
      EXPECT_EQ(lane(with_number, i), here ? 1.0 + i : 0.5);
    }
    EXPECT_EQ(any(mask), bits != 0);
    EXPECT_EQ(all(mask), bits == (1U << W) - 1U);
    EXPECT_EQ(any(!mask), bits != (1U << W) - 1U);
  }
}

TYPED_TEST(PackOfWidth, comparisons_hold_lane_by_lane_and_fail_for_nan) {
  using Fixture = PackOfWidth<TypeParam>;
  constexpr std::array<double, 7> values{-inf, -1.0, -0.0, 0.0, 2.5, inf, quiet_nan};
  for (std::size_t shift = 0; shift < values.size(); ++shift) {
    const auto left = [&](int i) { return values[static_cast<std::size_t>(i) % values.size()]; };
    const auto right = [&](int i) { return values[(static_cast<std::size_t>(i) + shift) % values.size()]; };
    const auto a = Fixture::fill(left);
    const auto b = Fixture::fill(right);
    for (int i = 0; i < Fixture::width; ++i) {
      EXPECT_EQ(lane(a < b, i), left(i) < right(i));
      EXPECT_EQ(lane(a <= b, i), left(i) <= right(i));
      EXPECT_EQ(lane(a > b, i), left(i) > right(i));
      EXPECT_EQ(lane(a >= b, i), left(i) >= right(i));
      EXPECT_EQ(lane(a == b, i), left(i) == right(i));
      EXPECT_EQ(lane(a != b, i), left(i) != right(i));
    }
  }
}

TYPED_TEST(PackOfWidth, masks_combine_lane_by_lane) {
  using Fixture = PackOfWidth<TypeParam>;
  const auto x = Fixture::fill([](int i) { return static_cast<double>(i % 4); });
  const auto low = x < 2.0;
  const auto odd = (x == 1.0) | (x == 3.0);
  for (int i = 0; i < Fixture::width; ++i) {
    const bool is_low = i % 4 < 2;
    const bool is_odd = i % 2 == 1;
    EXPECT_EQ(lane(low & odd, i), is_low && is_odd);
    EXPECT_EQ(lane(low | odd, i), is_low || is_odd);
    EXPECT_EQ(lane(low ^ odd, i), is_low != is_odd);
    EXPECT_EQ(lane(!low, i), !is_low);
  }
  EXPECT_TRUE(all(typename Fixture::MaskType(true)));
  EXPECT_FALSE(any(typename Fixture::MaskType(false)));
}

TYPED_TEST(PackOfWidth, arithmetic_is_that_of_double_in_every_lane) {
  using Fixture = PackOfWidth<TypeParam>;
  const auto left = [](int i) { return 1.1 * (i + 1); };
  const auto right = [](int i) { return 0.7 - i; };
  const auto a = Fixture::fill(left);
  const auto b = Fixture::fill(right);
  auto changed = a;
  changed += b;
  changed *= 3.0;
  changed -= 1;
  changed /= b;
  for (int i = 0; i < Fixture::width; ++i) {
    const double x = left(i);
    const double y = right(i);
    EXPECT_EQ(lane(a + b, i), x + y);
    EXPECT_EQ(lane(a - b, i), x - y);
    EXPECT_EQ(lane(a * b, i), x * y);
    EXPECT_EQ(lane(a / b, i), x / y);
    EXPECT_EQ(lane(-a, i), -x);
    EXPECT_EQ(lane(2.0 * a + 1, i), 2.0 * x + 1);
    EXPECT_EQ(lane(1 / a - 3.0, i), 1 / x - 3.0);
    EXPECT_EQ(lane(sqrt(a), i), std::sqrt(x));
    EXPECT_EQ(lane(changed, i), ((x + y) * 3.0 - 1) / y);
  }
}

TYPED_TEST(PackOfWidth, signs_of_zero_survive) {
  using Fixture = PackOfWidth<TypeParam>;
  using Broadcast = typename Fixture::PackType;
  for (int i = 0; i < Fixture::width; ++i) {
    EXPECT_EQ(pattern(lane(Broadcast(-0.0), i)), pattern(-0.0));
    EXPECT_EQ(pattern(lane(-Broadcast(0.0), i)), pattern(-0.0));
    EXPECT_EQ(pattern(lane(sqrt(Broadcast(-0.0)), i)), pattern(-0.0));
    EXPECT_TRUE(lane(signbit(Broadcast(-0.0)), i));
    EXPECT_FALSE(lane(signbit(Broadcast(0.0)), i));
  }
}

TYPED_TEST(PackOfWidth, loads_and_stores_need_no_alignment) {
  using Fixture = PackOfWidth<TypeParam>;
  std::array<double, 11> memory{};
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = static_cast<double>(i);
  for (std::size_t offset = 0; offset < 3; ++offset) {
    const auto p = Fixture::PackType::load(memory.data() + offset);
    std::array<double, 11> copy{};
    (p + 0.5).store(copy.data() + offset);
    for (int i = 0; i < Fixture::width; ++i) {
      const std::size_t at = offset + static_cast<std::size_t>(i);
      EXPECT_EQ(lane(p, i), static_cast<double>(at));
      EXPECT_EQ(copy[at], static_cast<double>(at) + 0.5);
    }
    EXPECT_EQ(copy[offset + static_cast<std::size_t>(Fixture::width)], 0.0);
  }
}

TYPED_TEST(PackOfWidth, says_how_many_lanes_it_has) {
  using Fixture = PackOfWidth<TypeParam>;
  EXPECT_EQ(lanes<typename Fixture::PackType>, Fixture::width);
  EXPECT_EQ(lanes<double>, 1);
  EXPECT_EQ(sizeof(typename Fixture::PackType), sizeof(double) * static_cast<std::size_t>(Fixture::width));
}

TEST(SelectOfDouble, is_the_ternary) {
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, 1.0, 2), 2.0);
  EXPECT_TRUE(any(true));
  EXPECT_FALSE(all(false));
}

}  // namespace
}  // namespace xpr
