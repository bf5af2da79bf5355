// triad merge: joins partial renders. Films are sums of integers, so that the order of the parts does not
// matter.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/check_outputs.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/progress.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "report/report.h"
#include "session/metadata.h"
#include "session/output.h"

namespace triad {
namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output, json;
    std::uint64_t expected_spp = 0;
};

/// Pictures are no films; one that was made for a panel is refused for that.
void require_film(const std::string& path) {
    if (!is_film(path) && is_picture(path)) refuse_for_panel(path, read_picture(path).metadata, "merge");
}

/// A film that is replaced must be no loss: all that it holds is in the parts. What is there and is no film
/// that can be read holds nothing.
void require_no_loss(const std::string& output, const std::vector<std::string>& parts) {
    if (!is_file(output) || !is_film(output)) return;
    std::optional<Film> there;
    try {
        there = load_film_header(output);
    } catch (const Error&) {
        return;
    }
    std::vector<SampleRange> held;
    for (const std::string& part : parts) {
        std::error_code failed;
        if (std::filesystem::equivalent(part, output, failed)) return;
        const Film film = load_film_header(part);
        if (film.settings == there->settings && film.scene == there->scene)
            held.insert(held.end(), film.ranges.begin(), film.ranges.end());
    }
    std::sort(held.begin(), held.end(),
              [](const SampleRange& a, const SampleRange& b) { return a.begin < b.begin; });
    bool is_loss = there->progress.has_value();
    for (const SampleRange& range : there->ranges) {
        std::uint64_t until = range.begin;
        for (const SampleRange& part : held)
            if (part.begin <= until) until = std::max(until, part.end);
        is_loss = is_loss || until < range.end;
    }
    if (is_loss)
        throw Error(Exit::usage, "The film " + output +
                                     " is there already, and holds what these films do not: merge it in, "
                                     "remove it, or name another output.");
}

Exit run(const MergeOptions& o) {
    check_outputs({o.output, o.json}, o.parts);
    for (const std::string& part : o.parts) require_film(part);
    require_no_loss(o.output, o.parts);
    const MergedFilm merged = merge_films({o.parts.begin(), o.parts.end()}, o.output);
    const Film& whole = merged.film;
    const std::uint64_t end = o.expected_spp         ? o.expected_spp
                              : whole.ranges.empty() ? 0
                                                     : whole.ranges.back().end;
    const std::vector<SampleRange> missing = holes(whole, end);
    inform(o.output + ": " + spp_text(double(whole.sample_count())) + " samples per pixel from " +
           std::to_string(o.parts.size()) + " films");
    if (!o.json.empty()) {
        Json gaps = Json::array();
        for (const SampleRange& hole : missing) gaps.push_back({hole.begin, hole.end});
        write_report(o.json, "merge", nullptr,
                     {{{"film", o.output},
                       {"parts", o.parts.size()},
                       {"spp", whole.sample_count()},
                       {"relmse", merged.relmse},
                       {"holes", gaps}}});
    }
    if (missing.empty()) return Exit::done;
    std::string sentence =
        o.output + " was written but is incomplete; render these samples and merge them in:";
    for (const SampleRange& hole : missing)
        sentence += " --samples " + std::to_string(hole.begin) + ":" + std::to_string(hole.end);
    throw Error(Exit::incomplete, sentence);
}

}  // namespace

void add_merge(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<MergeOptions>();
    CLI::App* command =
        app.add_subcommand("merge", "Join films of ranges of samples (render --film --samples) into one");
    command->add_option("PART", o->parts, "Film files, in any order")->required()->type_name("");
    command->add_option("-o,--output", o->output, "The joined film")
        ->required()
        ->allow_extra_args(false)
        ->type_name("FILM");
    command
        ->add_option("--expect-spp", o->expected_spp,
                     "Exit 6 and name the holes unless samples 0 to N are all there")
        ->check(whole_number_within(1, 0xffffffff))
        ->type_name("N");
    add_json(*command, o->json, "Write what was merged");
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
