// What tells of the program: help, manual, launcher, and the version that all of them say.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include "cli/command_line.h"
#include "cli/option_text.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;

namespace {

const fs::path root = TRIAD_SOURCE_DIR;

/// The program as main() makes it, which parses nothing.
struct Told {
    Told() { triad::add_commands(app, exit); }
    CLI::App app{"", "triad"};
    triad::Exit exit{};
};

std::string without_escapes(const std::string& page) {
    return std::regex_replace(page, std::regex(R"(\\-)"), "-");
}

}  // namespace

TEST(Manual, is_a_page_that_man_shows_without_a_complaint) {
    if (std::system("command -v mandoc >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "mandoc is not installed (Debian: mandoc)";
    const triad::TemporaryFolder folder;
    for (const std::string program : {"triad", "triad-replay"}) {
        const std::string page = (folder / (program + ".1")).string();
        ASSERT_EQ(run_triad("manual " + program + " >" + page).exit, 0);
        const Outcome lint = run_program("mandoc", "-T lint -W warning " + page);
        EXPECT_EQ(lint.exit, 0) << lint.output;
        EXPECT_EQ(lint.output, "");
        const Outcome shown = run_program("mandoc", "-T ascii " + page);
        // What is bold or underlined is typed twice.
        const std::string plain = std::regex_replace(shown.output, std::regex(".\b"), "");
        EXPECT_NE(plain.find("--kernels DIR"), std::string::npos) << program;
    }
}

TEST(Manual, has_every_option_of_every_command) {
    const std::string page = without_escapes(run_triad("manual").output);
    const Told told;
    for (const CLI::App* command : triad::with_commands(told.app)) {
        const std::string heading = triad::path_in_program(*command);
        std::string upper = heading;
        for (char& c : upper) c = char(std::toupper(static_cast<unsigned char>(c)));
        const auto at = page.find("\n.SH " + (heading.empty() ? "OPTIONS" : upper) + "\n");
        ASSERT_NE(at, std::string::npos) << heading;
        const std::string section = page.substr(at, page.find("\n.SH ", at + 1) - at);
        for (const triad::OptionText& option : triad::options_of(*command))
            EXPECT_NE(section.find(option.names.back()), std::string::npos) << heading << option.names.back();
    }
}

TEST(Help, of_a_command_is_what_its_option_prints) {
    for (const std::string command : {"render", "bench error", "check"})
        EXPECT_EQ(run_triad("help " + command).output, run_triad(command + " --help").output);
    EXPECT_EQ(run_triad("help").output, run_triad("--help").output);
    const Outcome wrong = run_triad("help rendr");
    EXPECT_EQ(wrong.exit, 1);
    EXPECT_NE(wrong.output.find("Did you mean render?"), std::string::npos) << wrong.output;
    EXPECT_NE(run_triad("help bench eror").output.find("triad bench has no command eror"), std::string::npos);
}

TEST(Help, is_grouped_and_a_hundred_columns_wide) {
    const std::string help = run_triad("render --help").output;
    for (const char* group : {"\nOutput:\n", "\nSamples:\n", "\nView:\n", "\nScene:\n", "\nMachine:\n",
                              "\nCommon:\n", "\nPaths and photons:\n"})
        EXPECT_NE(help.find(group), std::string::npos) << group;
    EXPECT_EQ(help.find("\nOptions:\n"), std::string::npos) << "options without a group";
    const Told told;
    for (const CLI::App* command : triad::with_commands(told.app)) {
        std::istringstream lines(command->help());
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 100u) << line;
            EXPECT_EQ(line.find(" in ["), std::string::npos) << line;
        }
    }
}

TEST(Help, of_a_view_says_what_a_view_does) {
    const std::string help = run_triad("view --help").output;
    EXPECT_EQ(help.find("default 64"), std::string::npos);
    for (const char* refused : {"--pixel", "--samples", "--denoise"})
        EXPECT_EQ(help.find(refused), std::string::npos) << refused;
    EXPECT_NE(run_triad("profile --help").output.find("default 8"), std::string::npos);
    EXPECT_EQ(run_triad("view --pixel 1,1").exit, 1) << "what help does not show is refused with a sentence";
}

TEST(Help, of_the_launcher_needs_no_build) {
    const triad::TemporaryFolder folder;
    fs::create_directory(folder / "docs");
    fs::copy(root / "triad", folder / "triad");
    fs::copy(root / "docs/command-line.md", folder / "docs/command-line.md");
    const Told told;
    for (const std::string words : {"", "--help", "-h", "help"}) {
        // What would build is not there.
        const Outcome outcome = run_program((folder / "triad").string(), words);
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        EXPECT_NE(outcome.output.find("./triad test [LABEL...]"), std::string::npos) << outcome.output;
        for (const CLI::App* command : triad::commands_of(told.app))
            EXPECT_NE(outcome.output.find("  triad " + command->get_name()), std::string::npos)
                << command->get_name() << " is not in the table of docs/command-line.md\n"
                << outcome.output;
    }
    EXPECT_FALSE(fs::exists(folder / "build"));
}

TEST(Version, is_the_same_wherever_it_is_said) {
    EXPECT_EQ(run_triad("--version").output, "triad " TRIAD_VERSION "\n");
    EXPECT_EQ(run_triad("-V").output, "triad " TRIAD_VERSION "\n");
    EXPECT_EQ(run_program(TRIAD_REPLAY, "-V").output, "triad-replay " TRIAD_VERSION "\n");
    EXPECT_NE(bytes_of(root / "CITATION.cff").find("\nversion: " TRIAD_VERSION "\n"), std::string::npos);
    // What is newest stands first, here and in the release notes.
    for (const char* file : {"CHANGELOG.md", "docs/releases.md"}) {
        std::smatch heading;
        const std::string text = bytes_of(root / file);
        ASSERT_TRUE(std::regex_search(text, heading, std::regex(R"(\n## ([0-9.]+))"))) << file;
        EXPECT_EQ(heading[1], TRIAD_VERSION) << file;
    }
}

namespace {

std::vector<fs::path> pages() {
    std::vector<fs::path> all{root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md"};
    for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
        if (entry.path().extension() == ".md") all.push_back(entry.path());
    return all;
}

/// What `#...` may name in a page: its headings, as sites that show them make anchors of them.
std::set<std::string> anchors_of(const std::string& page) {
    std::set<std::string> anchors;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] != '#') continue;
        std::string anchor;
        for (const char c : line.substr(std::min(line.size(), line.find_first_not_of("# "))))
            if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
                anchor += char(std::tolower(static_cast<unsigned char>(c)));
            else if (c == ' ')
                anchor += '-';
        anchors.insert(anchor);
    }
    return anchors;
}

}  // namespace

TEST(Manual, every_link_leads_somewhere) {
    static const std::regex link(R"(\]\(([^)\s#]*)(?:#([^)\s]*))?\))");
    std::size_t links = 0;
    for (const fs::path& page : pages()) {
        const std::string text = bytes_of(page);
        for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
            const std::string path = (*at)[1], anchor = (*at)[2];
            if (path.find("://") != std::string::npos) continue;
            const fs::path to = path.empty() ? page : (page.parent_path() / path).lexically_normal();
            ++links;
            EXPECT_TRUE(fs::exists(to)) << page << " links to " << path;
            if (!anchor.empty() && to.extension() == ".md" && fs::exists(to)) {
                EXPECT_TRUE(anchors_of(bytes_of(to)).count(anchor))
                    << page << " links to " << path << "#" << anchor;
            }
        }
    }
    EXPECT_GT(links, 200u);
}

TEST(Manual, every_page_is_in_its_contents) {
    const std::string contents = bytes_of(root / "docs/README.md");
    for (const auto& entry : fs::directory_iterator(root / "docs")) {
        const std::string name = entry.path().filename();
        if (entry.path().extension() != ".md" || name == "README.md") continue;
        EXPECT_NE(contents.find("](" + name + ")"), std::string::npos) << name;
    }
}
