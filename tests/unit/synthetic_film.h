#pragma once
/// Films whose every value is known, and what they are as files.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/files.h"
#include "io/io.h"
#include "scene/film.h"
#include "temporary_folder.h"

/// What a renderer would make: sample s of pixel p has a value that depends on (p, s) alone.
inline triad::Film synthetic(triad::SampleRange range, unsigned bins_x = 1, unsigned bins_y = 1) {
    triad::Film film;
    film.full_width = 7, film.full_height = 5;
    film.x = 1, film.y = 2, film.width = 4, film.height = 3;
    film.bins_x = bins_x, film.bins_y = bins_y;
    film.quanta_log2 = 30;
    const std::size_t bins = film.bins();
    film.sums.assign(film.pixels() * bins * 4, 0);
    film.half_sums.assign(film.pixels() * 3, 0);
    film.samples.assign(film.pixels(), std::uint32_t(range.end - range.begin));
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::uint64_t s = range.begin; s < range.end; ++s)
            for (std::size_t c = 0; c < 4; ++c) {
                const auto value = std::int64_t((p * 7919 + s * 104729 + c * 1299709) % 1000003) << 12;
                film.sums[(p * bins + s % bins) * 4 + c] += value;
                if (c < 3 && ((s / bins) & 1) == 0) film.half_sums[p * 3 + c] += value;
            }
    film.ranges = {range};
    film.counters = {range.end - range.begin, 1, 0, 2, 3};
    film.scene = "00112233445566778899aabbccddeeff";
    film.settings = "ffeeddccbbaa99887766554433221100";
    film.settings_text = "{\"seed\": 1}";
    film.devices = {"some device"};
    return film;
}

inline std::vector<std::uint8_t> bytes_of(const triad::Film& film, const TemporaryFolder& folder) {
    triad::save_film(folder / "bytes.film", film);
    return triad::read_file(folder / "bytes.film");
}

inline void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}
