#include "base/log.h"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <set>
#include <utility>

namespace triad {
namespace {

std::atomic<int> level{1};
std::mutex line_mutex;
std::function<void()> clear_line;

void print(const char* prefix, const std::string& text) {
    std::lock_guard lock(line_mutex);
    if (clear_line) clear_line();
    std::fprintf(stderr, "%s%s\n", prefix, text.c_str());
}

}  // namespace

void before_each_line(std::function<void()> clear) {
    std::lock_guard lock(line_mutex);
    clear_line = std::move(clear);
}

void set_log_level(int value) { level = value; }
int log_level() { return level; }

void warn(const std::string& sentence) {
    static std::set<std::string> seen;
    {
        std::lock_guard lock(line_mutex);
        if (!seen.insert(sentence).second) return;
    }
    if (level >= 1) print("triad: warning: ", sentence);
}

void inform(const std::string& sentence) {
    if (level >= 1) print("", sentence);
}

void detail(const std::string& sentence) {
    if (level >= 2) print("", sentence);
}

}  // namespace triad
