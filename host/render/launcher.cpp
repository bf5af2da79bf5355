#include "render/launcher.h"

#include <algorithm>

#include "render/renderer_state.h"

namespace triad {

double Launcher::pace() const {
    double sum = 0;
    for (const auto& tracer : tracers_) sum += tracer->pace;
    return sum;
}

std::uint64_t Launcher::samples_of(const dev::TileWork& w) const {
    return std::uint64_t(w.sample_count[0]) * set_pixels_[2 * w.tile] +
           std::uint64_t(w.sample_count[1]) * set_pixels_[2 * w.tile + 1];
}

Launcher::Launched Launcher::launch(const std::vector<dev::TileWork>& work, std::size_t first,
                                    std::uint64_t first_sample, double seconds) {
    Launched launched;
    std::vector<std::uint64_t> shares;
    const auto start = RenderClock::now();
    for (auto& tracer : tracers_) {
        const std::size_t next = first + launched.tiles;
        if (next == work.size()) break;
        const double fit = tracer->pace * seconds;
        const std::size_t most = tracer->pace > 0 ? tracer->most_tiles() : 16;
        std::size_t n = 0;
        std::uint64_t samples = 0;
        while (next + n < work.size() && n < most && (n == 0 || tracer->pace == 0 || double(samples) < fit))
            samples += samples_of(work[next + n++]);
        tracer->trace(next, n, first_sample);
        shares.push_back(samples);
        launched.tiles += n, launched.samples += samples;
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        Tracer& tracer = *tracers_[i];
        tracer.finish();
        const double rate = double(shares[i]) / std::max(seconds_since(start), 1e-6);
        // Small launches are dominated by overhead and must not make the next ones smaller still.
        tracer.pace = std::max(0.5 * (tracer.pace + rate), rate);
    }
    return launched;
}

}  // namespace triad
