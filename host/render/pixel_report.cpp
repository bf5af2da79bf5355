#include "render/pixel_report.h"

#include <algorithm>
#include <cmath>

#include "kernels/types.h"

namespace triad {
namespace {

double sum_of(const dvec3& v) { return v.x + v.y + v.z; }

dvec3 radiance_of(const RecordedPath& path) { return dvec3(path.value); }

bool is_finite(const vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// Sums while paths come in; report() divides.
class Collector {
  public:
    Collector(const std::vector<std::string>& sources, std::size_t keep) : keep_(keep) {
        for (const std::string& name : sources) r_.sources.push_back({name, {}, {}});
    }

    void add(const RecordedPath& path) {
        ++r_.samples;
        r_.rays += path.rays;
        ++r_.half_samples[path.half];
        if (!is_finite(path.value)) {
            ++r_.not_finite;
            return;
        }
        const dvec3 value = radiance_of(path);
        r_.half_means[path.half] += value;
        r_.alpha += path.value.w;
        squares_ += value * value;
        for (const RecordedVertex& v : path.vertices) add(v);
        keep(path);
    }

    PixelReport report() {
        const double n = double(r_.samples);
        if (r_.samples == 0) return r_;
        r_.mean = (r_.half_means[0] + r_.half_means[1]) / n;
        r_.alpha /= n;
        if (r_.samples > 1) r_.variance = max(dvec3(0.0), squares_ / n - r_.mean * r_.mean) * (n / (n - 1));
        const double a = double(r_.half_samples[0]), b = double(r_.half_samples[1]);
        for (int half = 0; half < 2; ++half) r_.half_means[half] /= std::max(1.0, half == 0 ? a : b);
        const dvec3 difference = r_.half_means[0] - r_.half_means[1];
        if (a > 0 && b > 0) r_.mean_variance = difference * difference * (a / n * (b / n));  // docs/film.md
        for (PixelReport::Depth& d : r_.depths) d.found /= n, d.direct /= n;
        for (PixelReport::Source& s : r_.sources) s.found /= n, s.direct /= n;
        std::erase_if(r_.sources, [](const auto& s) { return sum_of(s.found) + sum_of(s.direct) == 0; });
        std::stable_sort(r_.sources.begin(), r_.sources.end(), [](const auto& x, const auto& y) {
            return sum_of(x.found) + sum_of(x.direct) > sum_of(y.found) + sum_of(y.direct);
        });
        return r_;
    }

  private:
    PixelReport r_;
    dvec3 squares_{0.0};
    std::size_t keep_;

    void add(const RecordedVertex& v) {
        const std::size_t k = v.edge - 1;
        const std::size_t edges = k + (v.direct_source == TRIAD_NONE ? 1 : 2);
        if (r_.depths.size() < edges) r_.depths.resize(edges);
        ++r_.depths[k].paths;
        r_.depths[k].found += dvec3(v.found);
        if (v.found_source != TRIAD_NONE) r_.sources[v.found_source].found += dvec3(v.found);
        if (v.direct_source == TRIAD_NONE) return;
        r_.depths[k + 1].direct += dvec3(v.direct);
        r_.sources[v.direct_source].direct += dvec3(v.direct);
    }

    void keep(const RecordedPath& path) {
        const auto larger = [](const RecordedPath& a, const RecordedPath& b) {
            return sum_of(radiance_of(a)) > sum_of(radiance_of(b));
        };
        r_.largest.insert(std::upper_bound(r_.largest.begin(), r_.largest.end(), path, larger), path);
        if (r_.largest.size() > keep_) r_.largest.pop_back();
    }
};

}  // namespace

double PixelReport::share(std::size_t i) const {
    const double whole = sum_of(mean) * double(samples);
    return whole > 0 ? sum_of(radiance_of(largest[i])) / whole : 0.0;
}

PixelReport report_pixel(Renderer& renderer, unsigned x, unsigned y, SampleRange range, std::size_t keep) {
    Collector collector(renderer.packed().light_sources, keep);
    renderer.record_pixel(x, y, range, [&](const RecordedPath& path) { collector.add(path); });
    return collector.report();
}

}  // namespace triad
