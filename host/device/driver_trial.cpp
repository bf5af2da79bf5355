// Drivers are tried in a child process before they are loaded into this one; the verdict is kept.
#include <dlfcn.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/child.h"
#include "base/files.h"
#include "base/log.h"
#include "base/shell_limits.h"
#include "base/temporary_folder.h"
#include "device/drivers.h"
#include "device/opencl.h"

namespace fs = std::filesystem;

namespace triad {
namespace opencl {
namespace {

using Problems = std::vector<PlatformProblem>;

constexpr const char* trial_word = "--try-drivers";  // FILE LIBRARY...: what the child is started with
constexpr const char* survived = "survived";         // the last line of its FILE
constexpr double trial_seconds = 10;                 // a good driver takes .1
constexpr const char* trial_schema = "triad.drivers/1";

/// The child, with the loader's environment as it is to be tried.
[[noreturn]] void be_the_trial(int argc, char** argv) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a driver that hangs would outlive an impatient user
    Problems ignored;
    ask_drivers(ignored);
    std::ofstream answer(argv[2]);
    for (int i = 3; i < argc; ++i)
        if (!::dlopen(argv[i], RTLD_LAZY | RTLD_LOCAL)) answer << i - 3 << ' ' << ::dlerror() << '\n';
    answer << survived << std::endl;
    ::_exit(0);  // what drivers do when they are unloaded is another matter
}

std::string last_line(const fs::path& path) {
    std::ifstream file(path);
    std::string line, last;
    while (std::getline(file, line))
        if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    return last.substr(0, 300);
}

struct Outcome {
    std::string death;                                         ///< empty: the child survived
    std::vector<std::pair<std::size_t, std::string>> missing;  ///< which have no library, and why
};

std::string how_it_ended(const ChildEnd& end, const std::string& said) {
    std::string text = "It ";
    if (end.late)
        text += "was not done after " + std::to_string(static_cast<int>(trial_seconds)) + " s";
    else if (end.signal)
        text += "died of signal " + std::to_string(end.signal) + " (" + ::strsignal(end.signal) + ")";
    else
        text += "ended the process with exit status " + std::to_string(end.exit);
    text += " when it was loaded and asked for its devices";
    return text + (said.empty() ? "." : ", and said: " + said);
}

/// Tries these drivers together: as this process would load them, or alone of all.
Outcome try_together(const std::vector<Icd>& icds, bool alone) {
    const TemporaryFolder folder;
    const fs::path answer = folder.path() / "answer", errors = folder.path() / "errors",
                   vendors = folder.path() / "vendors";
    Child child{.arguments = {"/proc/self/exe", trial_word, answer.string()}, .errors = errors};
    for (const Icd& icd : icds) child.arguments.push_back(icd.library);
    if (alone) {
        fs::create_directory(vendors);
        child.environment = environment_for(icds, vendors);
    }
    child.seconds = trial_seconds;
    const std::optional<ChildEnd> end = run_child(child);
    if (!end) return {};  // nothing can be tried here; loading them is survived too, at a higher price
    Outcome outcome;
    std::ifstream lines(answer);
    std::string line;
    while (std::getline(lines, line) && line != survived) {
        const std::size_t space = line.find(' ');
        outcome.missing.emplace_back(std::stoul(line.substr(0, space)), line.substr(space + 1));
    }
    if (line != survived) outcome.death = how_it_ended(*end, last_line(errors));
    return outcome;
}

std::string no_library(const Icd& icd, const std::string& why) {
    return "Its library " + icd.library + " cannot be loaded (" + why + "). Install it, or remove " +
           (icd.file.empty() ? icd.name : icd.file.string()) + ".";
}

/// Which drivers are bad. All together at first, which is all that good ones cost; then one more at a time.
Problems try_drivers(const std::vector<Icd>& icds) {
    Problems bad;
    const Outcome all = try_together(icds, false);
    if (all.death.empty()) {
        for (const auto& [i, why] : all.missing)
            bad.push_back({icds.at(i).name, no_library(icds.at(i), why)});
        return bad;
    }
    std::vector<Icd> good;
    for (const Icd& icd : icds) {
        good.push_back(icd);
        const Outcome more = try_together(good, true);
        if (more.death.empty() && more.missing.empty()) continue;
        bad.push_back(
            {icd.name, more.death.empty() ? no_library(icd, more.missing.front().second) : more.death});
        good.pop_back();
    }
    return bad;
}

fs::path verdict_path(const std::vector<Icd>& icds) {
    const fs::path cache = cache_folder();
    return cache.empty() ? fs::path{} : cache / "drivers" / (key_of(icds) + ".json");
}

/// What was found earlier. That a driver is bad is believed for a day: its reason may lie outside of it.
std::optional<Problems> load_verdict(const fs::path& path) {
    std::ifstream file(path);
    if (path.empty() || !file) return {};
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object() || json.value("schema", nlohmann::json()) != trial_schema ||
        !json.contains("bad") || !json["bad"].is_array())
        return {};
    Problems bad;
    for (const auto& each : json["bad"]) {
        if (!each.is_object() || !each.contains("icd") || !each.contains("why") || !each["icd"].is_string() ||
            !each["why"].is_string())
            return {};
        bad.push_back({each["icd"], each["why"]});
    }
    if (!bad.empty() && is_older_than_a_day(path)) return {};
    return bad;
}

void keep_verdict(const fs::path& path, const Problems& bad) {
    if (path.empty()) return;
    nlohmann::json json{{"schema", trial_schema}, {"bad", nlohmann::json::array()}};
    for (const auto& [icd, why] : bad) json["bad"].push_back({{"icd", icd}, {"why", why}});
    try {
        fs::create_directories(path.parent_path());
        write_file(path, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const std::exception& error) {
        detail(std::string("The verdict on the OpenCL drivers is not kept: ") + error.what());
    }
}

/// The bad ones among these, from memory where that can be trusted.
Problems bad_ones(const std::vector<Icd>& icds, bool trust_memory) {
    const fs::path path = verdict_path(icds);
    if (trust_memory)
        if (const auto kept = load_verdict(path)) return *kept;
    if (icds.empty() || !restarts_allowed()) return {};
    Problems bad;
    try {
        bad = try_drivers(icds);
    } catch (const Error& error) {  // a full disk, say: no reason not to go on
        detail(std::string("The OpenCL drivers could not be tried first: ") + error.what());
        return {};
    }
    // A verdict that leaves nothing is an error elsewhere. If it were wrong it would be the end of all runs,
    // so it is found each time.
    if (bad.size() == icds.size()) return bad;
    for (const auto& [icd, why] : bad) warn("The OpenCL driver " + icd + " is left out. " + why);
    keep_verdict(path, bad);
    return bad;
}

/// The first call of OpenCL, which makes the loader load these drivers alone.
void load_only(const std::vector<Icd>& icds) {
    const TemporaryFolder folder;
    std::map<std::string, std::optional<std::string>> before;
    for (const auto& [name, value] : environment_for(icds, folder.path())) {
        const char* old = std::getenv(name.c_str());
        before[name] = old ? std::optional<std::string>(old) : std::nullopt;
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    cl_uint count = 0;
    ::clGetPlatformIDs(0, nullptr, &count);
    for (const auto& [name, value] : before)
        value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
}

}  // namespace

const std::vector<PlatformProblem>& load_drivers() {
    static const Problems problems = [] {
        const std::vector<Icd> icds = installed_icds();
        place_pocl_cache(icds);
        const auto died = [](const Death& death) { return death.note == listing_note; };
        const auto deaths = std::ranges::count_if(earlier_deaths(), died);
        if (deaths > 1) {
            const std::string limits = shell_limits();
            throw Error(Exit::device,
                        "The OpenCL drivers take this program down when they are loaded, by " +
                            earlier_deaths().back().cause +
                            ", but did not when they were tried. OCL_ICD_VENDORS=NAME.icd picks one of "
                            "/etc/OpenCL/vendors." +
                            (limits.empty() ? "" : " The shell's limits (" + limits + ") may be why."));
        }
        const Problems bad = bad_ones(icds, deaths == 0);
        if (!bad.empty()) {
            std::vector<Icd> good;
            for (const Icd& icd : icds)
                if (std::ranges::count(bad, icd.name, &PlatformProblem::platform) == 0) good.push_back(icd);
            load_only(good);
        }
        return bad;
    }();
    return problems;
}

}  // namespace opencl

void survive_drivers(int argc, char** argv) {
    if (argc >= 3 && std::strcmp(argv[1], opencl::trial_word) == 0) opencl::be_the_trial(argc, argv);
    allow_restarts(argv);
}

}  // namespace triad
