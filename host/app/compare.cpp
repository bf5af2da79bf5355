// triad compare: how far two pictures are apart, and an exit code for scripts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>

#include "app/command_line.h"
#include "app/report.h"
#include "io/io.h"
#include "measure/image_metrics.h"

namespace triad {
namespace {

struct CompareOptions {
    std::string picture, reference, json;
    std::vector<std::string> metrics;
    std::optional<double> max_rmse, max_relmse, max_mae, min_psnr;
};

struct Metric {
    const char* name;
    double (*of)(std::span<const float>, std::span<const float>);
    std::optional<double> CompareOptions::*limit;
    bool more_is_better;
};
constexpr Metric metrics[] = {
    {"rmse", rmse, &CompareOptions::max_rmse, false},
    {"relmse", relmse, &CompareOptions::max_relmse, false},
    {"mae", mean_absolute_error, &CompareOptions::max_mae, false},
    {"psnr", [](std::span<const float> a, std::span<const float> b) { return psnr(a, b); },
     &CompareOptions::min_psnr, true}};

/// R, G and B (and A when both have it), or every channel that both have when there is no R; one after the
/// other.
std::array<std::vector<float>, 2> values_of(const CompareOptions& o) {
    const Picture a = read_picture(o.picture), b = read_picture(o.reference);
    auto size = [](const Picture& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); };
    if (a.width != b.width || a.height != b.height)
        throw Error(Exit::comparison, "The pictures differ in size: " + o.picture + " is " + size(a) + ", " +
                                          o.reference + " is " + size(b) + ".");
    std::array<std::vector<float>, 2> values;
    for (const Channel& channel : a.channels) {
        const bool beauty =
            channel.name == "R" || channel.name == "G" || channel.name == "B" || channel.name == "A";
        const Channel* other = b.find(channel.name);
        if (!other || (a.find("R") && !beauty)) continue;
        values[0].insert(values[0].end(), channel.values.begin(), channel.values.end());
        values[1].insert(values[1].end(), other->values.begin(), other->values.end());
    }
    if (values[0].empty())
        throw Error(Exit::comparison,
                    "The pictures " + o.picture + " and " + o.reference + " have no channel in common.");
    return values;
}

Exit run(const CompareOptions& o) {
    const auto [picture, reference] = values_of(o);
    std::size_t not_finite = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
        not_finite += !std::isfinite(picture[i]) || !std::isfinite(reference[i]);
    Json row = {{"picture", o.picture}, {"reference", o.reference}};
    std::string failures;
    for (const Metric& metric : metrics) {
        const double value = metric.of(picture, reference);
        if (o.metrics.empty() ||
            std::find(o.metrics.begin(), o.metrics.end(), metric.name) != o.metrics.end()) {
            if (o.json != "-") std::printf("%-7s %.6g\n", metric.name, value);
            row[metric.name] = value;
        }
        const std::optional<double> limit = o.*metric.limit;
        // Written so that NaN fails.
        if (limit && !(metric.more_is_better ? value >= *limit : value <= *limit)) {
            char text[160];
            std::snprintf(text, sizeof text, "%s is %.6g, %s %.6g was allowed. ", metric.name, value,
                          metric.more_is_better ? "at least" : "at most", *limit);
            failures += text;
        }
    }
    if (not_finite) std::fprintf(stderr, "triad: %zu values are not finite\n", not_finite);
    row["not_finite"] = not_finite;
    row["passed"] = failures.empty();
    if (!o.json.empty()) write_report(o.json, "compare", nullptr, Json::array({row}));
    if (!failures.empty())
        throw Error(Exit::comparison,
                    failures + "Picture: " + o.picture + ", reference: " + o.reference + ".");
    return Exit::done;
}

}  // namespace

void add_compare(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "Measure how far a picture is from a reference");
    command->add_option("PICTURE", o->picture, "EXR, HDR, PNG or JPEG")->required()->type_name("");
    command->add_option("REFERENCE", o->reference, "The same size")->required()->type_name("");
    command->add_option("--metric", o->metrics, "rmse, relmse, mae, psnr (default: all)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember({"rmse", "relmse", "mae", "psnr"}))
        ->type_name("LIST");
    command->add_option("--max-rmse", o->max_rmse, "Exit 7 above this")->type_name("X");
    command->add_option("--max-relmse", o->max_relmse, "Exit 7 above this")->type_name("X");
    command->add_option("--max-mae", o->max_mae, "Exit 7 above this")->type_name("X");
    command->add_option("--min-psnr", o->min_psnr, "Exit 7 below this")->type_name("X");
    command->add_option("--json", o->json, "Write the numbers as JSON (-: standard output)")
        ->type_name("FILE");
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
