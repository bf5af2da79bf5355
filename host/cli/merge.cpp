// triad merge: joins partial renders. Films are sums of integers, so that the order of the parts does not
// matter.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

/// Ranges of all parts that are of the film's picture.
std::vector<SampleRange> held_of(const Film& film, const std::vector<Film>& parts) {
    std::vector<SampleRange> held;
    for (const Film& part : parts)
        if (part.settings == film.settings && part.scene == film.scene)
            held.insert(held.end(), part.ranges.begin(), part.ranges.end());
    std::sort(held.begin(), held.end(),
              [](const SampleRange& a, const SampleRange& b) { return a.begin < b.begin; });
    return held;
}

/// Whether the film holds anything that the parts do not.
bool holds_more(const Film& film, const std::vector<Film>& parts) {
    if (film.progress || !film.is_even()) return true;
    if (film.has_guides &&
        std::none_of(parts.begin(), parts.end(), [](const Film& p) { return p.has_guides; }))
        return true;
    const std::vector<SampleRange> held = held_of(film, parts);
    for (const SampleRange& range : film.ranges) {
        std::uint64_t until = range.begin;
        for (const SampleRange& part : held)
            if (part.begin <= until) until = std::max(until, part.end);
        if (until < range.end) return true;
    }
    return false;
}

/// A film that is replaced must be no loss. What is there and is no film that can be read holds nothing.
void require_no_loss(const std::string& output, const std::vector<std::string>& parts) {
    if (!is_file(output)) return;
    std::optional<Film> there;
    try {
        if (!is_film(output)) return;
        there = load_film(output);
    } catch (const Error&) {
        return;
    }
    std::vector<Film> headers;
    for (const std::string& part : parts) headers.push_back(load_film_header(part));
    if (holds_more(*there, headers))
        throw Error(Exit::usage, "The film " + output +
                                     " is there already, and holds what these films do not. Name another "
                                     "output, or remove it.");
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
