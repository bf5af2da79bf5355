#pragma once
/// What an HTML file of one piece is made of.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace triad {

/// Text for an element or a quoted attribute: & < > " ' as entities; control characters and bytes that are
/// not UTF-8 become U+FFFD, so that no name in a file can break the page.
std::string html_escape(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// "data:TYPE;base64,..."
std::string data_uri(std::string_view media_type, std::span<const std::uint8_t> bytes);

}  // namespace triad
