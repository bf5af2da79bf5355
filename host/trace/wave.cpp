#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "trace/path_driver.h"
#include "trace/program.h"

namespace triad {
namespace {

/// Words of a slot at most: of PathState, Hit and PendingLight.
constexpr std::size_t path_words = 80, hit_words = 6, light_words = 19;

std::size_t from_env(const char* name, std::size_t value) {
    const char* text = std::getenv(name);
    return text ? std::size_t(std::atol(text)) : value;
}

/// Of the trees that paths search: programs unroll that.
std::uint32_t levels_of(const PackedScene& packed) {
    return std::max({1u, packed.light_shape.levels, packed.environment.rows.levels});
}

class Wave : public PathDriver {
  public:
    Wave(const DeviceScene& scene, const RenderSettings& settings, const Features& features)
        : device_(scene.device()), slots_(from_env("WAVE_SLOTS", 4096)), run_(from_env("WAVE_RUN", 256)),
          trace_run_(from_env("WAVE_TRACE_RUN", 64)) {
        Options options = options_of(features);
        options["PATH_POOL_SLOTS"] = std::to_string(slots_ + 16);
        options["TRIAD_RUN"] = std::to_string(trace_run_);
        const Program trace = device_.build(program_of(settings, "wave_trace"), options);
        options["TRIAD_RUN"] = std::to_string(run_);
        options["TRIAD_CDF_LEVELS"] = std::to_string(levels_of(scene.packed()));
        const Program shade = device_.build(program_of(settings, "wave_shade"), options);
        trace_edges_ = trace.kernel("trace_edges");
        trace_shadows_ = trace.kernel("trace_shadows");
        shade_vertices_ = shade.kernel("shade_vertices");
        end_paths_ = shade.kernel("end_paths");
        start_paths_ = shade.kernel("start_paths");
        const auto words = [&](std::size_t n) { return device_.allocate_array<std::uint32_t>(n * (slots_ + 16)); };
        paths_ = words(path_words), hits_ = words(hit_words), pending_ = words(light_words);
        states_ = words(1), pixels_ = words(1), taken_ = words(1);
        progress_ = device_.allocate_array<std::uint32_t>(2);
    }

    void trace(const Arguments& scene, const dev::TracePathsArguments& work) override {
        const auto slots = std::uint32_t(slots_);
        const auto with = [&](const auto& arguments) {
            return Arguments(scene).add(arguments_of(arguments));
        };
        device_.fill_zero(states_);
        device_.fill_zero(progress_);
        last_ = std::chrono::steady_clock::now();
        const auto round = [&] {
            dev::EndPathsArguments end;
#define TRIAD_COPY(type, name) end.name = work.name;
            TRACE_PATHS_LIST(TRIAD_COPY, TRIAD_COPY, TRIAD_COPY, TRIAD_COPY)
#undef TRIAD_COPY
            end.states = states_, end.path_count = slots;
            end.paths = paths_;
            end.pixels = pixels_, end.taken = taken_, end.progress = progress_;
            shade(end_paths_, with(end));
            lap(0);
            shade(start_paths_, with(dev::StartPathsArguments{.states = states_, .paths = paths_,
                                                   .path_count = slots,
                                                   
                                                   .pixels = pixels_,
                                                   .taken = taken_,
                                                   .work = work.work,
                                                   .first_work = work.first_work,
                                                   .first_sample_low = work.first_sample_low,
                                                   .first_sample_high = work.first_sample_high}));
            lap(1);
            tracing(trace_edges_, with(dev::TraceEdgesArguments{
                                                                    .states = states_, .paths = paths_,
                                                                    .path_count = slots,
                                                                    .hits = hits_,
                                                                    .counters = work.counters}));
            lap(2);
            shade(shade_vertices_, with(dev::ShadeVerticesArguments{
                                                                          .states = states_, .paths = paths_,
                                                                          .path_count = slots,
                                                                          .hits = hits_,
                                                                          
                                                                          .pending = pending_}));
            lap(3);
            tracing(trace_shadows_, with(dev::TraceShadowsArguments{
                                                                        .states = states_, .paths = paths_,
                                                                        .path_count = slots,
                                                                        .pending = pending_,
                                                                        .counters = work.counters}));
            lap(4);
            ++rounds_;
        };
        do {
            for (int k = 0; k < 2; ++k) {
                round(), round();
            }
        } while (device_.download<std::uint32_t>(progress_)[1] < slots);
    }

    std::uint64_t bytes() const override {
        return paths_.bytes() + hits_.bytes() + pending_.bytes() + states_.bytes() + pixels_.bytes() +
               taken_.bytes();
    }

    ~Wave() override {
        if (!lap_) return;
        for (int k = 0; k < 5; ++k)
            std::fprintf(stderr, "stage %d: %.3f s, %.1f ns per slot\n", k, laps_[k],
                         laps_[k] * 1e9 / (double(rounds_) * double(slots_)));
        std::fprintf(stderr, "%zu rounds\n", rounds_);
    }

  private:
    bool lap_ = std::getenv("WAVE_LAPS");
    double laps_[5] = {};
    std::size_t rounds_ = 0;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    void lap(int k) {
        if (!lap_) return;
        device_.finish();
        const auto now = std::chrono::steady_clock::now();
        laps_[k] += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }
    Device& device_;
    std::size_t slots_, run_, trace_run_;
    Kernel trace_edges_, trace_shadows_, shade_vertices_, end_paths_, start_paths_;
    DeviceArray<std::uint32_t> paths_, hits_, pending_, states_, pixels_, taken_, progress_;

    void tracing(const Kernel& kernel, const Arguments& arguments) {
        device_.run(kernel, arguments, (slots_ + trace_run_ - 1) / trace_run_, trace_run_ > 1 ? 1 : 0);
    }
    void shade(const Kernel& kernel, const Arguments& arguments) {
        device_.run(kernel, arguments, (slots_ + run_ - 1) / run_, 1);
    }
};

}  // namespace

std::unique_ptr<PathDriver> make_wave(const DeviceScene& scene, const RenderSettings& settings,
                                      const Features& features) {
    return std::make_unique<Wave>(scene, settings, features);
}

}  // namespace triad
