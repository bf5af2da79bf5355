// What a shell offers after Tab: asked of the shells themselves.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "cli/command_line.h"
#include "cli/option_text.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
    Lines lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

bool has_program(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

class Completion : public testing::Test {
  protected:
    /// The completions of a shell as a file, and beside it two files and a folder.
    std::string source(const std::string& shell) {
        EXPECT_EQ(run_triad("completion " + shell + " >" + path("completions")).exit, 0);
        std::ofstream(path("a room.glb")) << "";
        std::filesystem::create_directory(folder_ / "abode");
        return path("completions");
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// What bash answers to each line: its words with blanks between; a last blank begins another word.
    Lines bash(const Lines& asked) {
        std::ofstream script(path("questions.sh"));
        script << "cd '" << path("") << "' && source '" << source("bash") << R"('
ask() {
    local IFS=' '
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    local answers; answers=$(complete -p "$1") && answers=${answers#complete -F } && ${answers%% *}
    printf '%s|' "${COMPREPLY[@]}"
    echo
}
)";
        for (const std::string& line : asked) {
            script << "ask";
            std::string words = line;
            for (const std::string& word : CLI::detail::split(words, ' ')) script << " '" << word << "'";
            script << (line.ends_with(' ') ? " ''\n" : "\n");
        }
        script.close();
        const Outcome outcome = run_program("bash", "--norc " + path("questions.sh"));
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        return lines_of(outcome.output);
    }

    triad::TemporaryFolder folder_;
};

}  // namespace

TEST_F(Completion, bash_knows_commands_options_words_and_files) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"triad ren", "render|"},
        {"triad bench er", "error|"},
        {"triad bench --ag", "--against|"},
        {"triad render --ton", "--tonemap|"},
        {"triad render --tonemap ", "none|aces|agx|khronos|"},
        {"triad render --tonemap a", "aces|agx|"},
        {"triad render --tonemap = k", "khronos|"},
        {"triad render --tonemap =", "none|aces|agx|khronos|"},
        {"triad render --spp ", "|"},
        {"triad render --adaptive o", "on|off|"},
        {"triad compare x.exr y.exr --metric rmse,fl", "rmse,flip|"},
        {"triad render a", "abode|a room.glb|"},
        {"triad render --kernels a", "abode|"},
        {"triad render --env a", "abode|a room.glb|"},
        {"triad check --driver wave-", "wave-stages|"},
        {"triad render bench er", "|"},
        {"triad help be", "bench|"},
        {"triad completion z", "zsh|"},
        {"triad-replay --verif", "--verify|"},
        {"triad-replay --verify f", "film|"}};
    Lines asked;
    for (const auto& [line, answer] : cases) asked.push_back(line);
    const Lines answers = bash(asked);
    ASSERT_EQ(answers.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        // Files come in the order of the folder.
        const auto set = [](const std::string& text) {
            const auto words = CLI::detail::split(text, '|');
            return std::set<std::string>(words.begin(), words.end());
        };
        EXPECT_EQ(set(answers[i]), set(cases[i].second)) << cases[i].first;
    }
}

TEST_F(Completion, bash_knows_every_option_of_every_command) {
    CLI::App app("", "triad");
    triad::Exit exit{};
    triad::add_commands(app, exit);
    Lines asked, expected;
    for (const CLI::App* command : triad::with_commands(app))
        for (const triad::OptionText& option : triad::options_of(*command)) {
            if (!option.is_named) continue;
            asked.push_back(triad::program_and_path(*command) + " " + option.names.back());
            expected.push_back(option.names.back() + "|");
        }
    EXPECT_GT(asked.size(), 250u);
    const Lines answers = bash(asked);
    ASSERT_EQ(answers.size(), asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i)
        EXPECT_NE(("|" + answers[i]).find("|" + expected[i]), std::string::npos)
            << asked[i] << ": " << answers[i];
}

TEST_F(Completion, fish_knows_commands_options_words_and_files) {
    if (!has_program("fish")) GTEST_SKIP() << "fish is not installed (Debian: fish)";
    const std::string begin = "cd " + path("") + "; source " + source("fish") + "; complete -C '";
    const auto ask = [&](const std::string& line) {
        const Outcome outcome =
            run_program("fish", "--no-config -c \"" + begin + line + "'\"", "HOME=" + path("") + " exec");
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        std::string first;
        for (const std::string& answer : lines_of(outcome.output))
            first += answer.substr(0, answer.find('\t')) + "|";
        std::erase(first, '\\');  // which some versions write in front of blanks
        return first;
    };
    EXPECT_EQ(ask("triad ren"), "render|");
    EXPECT_EQ(ask("triad bench er"), "error|");
    EXPECT_EQ(ask("triad render --ton"), "--tonemap|");
    EXPECT_EQ(ask("triad render --tonemap ag"), "agx|");
    EXPECT_EQ(ask("triad render --tonemap=ag"), "--tonemap=agx|");
    EXPECT_EQ(ask("triad compare --metric rmse,fl"), "rmse,flip|");
    EXPECT_EQ(ask("triad render --kernels ab"), "abode/|");
    EXPECT_EQ(ask("triad render a"), "a room.glb|abode/|");
    EXPECT_EQ(ask("triad check a"), "") << "no file stands there";
    EXPECT_EQ(ask("triad completion z"), "zsh|");
    EXPECT_EQ(ask("triad-replay --verify fi"), "film|");
}

TEST_F(Completion, zsh_completes_what_is_typed) {
    if (!has_program("zsh")) GTEST_SKIP() << "zsh is not installed (Debian: zsh)";
    // A terminal of its own: keys are typed, and ^X writes what the line has become.
    std::ofstream(path("ask.zsh")) << R"(
zmodload zsh/zpty
folder=$1 shown=$1/shown
shift
await() { for ((i = 0; i < 600; ++i)); do (($(wc -l <$shown) >= $1)) && break; sleep .05; done }
touch $shown
zpty z "zsh -f -i"
zpty -w z "PS1=; cd $folder; autoload -U compinit; compinit -u -D; source $folder/completions"
zpty -w z "show() { print -r -- \"\$BUFFER\" >>$shown; BUFFER=; }; zle -N show; bindkey '^X' show"
zpty -w z "bindkey '^I' complete-word; echo ready >>$shown"
await 1
for line; do
    zpty -w -n z "$line"$'\t\x18'
    await $((++asked + 1))
done
zpty -d z
tail -n +2 $shown
)";
    source("zsh");
    const std::vector<std::pair<std::string, std::string>> cases{
        {"triad ren", "triad render "},
        {"triad bench er", "triad bench error "},
        {"triad render --ton", "triad render --tonemap="},
        {"triad render --tonemap=kh", "triad render --tonemap=khronos "},
        {"triad render --kernels=ab", "triad render --kernels=abode/"},
        {"triad render a\\ ", "triad render a\\ room.glb "},
        {"triad compare --metric=fl", "triad compare --metric=flip,"},
        {"triad completion z", "triad completion zsh "},
        {"triad-replay --verify=fi", "triad-replay --verify=film "}};
    std::string arguments = path("ask.zsh") + " " + folder_.path().string();
    for (const auto& [line, answer] : cases) arguments += " '" + line + "'";
    const Outcome outcome = run_program("zsh", "-f " + arguments);
    const Lines answers = lines_of(outcome.output);
    ASSERT_EQ(answers.size(), cases.size()) << outcome.output;
    for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_EQ(answers[i], cases[i].second);
}
