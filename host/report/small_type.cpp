#include "report/small_type.h"

#include <algorithm>
#include <cctype>

namespace triad {
namespace {

/// Rows from the top, the left dot in bit 2.
struct Letter {
    char name;
    std::array<unsigned char, 5> rows;
};
constexpr Letter letters[] = {
    {'0', {7, 5, 5, 5, 7}}, {'1', {2, 6, 2, 2, 7}}, {'2', {7, 1, 7, 4, 7}}, {'3', {7, 1, 3, 1, 7}},
    {'4', {5, 5, 7, 1, 1}}, {'5', {7, 4, 7, 1, 7}}, {'6', {7, 4, 7, 5, 7}}, {'7', {7, 1, 2, 2, 2}},
    {'8', {7, 5, 7, 5, 7}}, {'9', {7, 5, 7, 1, 7}}, {'A', {2, 5, 7, 5, 5}}, {'B', {6, 5, 6, 5, 6}},
    {'C', {3, 4, 4, 4, 3}}, {'D', {6, 5, 5, 5, 6}}, {'E', {7, 4, 6, 4, 7}}, {'F', {7, 4, 6, 4, 4}},
    {'G', {3, 4, 5, 5, 3}}, {'H', {5, 5, 7, 5, 5}}, {'I', {7, 2, 2, 2, 7}}, {'J', {1, 1, 1, 5, 2}},
    {'K', {5, 5, 6, 5, 5}}, {'L', {4, 4, 4, 4, 7}}, {'M', {5, 7, 7, 5, 5}}, {'N', {6, 5, 5, 5, 5}},
    {'O', {2, 5, 5, 5, 2}}, {'P', {6, 5, 6, 4, 4}}, {'Q', {2, 5, 5, 2, 1}}, {'R', {6, 5, 6, 5, 5}},
    {'S', {3, 4, 2, 1, 6}}, {'T', {7, 2, 2, 2, 2}}, {'U', {5, 5, 5, 5, 7}}, {'V', {5, 5, 5, 5, 2}},
    {'W', {5, 5, 7, 7, 5}}, {'X', {5, 5, 2, 5, 5}}, {'Y', {5, 5, 2, 2, 2}}, {'Z', {7, 1, 2, 4, 7}},
    {'.', {0, 0, 0, 0, 2}}, {'-', {0, 0, 7, 0, 0}}, {'+', {0, 2, 7, 2, 0}}, {'@', {7, 5, 5, 4, 7}},
    {':', {0, 2, 0, 2, 0}}};

}  // namespace

BytePicture::BytePicture(unsigned w, unsigned h, const std::array<std::uint8_t, 3>& colour)
    : width(w), height(h), rgb(std::size_t(w) * h * 3) {
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = colour[i % 3];
}

void BytePicture::set(unsigned x, unsigned y, const std::array<std::uint8_t, 3>& colour) {
    if (x < width && y < height)
        std::copy(colour.begin(), colour.end(),
                  rgb.begin() + std::ptrdiff_t((std::size_t(y) * width + x) * 3));
}

unsigned type_width(const std::string& text, unsigned zoom) {
    return text.empty() ? 0 : unsigned(4 * text.size() - 1) * zoom;
}

void draw_type(BytePicture& picture, const std::string& text, unsigned x, unsigned y, unsigned zoom,
               const std::array<std::uint8_t, 3>& colour) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char name = char(std::toupper(static_cast<unsigned char>(text[i])));
        const auto letter = std::find_if(std::begin(letters), std::end(letters),
                                         [name](const Letter& l) { return l.name == name; });
        if (letter == std::end(letters)) continue;
        for (unsigned v = 0; v < 5 * zoom; ++v)
            for (unsigned u = 0; u < 3 * zoom; ++u)
                if (letter->rows[v / zoom] >> (2 - u / zoom) & 1)
                    picture.set(x + unsigned(4 * i) * zoom + u, y + v, colour);
    }
}

}  // namespace triad
