#pragma once
/// What the subcommands share on the command line. Bad values throw Error(usage) that names option and value.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/math.h"
#include "scene/film.h"

namespace triad {

enum class BvhFormat;
enum class PathDriverKind;

/// One subcommand: adds itself to `app`; when it was chosen, parsing runs it and sets `exit`.
void add_render(CLI::App& app, Exit& exit);
void add_info(CLI::App& app, Exit& exit);
void add_devices(CLI::App& app, Exit& exit);
void add_tune(CLI::App& app, Exit& exit);
void add_check(CLI::App& app, Exit& exit);
void add_merge(CLI::App& app, Exit& exit);
void add_resolve(CLI::App& app, Exit& exit);
void add_compare(CLI::App& app, Exit& exit);
void add_panel(CLI::App& app, Exit& exit);
void add_bench(CLI::App& app, Exit& exit);
void add_profile(CLI::App& app, Exit& exit);
void add_capture(CLI::App& app, Exit& exit);
void add_view(CLI::App& app, Exit& exit);
/// What tells of the program that `app` is.
void add_help(CLI::App& app);
void add_manual(CLI::App& app);
void add_completion(CLI::App& app);

/// --format NAME
CLI::Option* add_format(CLI::App& command, std::optional<BvhFormat>& format);
/// --driver.
CLI::Option* add_path_driver(CLI::App& command, std::optional<PathDriverKind>& driver);
/// --max-texture; none: auto.
CLI::Option* add_max_texture(CLI::App& command, std::optional<unsigned>& texels);
/// Every subcommand, with what all have: -q, -v, --max-memory and --help.
void add_commands(CLI::App& app, Exit& exit);

/// For options: a number from lo to hi. (CLI11's own ranges take "nan" for one within.)
CLI::Validator number_within(double lo, double hi);

/// "640x480"; both at least 1 and at most 65536.
uvec2 parse_size(const std::string& option, const std::string& value);
/// "A:B", half-open, A < B.
SampleRange parse_range(const std::string& option, const std::string& value);
/// "512M", "4G", "1.5T": powers of 1024.
std::uint64_t parse_bytes(const std::string& option, const std::string& value);
/// "share:I/K", I from 0 and below K.
std::array<unsigned, 2> parse_share(const std::string& option, const std::string& value);
/// Exactly `count` finite numbers with commas between.
std::vector<double> parse_numbers(const std::string& option, const std::string& value, std::size_t count);
/// "X,Y,W,H" in whole pixels, up to 65536 each.
std::array<unsigned, 4> parse_crop(const std::string& option, const std::string& value);
/// "#RRGGBB" in sRGB, returned linear.
vec3 parse_colour(const std::string& option, const std::string& value);

}  // namespace triad
