#include "bench/display_bench.h"

#include <random>
#include <vector>

namespace triad {

Film noise_film() {
    std::mt19937 random(1);
    Film film;
    film.full_width = film.width = 1920, film.full_height = film.height = 270;
    film.bins_x = film.bins_y = 3;
    film.quanta_log2 = 30;
    film.sums.resize(film.pixels() * film.bins() * 4);
    for (std::size_t i = 0; i < film.sums.size(); ++i)
        film.sums[i] =
            i % 4 == 3 ? std::int64_t(1) << 30 : std::int64_t(random() % 4 ? random() >> 3 : random());
    film.samples.assign(film.pixels(), 18);
    film.ranges = {{0, 18}};
    film.half_sums.resize(film.pixels() * 3);
    for (std::int64_t& sum : film.half_sums) sum = std::int64_t(random()) * 9 / 2;
    return film;
}

std::map<std::string, Estimate> time_display(Device& device, const Film& film,
                                             const DisplaySettings& settings, unsigned rounds) {
    std::map<std::string, std::vector<double>> all;
    resolve_display(device, film, settings);  // compiles
    std::map<std::string, KernelTime> before = device.times();
    for (unsigned i = 0; i < rounds; ++i) {
        resolve_display(device, film, settings);
        const std::map<std::string, KernelTime> after = device.times();
        for (const auto& [kernel, time] : after)
            if (time.launches > before[kernel].launches)
                all[kernel].push_back((time.seconds - before[kernel].seconds) * 1e3 /
                                      (double(film.pixels()) * 1e-6));
        before = after;
    }
    std::map<std::string, Estimate> times;
    for (const auto& [kernel, values] : all) times[kernel] = median_estimate(values);
    return times;
}

}  // namespace triad
