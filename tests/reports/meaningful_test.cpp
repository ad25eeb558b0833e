#include "reports/meaningful.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace xpr {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(Meaningful, rounds_at_the_place_of_the_uncertainty) {
  EXPECT_EQ(meaningful(1.23456789, 3e-5), "1.23457");
  EXPECT_EQ(meaningful(1.23456789, 0.04), "1.23");
  EXPECT_EQ(meaningful(-2.5980762113533, 3e-12), "-2.598076211353");
  EXPECT_EQ(meaningful(1.23456789, 1.9e-5), "1.234568");
  EXPECT_EQ(meaningful(123456.0, 20.0), "1.2346e5");
  EXPECT_EQ(meaningful(1.23456e-9, 2e-12), "1.235e-9");
  EXPECT_EQ(meaningful(6.02214e23, 2e20), "6.022e23");
}

TEST(Meaningful, keeps_trailing_zeros_that_were_measured) {
  EXPECT_EQ(meaningful(3.0, 2e-10), "3.0000000000");
  EXPECT_EQ(meaningful(1.5, 2e-4), "1.5000");
}

TEST(Meaningful, carries_into_the_next_power_of_ten) {
  EXPECT_EQ(meaningful(9.96, 0.2), "10.0");
  EXPECT_EQ(meaningful(0.99996, 2e-4), "1.0000");
  EXPECT_EQ(meaningful(999999.96, 0.2), "1.0000000e6");
}

TEST(Meaningful, never_prints_a_small_value_as_zero) {
  EXPECT_EQ(meaningful(3e-14, 1e-12), "3e-14");
  EXPECT_EQ(meaningful(0.6, 10.0), "0.6");
  EXPECT_EQ(meaningful(0.0, 1e-12), "0");
}

TEST(Meaningful, prints_every_digit_where_no_uncertainty_is_known) {
  EXPECT_EQ(meaningful(0.1, 0.0), "0.1");
  EXPECT_EQ(meaningful(1.0 / 3.0, not_a_number), "0.3333333333333333");
  EXPECT_EQ(meaningful(1.0 / 3.0, 1e-30), "0.3333333333333333");
}

TEST(Meaningful, names_what_is_not_finite) {
  EXPECT_EQ(meaningful(not_a_number, 1.0), "nan");
  EXPECT_EQ(meaningful(-infinity, 1.0), "-inf");
  EXPECT_EQ(two_digits(infinity), "inf");
  EXPECT_EQ(two_digits_or_na(not_a_number), "na");
}

TEST(Meaningful, never_rounds_a_disagreement_away) {
  // Value and reference a stated error apart must print differently, at every size of both.
  std::mt19937_64 random(20240607);
  std::uniform_real_distribution<double> mantissa(1.0, 10.0);
  std::uniform_int_distribution<int> exponent(-20, 20);
  std::uniform_int_distribution<int> depth(1, 18);
  for (int i = 0; i < 100000; ++i) {
    const int size = exponent(random);
    const double value = mantissa(random) * std::pow(10.0, size);
    const double reference = value + mantissa(random) * std::pow(10.0, size - depth(random));
    const double error = std::abs(value - reference);
    if (error == 0.0) continue;
    ASSERT_NE(meaningful(value, error), meaningful(reference, error)) << value << " off by " << error;
  }
}

TEST(Meaningful, is_within_half_a_place_of_the_value) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(1.0, 10.0);
  std::uniform_int_distribution<int> exponent(-12, 12);
  for (int i = 0; i < 20000; ++i) {
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const double uncertainty = value * std::pow(10.0, -std::uniform_int_distribution<int>(1, 14)(random));
    // The place is at most `uncertainty`; 4 ulp for the two conversions.
    ASSERT_NEAR(std::stod(meaningful(value, uncertainty)), value, 0.5 * uncertainty + 1e-15 * value);
  }
}

TEST(TwoDigits, are_enough_for_errors_and_ratios) {
  EXPECT_EQ(two_digits(3.14e-13), "3.1e-13");
  EXPECT_EQ(two_digits(0.4249), "0.42");
  EXPECT_EQ(two_digits(0.0421), "0.042");
  EXPECT_EQ(two_digits(0.996), "1.0");
  EXPECT_EQ(two_digits(17.4), "17");
  EXPECT_EQ(two_digits(996.0), "1.0e3");
  EXPECT_EQ(two_digits(0.0), "0");
  EXPECT_EQ(two_digits(-0.5), "-0.50");
}

TEST(Grouped, separates_thousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(-1234567), "-1,234,567");
}

}  // namespace
}  // namespace xpr
