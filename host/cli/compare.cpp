// triad compare: how far two pictures are apart, and an exit code for scripts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>

#include "base/check_outputs.h"
#include "cli/command_line.h"
#include "cli/compare_perceived.h"
#include "cli/error_map.h"
#include "cli/option_kinds.h"
#include "io/io.h"
#include "metric/flip.h"
#include "metric/image_metrics.h"
#include "report/report.h"
#include "session/metadata.h"
#include "session/output.h"

namespace triad {
namespace {

struct CompareOptions {
    std::string picture, reference, json;
    std::vector<std::string> metrics;
    std::optional<double> max_rmse, max_relmse, max_mae, max_flip, min_psnr;
    PerceivedOptions perceived;
};

/// Picture and reference.
struct Compared {
    unsigned width = 0, height = 0;
    std::array<std::vector<float>, 2> values;  ///< of the channels that both have, one after the other
    std::array<RgbImage, 2> display;           ///< display-linear; empty where R, G or B is missing
};

template <double (*metric)(std::span<const float>, std::span<const float>)>
double of_values(const Compared& c) {
    return metric(c.values[0], c.values[1]);
}

struct Metric {
    const char* name;
    double (*of)(const Compared&);
    std::optional<double> CompareOptions::*limit;
    bool more_is_better;
};
constexpr Metric metrics[] = {
    {"rmse", of_values<rmse>, &CompareOptions::max_rmse, false},
    {"relmse", of_values<relmse>, &CompareOptions::max_relmse, false},
    {"mae", of_values<mean_absolute_error>, &CompareOptions::max_mae, false},
    {"psnr", [](const Compared& c) { return psnr(c.values[0], c.values[1]); }, &CompareOptions::min_psnr,
     true},
    {"flip", [](const Compared& c) { return mean_flip(flip_map(c.display[0], c.display[1])); },
     &CompareOptions::max_flip, false}};

/// R, G and B (and A when both have it), or every channel that both have when there is no R; one after the
/// other.
Compared read(const CompareOptions& o) {
    const Picture a = read_picture(o.picture), b = read_picture(o.reference);
    refuse_for_panel(o.picture, a.metadata, "compare");
    refuse_for_panel(o.reference, b.metadata, "compare");
    auto size = [](const Picture& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); };
    if (a.width != b.width || a.height != b.height)
        throw Error(Exit::comparison, "The pictures differ in size: " + o.picture + " is " + size(a) + ", " +
                                          o.reference + " is " + size(b) + ".");
    Compared compared{a.width, a.height, {}, {}};
    auto& values = compared.values;
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
    compared.display = {display_of(a), display_of(b)};
    return compared;
}

/// The metric pixel by pixel: what its number is the mean of, over the channels; of rmse and psnr the root.
std::vector<float> map_of(const std::string& metric, const Compared& c) {
    if (metric == "flip") return flip_map(c.display[0], c.display[1]);
    const std::size_t pixels = std::size_t(c.width) * c.height, channels = c.values[0].size() / pixels;
    std::vector<float> map(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        double sum = 0;
        for (std::size_t i = p; i < c.values[0].size(); i += pixels) {
            const double x = c.values[0][i], r = c.values[1][i], d = x - r;
            sum += metric == "mae" ? std::abs(d) : metric == "relmse" ? d * d / (r * r + 0.01) : d * d;
        }
        sum /= double(channels);
        map[p] = float(metric == "rmse" || metric == "psnr" ? std::sqrt(sum) : sum);
    }
    return map;
}

/// Of two pictures that differ in size, unlike all others.
Exit run_perceived(const CompareOptions& o) {
    if (o.metrics.size() > 1 || o.max_rmse || o.max_relmse || o.max_mae || o.max_flip || o.min_psnr)
        throw Error(
            Exit::usage,
            "perceived compares a picture with one of many samples per pixel, the other metrics pictures of "
            "one size: ask for them apart.");
    std::string failures;
    Json row = compare_perceived(o.picture, o.reference, o.perceived, o.json != "-", failures);
    row["passed"] = failures.empty();
    if (!o.json.empty()) write_report(o.json, "compare", nullptr, Json::array({row}));
    if (!failures.empty())
        throw Error(Exit::comparison, failures + "Pictures: " + o.picture + ", " + o.reference + ".");
    return Exit::done;
}

Exit run(const CompareOptions& o) {
    for (const std::string& path : o.perceived.maps) check_error_map(path);
    std::vector<std::string> outputs = o.perceived.maps;
    outputs.push_back(o.json);
    check_outputs(outputs, {o.picture, o.reference, o.perceived.panel});
    const auto& m = o.metrics;
    if (std::find(m.begin(), m.end(), "perceived") != m.end() || o.perceived.limit) return run_perceived(o);
    if (!o.perceived.panel.empty() || o.perceived.ppd || !o.perceived.eyes.empty())
        throw Error(Exit::usage, "--panel, --ppd and --eye go with --metric perceived.");
    const Compared compared = read(o);
    const auto& [picture, reference] = compared.values;
    const bool coloured = !compared.display[0].rgb.empty() && !compared.display[1].rgb.empty();
    std::size_t not_finite = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
        not_finite += !std::isfinite(picture[i]) || !std::isfinite(reference[i]);
    Json row = {{"picture", o.picture}, {"reference", o.reference}};
    std::string failures;
    for (const Metric& metric : metrics) {
        const std::optional<double> limit = o.*metric.limit;
        const bool named = std::find(o.metrics.begin(), o.metrics.end(), metric.name) != o.metrics.end();
        if (!o.metrics.empty() && !named && !limit) continue;
        if (metric.limit == &CompareOptions::max_flip && !coloured) {
            if (named || limit) throw Error(Exit::comparison, "FLIP needs pictures with R, G and B.");
            continue;
        }
        const double value = metric.of(compared);
        if (o.metrics.empty() || named) {
            if (o.json != "-") std::printf("%-7s %.6g\n", metric.name, value);
            row[metric.name] = value;
        }
        // Written so that NaN fails.
        if (limit && !(metric.more_is_better ? value >= *limit : value <= *limit)) {
            char text[160];
            std::snprintf(text, sizeof text, "%s is %.6g, %s %.6g was allowed. ", metric.name, value,
                          metric.more_is_better ? "at least" : "at most", *limit);
            failures += text;
        }
    }
    const std::string mapped = o.metrics.empty() ? "rmse" : o.metrics.front();
    for (const std::string& path : o.perceived.maps)
        write_error_map(path, compared.width, compared.height, map_of(mapped, compared), {},
                        {{"triad:metric", mapped}});
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
    command->add_option("REFERENCE", o->reference, "The same size; of perceived: larger")
        ->required()
        ->type_name("");
    add_word_list(*command, "--metric", "What is measured (default: all but perceived)",
                  {"rmse", "relmse", "mae", "psnr", "flip", "perceived"}, o->metrics);
    command->add_option("--max-rmse", o->max_rmse, "Exit 7 above this")
        ->check(number_within(0, 1e30))
        ->type_name("X");
    command->add_option("--max-relmse", o->max_relmse, "Exit 7 above this")
        ->check(number_within(0, 1e30))
        ->type_name("X");
    command->add_option("--max-mae", o->max_mae, "Exit 7 above this")
        ->check(number_within(0, 1e30))
        ->type_name("X");
    command->add_option("--max-flip", o->max_flip, "Exit 7 above this")
        ->check(number_within(0, 1e30))
        ->type_name("X");
    command->add_option("--min-psnr", o->min_psnr, "Exit 7 below this")
        ->check(number_within(-1e3, 1e3))
        ->type_name("X");
    command
        ->add_option(
            "--map", o->perceived.maps,
            "Where the first metric (rmse by default; perceived: the first eye) sees the difference, .exr "
            "or .png; several allowed")
        ->allow_extra_args(false)
        ->type_name("FILE");
    declare_perceived(*command, o->perceived);
    add_json(*command, o->json, "Write the numbers");
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
