#include "trace/wave_driver.h"

#include <algorithm>
#include <array>

#include "trace/program.h"

namespace triad {
namespace {

/// Paths under way, pool after pool.
class Pools {
  public:
    /// film_words: floats of each slot, at least 1 in all.
    Pools(Device& device, std::uint32_t count, std::size_t film_words) : device_(device) {
        arguments_.pool_count = count;
        arguments_.states = planes(1), arguments_.pixels = planes(1), arguments_.taken = planes(1);
        arguments_.rays = planes(1);
        arguments_.paths = planes(POOL_PATH_PLANES), arguments_.hits = planes(POOL_HIT_PLANES);
        arguments_.pending = planes(POOL_LIGHT_PLANES);
        arguments_.films =
            device.allocate_array<float>(std::max<std::size_t>(1, count * POOL_SLOTS * film_words));
        bytes_ += arguments_.films.bytes();
        arguments_.next_pixel = device.allocate_array<std::uint32_t>(2);
    }

    std::uint64_t bytes() const { return bytes_; }
    std::uint32_t count() const { return arguments_.pool_count; }
    const dev::TraceWaveArguments& arrays() const { return arguments_; }

    /// Of all paths' slots none is taken. What the kernels take, with so many of the pools.
    Arguments begin(const Arguments& scene, const dev::TracePathsArguments& work, std::uint32_t count) {
        dev::TraceWaveArguments a = arguments_;
#define TRIAD_COPY(type, name) a.name = work.name;
        TRACE_PATHS_LIST(TRIAD_COPY, TRIAD_COPY, TRIAD_COPY, TRIAD_COPY)
#undef TRIAD_COPY
        a.pool_count = count;
        device_.fill_zero(a.next_pixel);
        return Arguments(scene).add(arguments_of(a));
    }

  private:
    Device& device_;
    dev::TraceWaveArguments arguments_;
    std::uint64_t bytes_ = 0;

    /// So many of every pool.
    DeviceArray<std::uint32_t> planes(std::size_t count) {
        const auto array = device_.allocate_array<std::uint32_t>(arguments_.pool_count * count * POOL_PLANE);
        bytes_ += array.bytes();
        return array;
    }
};

/// Of the trees of lights that paths search: where slots are the lanes, the search is unrolled.
std::uint32_t levels_of(const PackedScene& packed) {
    return std::max({1u, packed.light_shape.levels, packed.environment.rows.levels});
}

class Wave : public PathDriver {
  public:
    Wave(const DeviceScene& scene, const RenderSettings& settings, const Features& features)
        : device_(scene.device()), pools_(device_, std::max(1u, device_.info().compute_units), 0) {
        Options options = options_of(features);
        options["TRIAD_CDF_LEVELS"] = std::to_string(levels_of(scene.packed()));
        trace_wave_ = device_.build(program_of(settings, "wave"), options).kernel("trace_wave");
    }

    void trace(const Arguments& scene, const dev::TracePathsArguments& work) override {
        device_.run(trace_wave_, pools_.begin(scene, work, pools_.count()), pools_.count(), 1);
    }
    std::uint64_t bytes() const override { return pools_.bytes(); }

  private:
    Device& device_;
    Pools pools_;
    Kernel trace_wave_;
};

class WaveStages : public PathDriver {
  public:
    WaveStages(const DeviceScene& scene, const RenderSettings& settings, const Features& features)
        : device_(scene.device()),
          pools_(device_, (batch_of(device_) + POOL_SLOTS - 1) / POOL_SLOTS,
                 features.iridescence ? POOL_FILM_WORDS : 0) {
        const Program program = device_.build(program_of(settings, "wave_stages"), options_of(features));
        std::vector<const char*> stages{"wave_end_paths", "wave_start_paths", "wave_intersect_edges",
                                        "wave_meet_surfaces"};
        if (features.iridescence) stages.push_back("wave_average_films");
        if (features.gather) stages.push_back("wave_gather_photons");
        stages.insert(stages.end(), {"wave_connect_paths", "wave_scatter_paths", "wave_intersect_lights"});
        for (const char* stage : stages) stages_.push_back(program.kernel(stage));
    }

    void trace(const Arguments& scene, const dev::TracePathsArguments& work) override {
        finish();
        const std::uint32_t pixels = work.work_count * FILM_TILE_PIXELS;
        const std::uint32_t count = std::min(pools_.count(), (pixels + POOL_SLOTS - 1) / POOL_SLOTS);
        arguments_ = pools_.begin(scene, work, count);
        device_.fill_zero(pools_.arrays().states);
        slots_ = count * POOL_SLOTS;
        rounds_ = 0;
        enqueue(expected_);
    }

    void finish() override {
        while (slots_ > 0) {
            std::array<std::uint32_t, 2> next;
            device_.read(pools_.arrays().next_pixel, next.data(), sizeof next);
            if (next[1] == slots_) {
                if (device_.recorded(pools_.arrays().next_pixel))
                    enqueue(least_rounds);  // elsewhere a path may go on for longer
                slots_ = 0;
                expected_ = std::clamp(rounds_ * 3 / 4, least_rounds, 4 * most_rounds);
            } else {
                enqueue(std::clamp(rounds_ / 4, least_rounds, most_rounds));
            }
        }
    }
    std::uint64_t bytes() const override { return pools_.bytes(); }
    unsigned launches() const override { return 8; }

  private:
    /// Between looks at what is left: looking after every one would leave the device waiting.
    static constexpr std::uint32_t least_rounds = 8, most_rounds = 64;

    Device& device_;
    Pools pools_;
    std::vector<Kernel> stages_;  ///< of a round, in order
    Arguments arguments_;
    std::uint32_t slots_ = 0;   ///< that have work, 0: all is done
    std::uint32_t rounds_ = 0;  ///< that were enqueued for it
    /// Of the next work, by the last: so many are enqueued before the host waits, which other devices need.
    std::uint32_t expected_ = least_rounds;

    void enqueue(std::uint32_t rounds) {
        rounds_ += rounds;
        for (std::uint32_t round = 0; round < rounds; ++round)
            for (const Kernel& stage : stages_) device_.run(stage, arguments_, slots_);
    }
};

}  // namespace

std::unique_ptr<PathDriver> make_wave(const DeviceScene& scene, const RenderSettings& settings,
                                      const Features& features) {
    return std::make_unique<Wave>(scene, settings, features);
}

std::unique_ptr<PathDriver> make_wave_stages(const DeviceScene& scene, const RenderSettings& settings,
                                             const Features& features) {
    return std::make_unique<WaveStages>(scene, settings, features);
}

}  // namespace triad
