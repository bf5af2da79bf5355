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

/// "2026-11-22 05:10 UTC".
std::string date_words();

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// "data:TYPE;base64,..."
std::string data_uri(std::string_view media_type, std::span<const std::uint8_t> bytes);

/// A whole page with the style of all reports (page/page_style.h), and what `css` adds.
std::string html_page(std::string_view title, std::string_view css, std::string_view body);

/// A cell of a table, which on a narrow screen stands below its label: a number, on one line where there is
/// room, with a small line below it; or words.
std::string number_cell(std::string_view label, std::string_view text, std::string_view below = {});
std::string text_cell(std::string_view label, std::string_view text);

/// A picture with its words below, which are also for who cannot see it.
std::string svg_figure(std::string_view svg, std::string_view words);

}  // namespace triad
