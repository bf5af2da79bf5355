#include "bench/kernel_bench.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <random>

#include "bench/feature_scenes.h"
#include "bench/kernel_bench_cases.h"
#include "pack/pack.h"
#include "trace/device_scene.h"

namespace triad {
namespace {

/// Long enough for a clock, and that waking a sleeping worker does not count.
constexpr double shortest_run = 4e-3;

std::vector<float> inputs(std::uint32_t items) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<float> values(std::size_t(kernel_bench_inputs) * items);
    for (float& v : values) v = std::min(unit(generator), 1 - 0x1p-24f);
    std::normal_distribution<float> normal;
    for (const unsigned first : {4u, 7u})
        for (std::uint32_t i = 0; i < items; ++i) {
            vec3 d(normal(generator), normal(generator), normal(generator));
            d = glm::normalize(d);
            if (first == 4) d.z = std::max(std::abs(d.z), 1e-3f);
            for (unsigned axis = 0; axis < 3; ++axis)
                values[std::size_t(first + axis) * items + i] = d[int(axis)];
        }
    return values;
}

/// A case on the device, ready to be run in every shape.
class Measured {
  public:
    Measured(Device& device, const KernelBenchCase& c, const FeatureScene& s, const Buffer& in,
             const KernelBenchPlan& plan)
        : name(c.name), device_(device), items_(plan.items), shapes_(plan.shapes) {
        const PackedScene packed = pack(s.scene, s.settings);
        out_ = device.allocate(sizeof(float) * kernel_bench_outputs * items_);
        arguments_.add(scene_arguments(device, packed, s.settings))
            .add(in)
            .add(out_)
            .add(std::uint32_t(packed.triangles.size()))
            .add(items_);
        const auto compiled = [&](const char* item_lanes, unsigned run) {
            Options options = options_of(features_of(packed, s.settings));
            options["TRIAD_ITEM_LANES"] = item_lanes;
            options["TRIAD_RUN"] = std::to_string(run);
            return device.build_source(c.name + ".cl", kernel_bench_source(c), options).kernel("measured");
        };
        const std::vector<float> expected = values(compiled("1", 1), {1, 1});
        check(expected);
        for (const KernelBenchShape& shape : shapes_) {
            kernels_.push_back(compiled("0", shape.run));
            compare(shape, values(kernels_.back(), shape), expected);
            const double each = seconds(kernels_.back(), shape, 1);
            launches_.push_back(unsigned(std::clamp(shortest_run / each, 1.0, 1000.0)));
        }
    }

    double ns_per_item(std::size_t shape) {
        return seconds(kernels_[shape], shapes_[shape], launches_[shape]) * 1e9 /
               (double(launches_[shape]) * items_);
    }

    std::string name;

  private:
    void launch(const Kernel& kernel, const KernelBenchShape& shape) {
        device_.run(kernel, arguments_, (items_ + shape.run - 1) / shape.run, shape.local_size);
    }

    std::vector<float> values(const Kernel& kernel, const KernelBenchShape& shape) {
        device_.fill_zero(out_);
        launch(kernel, shape);
        return device_.download<float>(out_);
    }

    void check(const std::vector<float>& values) const {
        const auto finite = [](float v) { return std::isfinite(v); };
        const auto same = [&](float v) { return v == values[0]; };
        if (!std::all_of(values.begin(), values.end(), finite) ||
            std::all_of(values.begin(), values.end(), same))
            throw Error(Exit::comparison, name +
                                              " computes values that are not finite, or nothing at all, on " +
                                              device_.info().name + "; triad check says more.");
    }

    /// Throws where the bits are not those of lanes within an item.
    void compare(const KernelBenchShape& shape, const std::vector<float>& found,
                 const std::vector<float>& expected) const {
        for (std::size_t k = 0; k < found.size(); ++k)
            if (std::bit_cast<std::uint32_t>(found[k]) != std::bit_cast<std::uint32_t>(expected[k]))
                throw Error(Exit::comparison,
                            name + " computes another value in work-groups of " +
                                std::to_string(shape.local_size) + " with " + std::to_string(shape.run) +
                                " items each: output " + std::to_string(k / items_) + " of item " +
                                std::to_string(k % items_) + " is " + std::to_string(found[k]) + " and not " +
                                std::to_string(expected[k]) +
                                ". The driver vectorises it wrongly; triad check says more.");
    }

    double seconds(const Kernel& kernel, const KernelBenchShape& shape, unsigned launches) {
        const auto start = std::chrono::steady_clock::now();
        for (unsigned i = 0; i < launches; ++i) launch(kernel, shape);
        device_.finish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    Device& device_;
    std::uint32_t items_;
    std::vector<KernelBenchShape> shapes_;
    Buffer out_;
    Arguments arguments_;
    std::vector<Kernel> kernels_;  ///< one for each shape
    std::vector<unsigned> launches_;
};

}  // namespace

std::vector<KernelSpeed> measure_kernels(Device& device, const KernelBenchPlan& plan,
                                         const std::string& filter) {
    const std::vector<FeatureCase> scenes = feature_cases(64);
    const Buffer in = device.upload(inputs(plan.items));
    std::vector<Measured> kernels;
    for (const KernelBenchCase& c : kernel_bench_cases()) {
        if (c.name.find(filter) == std::string::npos) continue;
        const auto scene = std::find_if(scenes.begin(), scenes.end(),
                                        [&](const FeatureCase& s) { return s.feature.name == c.feature; });
        kernels.emplace_back(device, c, scene->with, in, plan);
    }
    const std::size_t shapes = plan.shapes.size();
    std::vector<std::vector<double>> times(kernels.size() * shapes);
    for (unsigned round = 0; round < plan.rounds; ++round)
        for (std::size_t n = 0; n < times.size(); ++n) {
            const std::size_t k = round % 2 ? times.size() - 1 - n : n;  // who comes first may gain by it
            times[k].push_back(kernels[k / shapes].ns_per_item(k % shapes));
        }
    std::vector<KernelSpeed> rows;
    for (std::size_t k = 0; k < times.size(); ++k)
        rows.push_back(
            {kernels[k / shapes].name, plan.items, plan.shapes[k % shapes], median_estimate(times[k])});
    return rows;
}

}  // namespace triad
