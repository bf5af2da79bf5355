#include "cli/command_line.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "base/colour.h"
#include "base/log.h"
#include "base/memory_limit.h"
#include "bvh/bvh.h"
#include "cli/option_kinds.h"
#include "cli/option_text.h"
#include "scene/limits.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

[[noreturn]] void bad(const std::string& option, const std::string& value, const std::string& expected) {
    throw Error(Exit::usage, option + " " + (value.empty() ? "''" : value) + ": expected " + expected + ".");
}

/// The whole of `text` as a number, or nothing.
template <class T>
std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

CLI::Option* add_format(CLI::App& command, std::optional<BvhFormat>& format) {
    return add_parsed(
        command, "--format", "bvh8|bvh4",
        "Nodes that rays walk: eight boxes at once (CPUs), or small and scalar ones (GPUs). Pictures "
        "are the same bit for bit (default: what suits the device)",
        [&format](const std::string& name) {
            format = find_bvh_format(name);
            if (!format) bad("--format", name, "bvh8 or bvh4");
        });
}

CLI::Option* add_path_driver(CLI::App& command, std::optional<PathDriverKind>& driver) {
    return add_parsed(
        command, "--driver", "auto|mega|wave|wave-stages",
        "How paths are followed: mega: each to its end; wave: pools of paths stage by stage, in one "
        "launch (CPUs); wave-stages: a launch per stage (GPUs); auto, the default: what triad tune "
        "found fastest on the device, and where it was not run mega, on GPUs wave-stages. Pictures "
        "are the same bit for bit",
        [&driver](const std::string& name) {
            driver = find_path_driver(name);
            if (!driver && name != "auto") bad("--driver", name, "auto, mega, wave or wave-stages");
        });
}

CLI::Option* add_max_texture(CLI::App& command, std::optional<unsigned>& texels) {
    return add_parsed(
        command, "--max-texture", "N|auto",
        "Reduce larger images of the scene to N texels on their longer side (default auto: only "
        "where they would not fit the memory)",
        [&texels](const std::string& text) {
            texels = number<unsigned>(text);
            if (text != "auto" && (!texels || *texels < 1 || *texels > 65536))
                bad("--max-texture", text, "auto, or texels from 1 to 65536");
        });
}

namespace {

/// Of the command and its own commands.
void add_common(CLI::App& command) {
    for (CLI::App* sub : command.get_subcommands(nullptr))
        if (!sub->get_name().empty()) add_common(*sub);  // the others are groups of options
    const char* const group = "Common";
    command
        .add_flag_callback(
            "-q,--quiet", [] { set_log_level(0); }, "Errors only")
        ->group(group);
    command
        .add_flag_callback(
            "-v,--verbose", [] { set_log_level(2); }, "Say more")
        ->group(group);
    add_parsed(
        command, "--max-memory", "SIZE",
        "Take no more than this on host and devices together, like 4G (default: half of the machine's)",
        [](const std::string& text) { set_memory_limit(parse_bytes("--max-memory", text)); })
        ->group(group);
    command.set_help_flag("-h,--help", "Show this help")->group(group);
}

}  // namespace

void add_commands(CLI::App& app, Exit& exit) {
    app.formatter(std::make_shared<HelpFormatter>());
    add_render(app, exit);
    add_view(app, exit);
    add_info(app, exit);
    add_merge(app, exit);
    add_resolve(app, exit);
    add_compare(app, exit);
    add_panel(app, exit);
    add_devices(app, exit);
    add_tune(app, exit);
    add_check(app, exit);
    add_bench(app, exit);
    add_profile(app, exit);
    add_capture(app, exit);
    add_help(app);
    add_manual(app);
    add_completion(app);
    for (CLI::App* command : app.get_subcommands(nullptr)) add_common(*command);
    refuse_empty_values(app);
    hide_ranges(app);
}

CLI::Validator number_within(double lo, double hi) {
    const std::string range = limits::text_of(lo) + " to " + limits::text_of(hi);
    return CLI::Validator(
        [=](const std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= lo && value <= hi;
            return good ? std::string() : "expected a number from " + range + ", not " + text;
        },
        range);
}

uvec2 parse_size(const std::string& option, const std::string& value) {
    const auto x = value.find('x');
    const auto width = number<unsigned>(std::string_view(value).substr(0, x));
    const auto height =
        x == std::string::npos ? std::nullopt : number<unsigned>(std::string_view(value).substr(x + 1));
    if (!width || !height) bad(option, value, "WIDTHxHEIGHT, like 1280x720");
    if (std::min(*width, *height) < 1 || std::max(*width, *height) > 65536)
        bad(option, value, "numbers from 1 to 65536");
    return {*width, *height};
}

SampleRange parse_range(const std::string& option, const std::string& value) {
    const auto colon = value.find(':');
    const auto begin = number<std::uint64_t>(std::string_view(value).substr(0, colon));
    const auto end = colon == std::string::npos
                         ? std::nullopt
                         : number<std::uint64_t>(std::string_view(value).substr(colon + 1));
    if (!begin || !end || *begin >= *end) bad(option, value, "A:B with A below B, like 0:64");
    return {*begin, *end};
}

std::uint64_t parse_bytes(const std::string& option, const std::string& value) {
    const std::string units = "KMGT";
    const std::size_t end = value.find_first_not_of("0123456789.");
    const auto size = number<double>(std::string_view(value).substr(0, end));
    std::string unit = end == std::string::npos ? "" : value.substr(end);
    const std::size_t power = unit.empty() ? 0 : units.find(char(std::toupper(unit[0]))) + 1;
    const bool is_unit =
        unit.empty() || (power > 0 && (unit.size() == 1 || unit.substr(1) == "B" || unit.substr(1) == "iB"));
    if (!size || !is_unit || *size <= 0 || *size * std::pow(1024.0, double(power)) > 1e18)
        bad(option, value, "a size like 512M or 4G");
    return std::uint64_t(*size * std::pow(1024.0, double(power)));
}

std::array<unsigned, 2> parse_share(const std::string& option, const std::string& value) {
    const std::string_view of = std::string_view(value).substr(value.find(':') + 1);
    const auto slash = of.find('/');
    const auto i = number<unsigned>(of.substr(0, slash)),
               k = slash == of.npos ? std::nullopt : number<unsigned>(of.substr(slash + 1));
    if (!i || !k || *i >= *k) bad(option, value, "share:I/K with I from 0 and below K, like share:0/4");
    return {*i, *k};
}

std::vector<double> parse_numbers(const std::string& option, const std::string& value, std::size_t count) {
    std::vector<double> numbers;
    for (std::string_view rest = value;;) {
        const auto comma = rest.find(',');
        const auto one = number<double>(rest.substr(0, comma));
        if (!one || !std::isfinite(*one))
            bad(option, value, std::to_string(count) + " numbers with commas between");
        numbers.push_back(*one);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (numbers.size() != count) bad(option, value, std::to_string(count) + " numbers with commas between");
    return numbers;
}

std::array<unsigned, 4> parse_crop(const std::string& option, const std::string& value) {
    const std::vector<double> n = parse_numbers(option, value, 4);
    for (const double x : n)
        if (x < 0 || x > 65536 || x != std::floor(x)) bad(option, value, "whole pixels");
    return {unsigned(n[0]), unsigned(n[1]), unsigned(n[2]), unsigned(n[3])};
}

vec3 parse_colour(const std::string& option, const std::string& value) {
    unsigned rgb = 0;
    const auto [end, error] = std::from_chars(value.data() + 1, value.data() + value.size(), rgb, 16);
    if (value.size() != 7 || value[0] != '#' || error != std::errc() || end != value.data() + 7)
        bad(option, value, "a colour like #336699");
    vec3 linear;
    for (int c = 0; c < 3; ++c) {
        const double v = (rgb >> (16 - 8 * c) & 255) / 255.0;
        linear[c] = static_cast<float>(srgb_decode(v));
    }
    return linear;
}

}  // namespace triad
