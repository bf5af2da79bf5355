#pragma once
/// Text with numbers in it.
#include <cstdio>
#include <string>

namespace triad {

/// What printf would print. The pattern is a literal of ours, the values are numbers and C strings.
std::string format(const char* pattern, auto... values) {
    std::string text(std::size_t(std::snprintf(nullptr, 0, pattern, values...)), '\0');
    std::snprintf(text.data(), text.size() + 1, pattern, values...);
    return text;
}

}  // namespace triad
