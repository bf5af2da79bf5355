#pragma once
/// Text with numbers in it.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace triad {

/// What printf would print. The pattern is a literal of ours, the values are numbers and C strings.
std::string format(const char* pattern, auto... values) {
    std::string text(std::size_t(std::snprintf(nullptr, 0, pattern, values...)), '\0');
    std::snprintf(text.data(), text.size() + 1, pattern, values...);
    return text;
}

/// The name nearest to `word` when it is likely a slip (two edits at most, less than half of the word), else
/// "".
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// What an exception of the JSON library says, without the name of its kind before it.
std::string words_of_json(const std::exception& error);

/// 1234567 -> "1.2 MB".
std::string bytes_text(std::uint64_t bytes);

}  // namespace triad
