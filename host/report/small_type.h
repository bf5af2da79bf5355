#pragma once
/// Words in pictures: letters of 3 x 5 px, for colour bars and charts.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace triad {

/// A picture of 8-bit sRGB.
struct BytePicture {
    unsigned width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    BytePicture(unsigned w, unsigned h, const std::array<std::uint8_t, 3>& colour);
    void set(unsigned x, unsigned y, const std::array<std::uint8_t, 3>& colour);
};

/// Px from the first letter to the end of the last, at `zoom` px per dot of a letter.
unsigned type_width(const std::string& text, unsigned zoom);
inline unsigned type_height(unsigned zoom) { return 5 * zoom; }

/// Capitals, digits and . - + @ : ; others leave a space. What is outside of the picture is not drawn.
void draw_type(BytePicture& picture, const std::string& text, unsigned x, unsigned y, unsigned zoom,
               const std::array<std::uint8_t, 3>& colour);

}  // namespace triad
