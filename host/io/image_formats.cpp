#include "io/image_formats.h"

#include <dlfcn.h>

#include "base/error.h"
#include "base/shell_limits.h"

namespace triad::image_formats {
namespace {

using Entry = const Formats* (*)(const char* version);

/// Found beside what asks for it, by the paths that the build and the installation write into programs and
/// libraries. Its names are bound when they are used, and are nobody else's. noexcept: what an initialiser
/// throws would leave libraries behind that have half started.
void* open_library() noexcept {
    const LibrariesStart start;
    return ::dlopen("triad-images.so", RTLD_LAZY | RTLD_LOCAL);
}

const Formats& load() {
    void* library = open_library();
    void* entry = library ? ::dlsym(library, "triad_image_formats") : nullptr;
    const char* fault = entry ? nullptr : ::dlerror();
    if (const Formats* formats = entry ? reinterpret_cast<Entry>(entry)(TRIAD_VERSION) : nullptr)
        return *formats;
    const std::string limits = shell_limits(),
                      reason = fault ? fault : "triad-images.so is of another version";
    const bool is_memory_short = reason.find("failed to map") != std::string::npos ||
                                 reason.find("annot allocate") != std::string::npos;
    if (is_memory_short && !limits.empty())
        throw Error(Exit::memory,
                    "The libraries that read and write pictures cannot start within what the "
                    "shell allows (" +
                        limits + "): " + reason + ". Raise the limit.");
    throw Error(Exit::scene, "Pictures can be neither read nor written: " + reason +
                                 ". Install Triad again, with the packages that it depends on.");
}

}  // namespace

const Formats& loaded() {
    static const Formats& formats = load();
    return formats;
}

}  // namespace triad::image_formats
