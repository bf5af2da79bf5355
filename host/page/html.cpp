#include "page/html.h"

#include <ctime>

#include "page/page_style.h"

namespace triad {
namespace {

/// How many bytes the well-formed UTF-8 character at the beginning of `text` has; 0 when there is none
/// (Unicode 15, table 3-7).
std::size_t character_length(std::string_view text) {
    const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned a = at(0), b = at(1);
    auto follows = [&](std::size_t i) { return (at(i) & 0xc0) == 0x80; };
    if (a < 0x80) return 1;
    if (a >= 0xc2 && a <= 0xdf) return follows(1) ? 2 : 0;
    if (a >= 0xe0 && a <= 0xef) {
        const bool second = follows(1) && (a != 0xe0 || b >= 0xa0) && (a != 0xed || b <= 0x9f);
        return second && follows(2) ? 3 : 0;
    }
    if (a >= 0xf0 && a <= 0xf4) {
        const bool second = follows(1) && (a != 0xf0 || b >= 0x90) && (a != 0xf4 || b <= 0x8f);
        return second && follows(2) && follows(3) ? 4 : 0;
    }
    return 0;
}

}  // namespace

std::string html_escape(std::string_view text) {
    constexpr std::string_view replacement = "\xef\xbf\xbd";
    std::string out;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const char c = text.front();
        if (length == 0 || (length == 1 && (static_cast<unsigned char>(c) < 32 || c == 127)))
            out += c == '\n' || c == '\t' ? std::string_view(" ") : replacement;
        else if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += text.substr(0, length);
        text.remove_prefix(length ? length : 1);
    }
    return out;
}

std::string date_words() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
    return text;
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = bytes.size() - i;
        const unsigned v = unsigned(bytes[i]) << 16 | (n > 1 ? unsigned(bytes[i + 1]) << 8 : 0u) |
                           (n > 2 ? bytes[i + 2] : 0u);
        out += {digits[v >> 18], digits[v >> 12 & 63], n > 1 ? digits[v >> 6 & 63] : '=',
                n > 2 ? digits[v & 63] : '='};
    }
    return out;
}

std::string data_uri(std::string_view media_type, std::span<const std::uint8_t> bytes) {
    return "data:" + std::string(media_type) + ";base64," + base64(bytes);
}

std::string html_page(std::string_view title, std::string_view css, std::string_view body) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>" +
        html_escape(title) + "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" + page_style;
    return html.append(css).append("</style></head><body>\n").append(body) + "</body></html>\n";
}

std::string number_cell(std::string_view label, std::string_view text, std::string_view below) {
    return "<td class=\"n\" data-label=\"" + html_escape(label) + "\"><span class=\"v\">" +
           html_escape(text) + "</span>" +
           (below.empty() ? "" : "<small>" + html_escape(below) + "</small>") + "</td>";
}

std::string text_cell(std::string_view label, std::string_view text) {
    return "<td data-label=\"" + html_escape(label) + "\"><span class=\"v\">" + html_escape(text) +
           "</span></td>";
}

std::string svg_figure(std::string_view svg, std::string_view words) {
    return "<figure><img alt=\"" + html_escape(words) + "\" src=\"" +
           data_uri("image/svg+xml", {reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}) +
           "\"><figcaption>" + html_escape(words) + "</figcaption></figure>\n";
}

}  // namespace triad
