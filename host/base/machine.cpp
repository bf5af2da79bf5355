#include "base/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <thread>

#include "base/text.h"

namespace triad {
namespace {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

}  // namespace

Machine this_machine() {
    utsname system{};
    ::uname(&system);
    return {std::string(system.sysname) + " " + system.release, system.machine, processor_name(),
            std::thread::hardware_concurrency(),
            static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                static_cast<std::uint64_t>(::sysconf(_SC_PAGE_SIZE))};
}

std::string machine_words() {
    const Machine m = this_machine();
    return m.processor + ", " + std::to_string(m.cores) + " cores, " + bytes_text(m.memory_bytes) + ", " +
           m.system + " (" + m.architecture + ")";
}

}  // namespace triad
