#include "reports/meaningful.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace xpr {
namespace {

// Magnitudes in [1e-4, 1e6) are easier to read without an exponent.
constexpr int smallest_plain_exponent = -4;
constexpr int largest_plain_exponent = 5;
// Digits that tell every double from its neighbours.
constexpr int digits_of_a_double = 17;

int decimal_exponent(double x) {
  const std::string text = fmt::format("{:.16e}", x);
  return std::stoi(text.substr(text.find('e') + 1));
}

double rounded_to_digits(double value, int digits) { return std::stod(fmt::format("{:.{}e}", value, digits - 1)); }

/// Where an uncertainty puts the last digit: its leading one, or the next after a leading 1, since half of 10 to 20 is
/// coarse and a tie rounded to even could hide a difference of exactly one unit.
int last_place(double uncertainty) {
  const std::string text = fmt::format("{:.16e}", uncertainty);
  return decimal_exponent(uncertainty) - (text.front() == '1' ? 1 : 0);
}

std::string non_finite(double value) {
  if (std::isnan(value)) return "nan";
  return value > 0.0 ? "inf" : "-inf";
}

/// "1.50e+07" as "1.50e7": the sign and the zeros say nothing.
std::string short_exponent(std::string text) {
  const auto e = text.find('e');
  if (e == std::string::npos) return text;
  return fmt::format("{}e{}", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string shortest(double value) {
  if (!std::isfinite(value)) return non_finite(value);
  return short_exponent(fmt::format("{}", value));
}

std::string meaningful(double value, double uncertainty) {
  if (!std::isfinite(value)) return non_finite(value);
  if (value == 0.0) return "0";
  if (!std::isfinite(uncertainty) || uncertainty <= 0.0) return shortest(value);
  const int place = last_place(uncertainty);
  const int digits = std::max(decimal_exponent(value) - place + 1, 1);
  if (digits >= digits_of_a_double) return shortest(value);
  const double rounded = rounded_to_digits(value, digits);
  // Rounding up to the next power of ten (9.96 -> 10.0) adds a digit at the same place.
  const int exponent = decimal_exponent(rounded);
  const int kept = std::max(exponent - place + 1, 1);
  // A plain number is written only where its last digit is a meaningful one: 1.2e5 is not 120000.
  if (exponent < smallest_plain_exponent || exponent > largest_plain_exponent || kept <= exponent) {
    return short_exponent(fmt::format("{:.{}e}", rounded, kept - 1));
  }
  return fmt::format("{:.{}f}", rounded, kept - 1 - exponent);
}

std::string two_digits(double value) {
  if (!std::isfinite(value)) return non_finite(value);
  if (value == 0.0) return "0";
  const int exponent = decimal_exponent(rounded_to_digits(value, 2));
  if (exponent < -2 || exponent > 2) return short_exponent(fmt::format("{:.1e}", value));
  return fmt::format("{:.{}f}", value, std::max(1 - exponent, 0));
}

std::string two_digits_or_na(double value) { return std::isnan(value) ? "na" : two_digits(value); }

std::string grouped(std::int64_t count) {
  const std::string digits = fmt::format("{}", count);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const bool boundary = i > 0 && digits[i - 1] != '-' && (digits.size() - i) % 3 == 0;
    if (boundary) text += ',';
    text += digits[i];
  }
  return text;
}

std::string counted(std::int64_t count, const std::string& noun) {
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace xpr
