#pragma once
/// The smallest PNG writer: every colour type and depth, data stored without compression.
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tiny_png {

using Bytes = std::vector<std::uint8_t>;

inline void add32(Bytes& to, std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(std::uint8_t(v >> shift));
}

inline void add_chunk(Bytes& png, std::string_view type, const Bytes& data) {
    add32(png, std::uint32_t(data.size()));
    const std::size_t start = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    std::uint32_t crc = ~0u;
    for (std::size_t i = start; i < png.size(); ++i) {
        crc ^= png[i];
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    add32(png, ~crc);
}

struct Chunk {
    std::string_view type;
    Bytes data;
};

/// `rows`: each row's bytes as PNG packs them. `extra`: chunks between IHDR and IDAT.
inline Bytes make(unsigned width, unsigned bits, unsigned colour_type, const std::vector<Bytes>& rows,
                  const std::vector<Chunk>& extra = {}) {
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, header, raw, data{0x78, 0x01};
    add32(header, width);
    add32(header, std::uint32_t(rows.size()));
    header.insert(header.end(), {std::uint8_t(bits), std::uint8_t(colour_type), 0, 0, 0});
    add_chunk(png, "IHDR", header);
    for (const Chunk& chunk : extra) add_chunk(png, chunk.type, chunk.data);
    for (const Bytes& row : rows) {
        raw.push_back(0);
        raw.insert(raw.end(), row.begin(), row.end());
    }
    const unsigned n = unsigned(raw.size());  // one stored block: below 65536 bytes
    for (const unsigned v : {1u, n & 255, n >> 8, ~n & 255, ~n >> 8 & 255}) data.push_back(std::uint8_t(v));
    data.insert(data.end(), raw.begin(), raw.end());
    std::uint32_t a = 1, b = 0;
    for (const std::uint8_t v : raw) a = (a + v) % 65521, b = (b + a) % 65521;
    add32(data, b << 16 | a);
    add_chunk(png, "IDAT", data);
    add_chunk(png, "IEND", {});
    return png;
}

}  // namespace tiny_png
