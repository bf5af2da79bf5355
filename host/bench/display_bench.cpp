#include "bench/display_bench.h"

#include <random>
#include <span>
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
    for (unsigned i = 0; i < rounds; ++i) {
        const std::size_t before = device.commands().size();
        resolve_display(device, film, settings);
        std::map<std::string, double> milliseconds;
        for (const DeviceCommand& command : std::span(device.commands()).subspan(before))
            if (command.kind == CommandKind::kernel)
                milliseconds[command.name] += 1e-6 * double(command.end - command.start);
        for (const auto& [kernel, ms] : milliseconds)
            all[kernel].push_back(ms / (double(film.pixels()) * 1e-6));
    }
    std::map<std::string, Estimate> times;
    for (const auto& [kernel, values] : all) times[kernel] = median_estimate(values);
    return times;
}

}  // namespace triad
