#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "io/linear_decode.h"

namespace triad {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

/// A picture's rows as they lie in the file (Radiance, color.c: freadcolrs and oldreadcolrs).
class Rows {
  public:
    Rows(const std::string& name, std::span<const std::uint8_t> bytes) : name_(name), bytes_(bytes) {}

    void next(std::span<Rgbe> row) {
        const std::size_t width = row.size();
        const auto start = bytes_.subspan(at_, std::min<std::size_t>(4, bytes_.size() - at_));
        const bool is_new = width >= 8 && width < 32768 && start.size() == 4 && start[0] == 2 &&
                            start[1] == 2 && start[2] < 128;
        if (!is_new)
            read_old(row);
        else if ((std::size_t(start[2]) << 8 | start[3]) != width)
            fail("is of another width");
        else
            read_new(row);
        ++rows_;
    }

  private:
    [[noreturn]] void fail(const char* what) const {
        throw Error(Exit::scene, "Image " + name_ + " cannot be read: its row " + std::to_string(rows_ + 1) +
                                     " " + what + ".");
    }
    std::uint8_t byte() {
        if (at_ == bytes_.size()) fail("is missing, or ends early");
        return bytes_[at_++];
    }

    /// Each component by itself: above 128 a run of the byte that follows, else so many bytes as they are.
    void read_new(std::span<Rgbe> row) {
        at_ += 4;
        for (unsigned c = 0; c < 4; ++c)
            for (std::size_t x = 0; x < row.size();) {
                const unsigned code = byte(), count = code > 128 ? code - 128 : code;
                if (count == 0 || count > row.size() - x) fail("has a run that does not fit");
                const std::uint8_t value = code > 128 ? byte() : 0;
                for (const std::size_t end = x + count; x < end; ++x) row[x][c] = code > 128 ? value : byte();
            }
    }

    /// Texels as they are, or 1, 1, 1, n: the last texel n times more; a next one counts in 256.
    void read_old(std::span<Rgbe> row) {
        unsigned shift = 0;
        for (std::size_t x = 0; x < row.size();) {
            Rgbe texel;
            for (std::uint8_t& v : texel) v = byte();
            const bool is_run = texel[0] == 1 && texel[1] == 1 && texel[2] == 1;
            if (!is_run) {
                row[x++] = texel, shift = 0;
                continue;
            }
            const std::uint64_t count = shift < 32 ? std::uint64_t(texel[3]) << shift : row.size() + 1;
            if (x == 0 || count > row.size() - x) fail("has a run that does not fit");
            std::fill_n(row.begin() + std::ptrdiff_t(x), count, row[x - 1]);
            x += count, shift += 8;
        }
    }

    const std::string& name_;
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0, rows_ = 0;
};

}  // namespace

void decode_hdr(const std::string& name, const CleanImage& hdr, const TakeRows& take) {
    std::vector<Rgbe> row(hdr.width);
    std::vector<float> values(std::size_t(hdr.width) * 3);
    Rows rows(name, hdr.bytes);
    for (unsigned y = 0; y < hdr.height; ++y) {
        rows.next(row);
        for (std::size_t x = 0; x < hdr.width; ++x) {
            const float unit = row[x][3] ? std::ldexp(1.0f, int(row[x][3]) - 136) : 0.0f;
            for (unsigned c = 0; c < 3; ++c) values[x * 3 + c] = float(row[x][c]) * unit;
        }
        take(1, values.data());
    }
}

}  // namespace triad
