// Numbers as a report prints them: only digits that mean something, and never so few that a disagreement disappears.
#pragma once

#include <cstdint>
#include <string>

namespace xpr {

/// `value` rounded at the decimal place of the leading digit of `uncertainty` (the second one where the first is a 1),
/// so that two values that differ by at least `uncertainty` never print alike. Without a positive finite uncertainty,
/// and wherever the place lies beyond what a double holds, the shortest digits that read back to the same double. At
/// least one digit is kept, so a small value is never printed as 0. Non-finite values print as nan, inf, -inf.
[[nodiscard]] std::string meaningful(double value, double uncertainty);

/// An error, a tolerance or a ratio: two significant digits ("3.1e-13", "0.42"); an exact zero is "0".
[[nodiscard]] std::string two_digits(double value);

/// Two digits, or "na" where the number does not exist (NaN).
[[nodiscard]] std::string two_digits_or_na(double value);

/// The shortest digits that read back to the same double: for inputs, which are exact.
[[nodiscard]] std::string shortest(double value);

/// 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::int64_t count);

/// "1 row", "2,000 rows".
[[nodiscard]] std::string counted(std::int64_t count, const std::string& noun);

}  // namespace xpr
