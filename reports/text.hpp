// Text made fit for where it goes.
#pragma once

#include <string>
#include <string_view>

namespace xpr {

/// Valid UTF-8 without the control characters that XML 1.0 forbids; each offending byte becomes U+FFFD.
[[nodiscard]] std::string clean_text(std::string_view text);

/// Clean text with every character that XML or HTML reads as markup replaced; fit for element content and for quoted
/// attributes.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// Lower case letters, digits and dashes, fit for an anchor or a file name: "kerr/shadow edge" -> "kerr-shadow-edge".
[[nodiscard]] std::string slug(std::string_view text);

}  // namespace xpr
