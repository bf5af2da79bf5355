#include "io/gltf_uri.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/error.h"

namespace fs = std::filesystem;

namespace triad::gltf {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// %XY becomes a byte; a stray '%' stays, since exporters write such names.
std::string percent_decode(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
            hex_digit(text[i + 2]) >= 0) {
            result += char(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

bool ends_with_ignoring_case(std::string_view text, std::string_view end) {
    return text.size() >= end.size() &&
           std::equal(end.begin(), end.end(), text.end() - std::ptrdiff_t(end.size()),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

std::vector<std::uint8_t> decode_base64(std::string_view text, const std::string& what) {
    static const auto values = [] {
        std::array<std::int8_t, 256> table;
        table.fill(-1);
        const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (int i = 0; i < 64; ++i) table[std::uint8_t(digits[i])] = std::int8_t(i);
        return table;
    }();
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
    if (text.size() % 4 == 1)
        throw Error(Exit::scene, what + " has a data URI whose base64 text is cut off.");
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int value = values[std::uint8_t(c)];
        if (value < 0)
            throw Error(Exit::scene, what + " has a data URI with a character that is not base64.");
        bits = bits << 6 | std::uint32_t(value);
        held += 6;
        if (held >= 8) bytes.push_back(std::uint8_t(bits >> (held -= 8)));
    }
    return bytes;
}

bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 0 && std::isalpha(static_cast<unsigned char>(uri[0])) &&
           std::all_of(uri.begin(), uri.begin() + std::ptrdiff_t(colon),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

}  // namespace

std::optional<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri, const std::string& what) {
    if (!ends_with_ignoring_case(uri.substr(0, 5), "data:")) return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw Error(Exit::scene, what + " has a data URI without a comma.");
    const std::string_view header = uri.substr(5, comma - 5), payload = uri.substr(comma + 1);
    if (!ends_with_ignoring_case(header, ";base64")) {
        const std::string text = percent_decode(payload);
        return std::vector<std::uint8_t>(text.begin(), text.end());
    }
    if (payload.find('%') == std::string_view::npos) return decode_base64(payload, what);
    return decode_base64(percent_decode(payload), what);
}

fs::path resolve_uri(std::string_view uri, const fs::path& folder, const std::string& what) {
    const auto refuse = [&](const std::string& why) -> fs::path {
        throw Error(Exit::scene, what + " refers to '" + std::string(uri.substr(0, 200)) + "', " + why + ".");
    };
    if (has_scheme(uri)) return refuse("which is not a relative path; only files beside the scene are read");
    const std::string name = percent_decode(uri);
    if (name.empty()) return refuse("which names nothing");
    if (name.find('\0') != std::string::npos) return refuse("which contains a NUL");
    const fs::path relative(name);
    if (relative.is_absolute())
        return refuse("which is an absolute path; only files beside the scene are read");
    for (const fs::path& part : relative)
        if (part == "..") return refuse("which leads out of the scene's folder");

    std::error_code failed;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, failed);
    if (failed) return refuse("but the scene's folder cannot be read: " + failed.message());
    const fs::path target = fs::canonical(root / relative, failed);
    if (failed) return refuse("which cannot be opened: " + failed.message());
    const auto [end_of_root, ignored] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
    if (end_of_root != root.end()) return refuse("a link that leads out of the scene's folder");
    if (!fs::is_regular_file(target, failed)) return refuse("which is not a regular file");
    return target;
}

}  // namespace triad::gltf
