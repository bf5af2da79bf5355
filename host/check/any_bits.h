#pragma once
/// Numbers that no scene has: what kernels must survive.
#include <bit>
#include <cstdint>
#include <limits>
#include <random>

namespace triad::any_bits {

/// Every pattern of 32 bits is drawn; half of the draws are the ends of float's range and what is beyond.
class Words {
  public:
    explicit Words(std::uint64_t seed) : engine_(seed) {}

    std::uint32_t bits() { return std::uint32_t(engine_() >> 32); }
    float number() {
        using limits = std::numeric_limits<float>;
        constexpr float special[] = {0.0f,
                                     -0.0f,
                                     limits::infinity(),
                                     -limits::infinity(),
                                     limits::quiet_NaN(),
                                     -limits::quiet_NaN(),
                                     limits::max(),
                                     limits::lowest(),
                                     limits::min(),
                                     -limits::min(),
                                     limits::denorm_min(),
                                     -limits::denorm_min(),
                                     0x1p64f,
                                     -0x1p-64f,
                                     1.0f,
                                     -1.0f};
        const std::uint32_t choice = bits();
        return choice & 16 ? special[choice & 15] : std::bit_cast<float>(bits());
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace triad::any_bits
