// Whatever is rebuilt inside, the films of today have the arrays of yesterday, bit for bit: those of
// film_hashes.txt. Renewed on purpose by tests/image/update.
#include <gtest/gtest.h>
#include <cstdio>

#include <cstdlib>
#include <cstring>
#include <sstream>

#include "../device/device_fixture.h"
#include "../program.h"
#include "../unit/temporary_folder.h"
#include "film_table.h"
#include "io/io.h"
#include "kept_options.h"
#include "render/renderer.h"
#include "session/prepare.h"

namespace triad {

void PrintTo(const FilmCase& c, std::ostream* out) { *out << c.options; }

namespace {

const FilmTable& table() {
    static const FilmTable loaded = load_film_table();
    return loaded;
}

/// "device, version" without the device, which is the machine's processor and decides no bit.
std::string version_of(const std::string& driver) { return driver.substr(driver.rfind(", ") + 2); }

void run(const std::string& arguments) {
    const Outcome outcome = run_triad(arguments);
    if (outcome.exit != 0)
        throw std::runtime_error("triad " + arguments + " ended with " + std::to_string(outcome.exit) + ": " +
                                 outcome.output);
}

/// The film that the program writes with these options, and `more`.
Film film_of(const FilmCase& c, const std::string& more = {}) {
    const TemporaryFolder folder;
    const std::string film = "'" + (folder / "film").string() + "'";
    const char* device = std::getenv("TRIAD_TEST_DEVICE");
    const std::string how =
        " -q --progress none" + more + (device ? " --device '" + std::string(device) + "'" : std::string());
    std::istringstream parts(with_folders(c.options));
    std::string common, part, merged;
    std::getline(parts, common, '|');
    while (std::getline(parts, part, '|')) {
        merged += " " + film + std::to_string(merged.size());
        run("render " + common + part + how + " --film" + merged.substr(merged.rfind(' ')));
    }
    if (merged.empty())
        run("render " + common + how + " --film " + film);
    else
        run("merge" + merged + " -o " + film);
    return load_film(folder / "film");
}

/// The reason why a driver may rightly give other films than the table's.
std::string other_driver(const Film& film) {
    const std::string& driver = film.devices.at(0);
    if (version_of(driver) == version_of(table().driver)) return {};
    return film_table_file.string() + " is for " + table().driver + ", this is " + driver +
           ": another compiler may round otherwise.";
}

class FilmHashes : public testing::TestWithParam<FilmCase> {};

TEST_P(FilmHashes, are_those_of_the_table) {
    FilmCase c = GetParam();
    if (const auto reason = why_not(c.options)) GTEST_SKIP() << *reason;
    const Film film = film_of(c);
    const ArrayHashes found = hashes_of(film);
    const std::string differs = differences(found, c.expected);
    if (renewing()) {
        if (differs.empty() && film.devices.at(0) == table().driver) return;
        if (!differs.empty()) std::printf("    %s: other %s\n", c.name.c_str(), differs.c_str());
        c.expected = found;
        return renew(c, film.devices.at(0));
    }
    if (const std::string reason = other_driver(film); !reason.empty()) GTEST_SKIP() << reason;
    EXPECT_EQ(differs, "") << c.name << " (" << c.options << "); the table is of " << table().driver
                           << ", this film of " << film.devices.at(0);
}

INSTANTIATE_TEST_SUITE_P(Table, FilmHashes, testing::ValuesIn(table().cases),
                         [](const auto& info) { return info.param.name; });

/// Ways to the same film: another format of nodes, another driver of paths. The tables' films are those of
/// bvh8 and mega.
struct OtherWay {
    FilmCase film;
    std::string name, options;
};
void PrintTo(const OtherWay& w, std::ostream* out) { *out << w.film.options << w.options; }

class FilmHashesOfOtherWays : public testing::TestWithParam<OtherWay> {};

TEST_P(FilmHashesOfOtherWays, are_those_of_the_table) {
    const OtherWay& way = GetParam();
    if (const auto reason = why_not(way.film.options)) GTEST_SKIP() << *reason;
    const Film film = film_of(way.film, way.options);
    if (const std::string reason = other_driver(film); !reason.empty()) GTEST_SKIP() << reason;
    EXPECT_EQ(differences(hashes_of(film), way.film.expected), "")
        << way.film.name << " (" << way.film.options << way.options << ")";
}

/// Every step-th film of the table, twice as many by other drivers of paths, from another one on for each
/// way.
std::vector<OtherWay> other_ways(std::size_t step) {
    std::vector<OtherWay> ways;
    const std::pair<const char*, const char*> all[] = {{"bvh4", " --format bvh4"},
                                                       {"wave", " --driver wave"},
                                                       {"gpu", " --format bvh4 --driver wave-stages"}};
    for (std::size_t w = 0; w < std::size(all); ++w)
        for (std::size_t i = step == 1 ? 0 : w; i < table().cases.size(); i += w == 0 ? step : (step + 1) / 2)
            ways.push_back({table().cases[i], all[w].first, all[w].second});
    return ways;
}

std::string name_of_way(const testing::TestParamInfo<OtherWay>& info) {
    return info.param.film.name + "_" + info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Some, FilmHashesOfOtherWays, testing::ValuesIn(other_ways(16)), name_of_way);
// All of them take three times as long as the table, nearly all of it compilers' time: the label long has
// them.
INSTANTIATE_TEST_SUITE_P(DISABLED_All, FilmHashesOfOtherWays, testing::ValuesIn(other_ways(1)), name_of_way);

/// The same film, in several pieces on a device that allocates little.
Film film_in_bands(const FilmCase& c) {
    const RenderRequest options = scene_options(c.name, c.options);
    Device small = limited_device(smallest_allocation);
    const Scene loaded = load_scene(options);
    Renderer renderer(small, loaded, settings_of(options, loaded));
    renderer.render_until({.samples = {0, 9}, .adaptive = c.name.ends_with("adaptive")},
                          [](const Progress&) { return true; });
    return renderer.film();
}

TEST(FilmHashesInBands, are_those_of_films_in_one_piece) {
    unsigned cases = 0;
    for (const FilmCase& c : load_film_table().cases) {
        if (!c.name.starts_with("large_")) continue;
        const Film film = film_in_bands(c);
        ASSERT_GT(film.sums.size() * sizeof film.sums[0], 2 * smallest_allocation)
            << c.name << " fits in one or two bands";
        if (const std::string reason = other_driver(film); !reason.empty()) GTEST_SKIP() << reason;
        EXPECT_EQ(differences(hashes_of(film), c.expected), "") << c.name;
        ++cases;
    }
    EXPECT_EQ(cases, 4u);
}

}  // namespace
}  // namespace triad
