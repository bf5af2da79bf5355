#include "profile/device_peaks.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "base/files.h"
#include "base/log.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* schema = "triad.peaks/1";

/// Vectors of eight: on a CPU the lanes of one item, on a GPU eight instructions that do not wait for each
/// other. `block` and `step`: items read one after the other (CPUs) or side by side (GPUs).
constexpr const char* kernels = R"cl(
kernel void peak_fma(global float* out, float a, float b, uint rounds, uint items) {
    if (get_global_id(0) >= items) return;
    const float8 start = (float8)((float)get_global_id(0)) * (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
    float8 x0 = start, x1 = start + 1.0f, x2 = start + 2.0f, x3 = start + 3.0f;
    float8 x4 = start + 4.0f, x5 = start + 5.0f, x6 = start + 6.0f, x7 = start + 7.0f;
    const float8 va = (float8)(a), vb = (float8)(b);
    for (uint i = 0u; i < rounds; ++i) {
        x0 = fma(x0, va, vb), x1 = fma(x1, va, vb), x2 = fma(x2, va, vb), x3 = fma(x3, va, vb);
        x4 = fma(x4, va, vb), x5 = fma(x5, va, vb), x6 = fma(x6, va, vb), x7 = fma(x7, va, vb);
    }
    const float8 s = x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7;
    out[get_global_id(0)] = s.s0 + s.s1 + s.s2 + s.s3 + s.s4 + s.s5 + s.s6 + s.s7;
}
kernel void peak_read(global const float8* in, global float* out, uint block, uint step, uint count, uint rounds, uint items) {
    if (get_global_id(0) >= items) return;
    float8 a = (float8)(0.0f), b = a, c = a, d = a;
    for (uint r = 0u; r < rounds; ++r) {
        global const float8* p = in + (size_t)get_global_id(0) * block;
        for (uint k = 0u; k < count; k += 4u, p += 4u * step)
            a += p[0], b += p[step], c += p[2u * step], d += p[3u * step];
    }
    const float8 s = a + b + c + d;
    out[get_global_id(0)] = s.s0 + s.s1 + s.s2 + s.s3 + s.s4 + s.s5 + s.s6 + s.s7;
}
kernel void peak_copy(global const float8* in, global float8* out, uint block, uint step, uint count, uint rounds, uint items) {
    if (get_global_id(0) >= items) return;
    for (uint r = 0u; r < rounds; ++r) {
        const size_t first = (size_t)get_global_id(0) * block;
        for (uint k = 0u; k < count; ++k) out[first + (size_t)k * step] = in[first + (size_t)k * step];
    }
}
kernel void peak_gather(global const uint* next, global uint* out, uint lines, uint rounds, uint items) {
    if (get_global_id(0) >= items) return;
    uint at = (uint)(get_global_id(0) * 2654435761u) % lines * 16u;
    for (uint i = 0u; i < rounds; ++i) at = next[at];
    out[get_global_id(0)] = at;
}
)cl";

constexpr std::size_t vector_bytes = 32, line_bytes = 64;
constexpr double launch_goal = 0.02;  ///< seconds
constexpr unsigned launches = 3;
/// Some drivers stamp the events of all launches with the same time: the host's clock then tells.
constexpr double least_share_of_events = 0.01;

class Peaks {
  public:
    explicit Peaks(Device& device)
        : device_(device),
          program_(device.build_source("peaks.cl", kernels)),
          items_(items_of(device.info())) {
        out_ = device.allocate(items_ * sizeof(float));
    }

    double flops() {
        constexpr double of_a_round = 8 * 8 * 2;
        const Kernel kernel = program_.kernel("peak_fma");
        return best_rate(double(items_) * of_a_round, [&](std::uint32_t rounds) {
            device_.run(kernel, Arguments().add(out_).add(0.999f).add(0.001f).add(rounds).add(items()),
                        items_);
        });
    }

    MemoryPeak memory(std::uint64_t bytes) {
        MemoryPeak peak;
        peak.bytes = bytes;
        const std::uint32_t count = std::uint32_t(bytes / vector_bytes / items_ / 4 * 4);
        const Buffer from = device_.allocate(bytes), to = device_.allocate(bytes);
        device_.fill_zero(from), device_.fill_zero(to);
        const Kernel read = program_.kernel("peak_read"), copy = program_.kernel("peak_copy");
        const double touched = double(items_) * count * vector_bytes;
        for (const auto& [block, step] : {std::pair(count, 1u), {1u, std::uint32_t(items_)}}) {
            const auto ways = [&, b = block, s = step](Arguments a, std::uint32_t rounds) {
                return a.add(b).add(s).add(count).add(rounds).add(items());
            };
            peak.read = std::max(peak.read, best_rate(touched, [&](std::uint32_t rounds) {
                                     device_.run(read, ways(Arguments().add(from).add(out_), rounds), items_);
                                 }));
            peak.copy = std::max(peak.copy, best_rate(2 * touched, [&](std::uint32_t rounds) {
                                     device_.run(copy, ways(Arguments().add(from).add(to), rounds), items_);
                                 }));
        }
        peak.gathers = gathers(from);
        return peak;
    }

  private:
    Device& device_;
    Program program_;
    std::size_t items_;
    Buffer out_;

    std::uint32_t items() const {
        return std::uint32_t(items_);
    }  ///< launches have more, up to a whole group

    /// Enough to fill the device, and few enough for the smallest data.
    static std::size_t items_of(const DeviceInfo& info) {
        const std::size_t of_a_unit = info.type == "cpu" ? 8 : 256;
        return std::min<std::size_t>(1 << 14, of_a_unit * std::max(1u, info.compute_units));
    }

    /// Work per second; `work`: of one round of a launch.
    double best_rate(double work, const std::function<void(std::uint32_t)>& launch) {
        const auto seconds = [&](std::uint32_t rounds) {
            device_.finish();
            const auto start = std::chrono::steady_clock::now();
            launch(rounds);
            const DeviceCommand& ended = device_.commands().back();
            const double by_host =
                             std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                         by_event = 1e-9 * double(ended.end - ended.start);
            return by_event > least_share_of_events * by_host ? by_event : by_host;
        };
        seconds(1);  // some drivers compile at launches
        std::uint32_t rounds = 1;
        double took = seconds(rounds);
        while (took < launch_goal && rounds < 1u << 30) {
            rounds = std::uint32_t(
                std::min(1e9, rounds * std::clamp(1.2 * launch_goal / std::max(took, 1e-7), 2.0, 64.0)));
            took = seconds(rounds);
        }
        for (unsigned i = 1; i < launches; ++i) took = std::min(took, seconds(rounds));
        return work * rounds / took;
    }

    /// A walk over all lines of the memory in an order that nothing can foresee (Sattolo's shuffle: one
    /// cycle).
    double gathers(const Buffer& memory) {
        const std::size_t lines = memory.bytes() / line_bytes;
        std::vector<std::uint32_t> order(lines);
        for (std::size_t i = 0; i < lines; ++i) order[i] = std::uint32_t(i);
        std::mt19937 random(1);
        for (std::size_t i = lines - 1; i > 0; --i) std::swap(order[i], order[random() % i]);
        std::vector<std::uint32_t> words(memory.bytes() / sizeof(std::uint32_t));
        constexpr std::size_t stride = line_bytes / sizeof(std::uint32_t);
        for (std::size_t i = 0; i < lines; ++i) words[i * stride] = std::uint32_t(order[i] * stride);
        device_.write(memory, words.data(), memory.bytes());
        const Kernel kernel = program_.kernel("peak_gather");
        return best_rate(double(items_), [&](std::uint32_t rounds) {
            device_.run(kernel,
                        Arguments().add(memory).add(out_).add(std::uint32_t(lines)).add(rounds).add(items()),
                        items_);
        });
    }
};

nlohmann::json to_json(const DevicePeaks& peaks) {
    nlohmann::json memory = nlohmann::json::array();
    for (const MemoryPeak& m : peaks.memory)
        memory.push_back({{"bytes", m.bytes}, {"read", m.read}, {"copy", m.copy}, {"gathers", m.gathers}});
    return {{"schema", schema}, {"flops", peaks.flops}, {"memory", memory}};
}

/// None: nothing is kept, or it is damaged.
DevicePeaks kept_at(const fs::path& path) {
    DevicePeaks peaks;
    std::ifstream file(path);
    if (path.empty() || !file) return peaks;
    try {
        const auto json = nlohmann::json::parse(file);
        if (json.at("schema") != schema) return {};
        peaks.flops = json.at("flops");
        for (const auto& m : json.at("memory"))
            peaks.memory.push_back({m.at("bytes"), m.at("read"), m.at("copy"), m.at("gathers")});
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return peaks;
}

}  // namespace

namespace {

/// To what `others` have more of.
void raise(DevicePeaks& peaks, const DevicePeaks& others) {
    peaks.flops = std::max(peaks.flops, others.flops);
    for (MemoryPeak& peak : peaks.memory)
        for (const MemoryPeak& other : others.memory)
            if (other.bytes == peak.bytes)
                peak.read = std::max(peak.read, other.read), peak.copy = std::max(peak.copy, other.copy),
                peak.gathers = std::max(peak.gathers, other.gathers);
}

}  // namespace

DevicePeaks measure_peaks(Device& device) {
    const auto start = std::chrono::steady_clock::now();
    Peaks measured(device);
    DevicePeaks peaks;
    peaks.flops = measured.flops();
    const DeviceInfo& info = device.info();
    const std::uint64_t most = std::min<std::uint64_t>(info.memory ? info.memory / 8 : 1u << 26,
                                                       info.max_allocation ? info.max_allocation : 1u << 26);
    for (std::uint64_t bytes : {1u << 18, 1u << 21, 1u << 24, 1u << 27})
        if (bytes <= most || peaks.memory.empty()) peaks.memory.push_back(measured.memory(bytes));
    peaks.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return peaks;
}

DevicePeaks peaks_of(Device& device) {
    const fs::path path =
        kept_path(device.info(), "peaks", std::to_string(device.info().compute_units) + " units");
    DevicePeaks peaks = measure_peaks(device);
    raise(peaks, kept_at(path));
    if (path.empty()) return peaks;
    try {
        fs::create_directories(path.parent_path());
        write_file(path, to_json(peaks).dump(1) + "\n");
    } catch (const std::exception& error) {
        warn(std::string("The measured peaks are not kept: ") + error.what());
    }
    return peaks;
}

}  // namespace triad
