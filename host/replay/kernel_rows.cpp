#include "replay/kernel_rows.h"

#include <algorithm>
#include <numeric>

#include "base/text.h"

namespace triad {
namespace {

/// Of sorted values, between two of them where it lies there.
double quantile(const std::vector<double>& sorted, double q) {
    const double at = q * double(sorted.size() - 1);
    const std::size_t below = std::size_t(at), above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - double(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::vector<LaunchRow> kernel_rows(const std::map<std::string, std::uint64_t>& items,
                                   const std::map<std::string, std::vector<double>>& seconds, unsigned runs) {
    std::vector<LaunchRow> rows;
    double all = 0;
    for (const auto& [kernel, each] : seconds) {
        if (each.empty()) continue;
        std::vector<double> sorted = each;
        std::sort(sorted.begin(), sorted.end());
        const double total = std::accumulate(each.begin(), each.end(), 0.0) / runs;
        const auto found = items.find(kernel);
        const std::uint64_t n = found == items.end() ? 0 : found->second;
        rows.push_back({kernel, each.size() / runs, n, 1e3 * quantile(sorted, 0.5),
                        1e3 * quantile(sorted, 0.95), 1e3 * total, 0, total > 0 ? double(n) / total : 0});
        all += total;
    }
    for (LaunchRow& row : rows) row.share = all > 0 ? row.ms_total / (1e3 * all) : 0;
    std::sort(rows.begin(), rows.end(),
              [](const LaunchRow& a, const LaunchRow& b) { return a.ms_total > b.ms_total; });
    return rows;
}

Json to_json(const std::vector<LaunchRow>& rows) {
    Json all = Json::array();
    for (const LaunchRow& row : rows)
        all.push_back({{"kernel", row.kernel},
                       {"launches", row.launches},
                       {"items", row.items},
                       {"ms_median", row.ms_median},
                       {"ms_p95", row.ms_p95},
                       {"ms_total", row.ms_total},
                       {"share", row.share},
                       {"items_per_s", row.items_per_s}});
    return all;
}

std::string table_text(const std::vector<LaunchRow>& rows) {
    std::string text = format("%-24s %8s %12s %11s %11s %11s %7s %12s\n", "kernel", "launches", "items",
                              "median ms", "p95 ms", "total ms", "share", "items/s");
    for (const LaunchRow& row : rows)
        text += format("%-24s %8zu %12llu %11.4f %11.4f %11.3f %6.1f%% %12.4g\n", row.kernel.c_str(),
                       row.launches, static_cast<unsigned long long>(row.items), row.ms_median, row.ms_p95,
                       row.ms_total, 100 * row.share, row.items_per_s);
    return text;
}

}  // namespace triad
