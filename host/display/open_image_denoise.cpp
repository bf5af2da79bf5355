#include "display/open_image_denoise.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "display/resolve.h"
#include "kernels/types.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

// Open Image Denoise 2, oidn.h: the part that is used.
using OidnDevice = void*;
using OidnFilter = void*;
constexpr int device_cpu = 1, format_float3 = 3;

/// Where Python keeps what pip installs: pyoidn brings the library.
std::vector<fs::path> python_folders() {
    std::vector<fs::path> folders;
    const char *environment = std::getenv("VIRTUAL_ENV"), *home = std::getenv("HOME");
    for (const fs::path& root : {fs::path(environment ? environment : ""),
                                 fs::path(home ? home : "") / ".local", fs::path("/usr/local")}) {
        std::error_code none;
        if (!root.is_absolute()) continue;
        for (const auto& version : fs::directory_iterator(root / "lib", none))
            for (const char* packages : {"site-packages", "dist-packages"})
                folders.push_back(version.path() / packages / "pyoidn" / "oidn" / "lib");
    }
    return folders;
}

/// TRIAD_OIDN: the library's file; else where the loader and Python look.
void* load() {
    constexpr const char* name = "libOpenImageDenoise.so.2";
    if (const char* path = std::getenv("TRIAD_OIDN"); path && *path) {
        if (void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL)) return library;
        throw Error(Exit::unsupported,
                    std::string("--denoise oidn: TRIAD_OIDN cannot be loaded: ") + dlerror());
    }
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
    for (const fs::path& folder : python_folders()) {
        std::error_code none;
        if (!fs::exists(folder / name, none)) continue;
        if (void* library = dlopen((folder / name).c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    }
    throw Error(
        Exit::unsupported,
        "--denoise oidn: Open Image Denoise 2 is not found. Install it (pip install pyoidn brings it), or "
        "name its library in TRIAD_OIDN; --denoise own needs nothing.");
}

class Library {
  public:
    Library() : library_(load()) {}

    template <class F>
    F* function(const char* name) const {
        if (void* found = dlsym(library_, name)) return reinterpret_cast<F*>(found);
        throw Error(Exit::unsupported, std::string("--denoise oidn: the library has no ") + name + ".");
    }

  private:
    void* library_;  // stays: its threads outlive a call
};

}  // namespace

std::vector<float> open_image_denoised(const Film& film) {
    const Library library;
    const std::size_t pixels = film.pixels();
    std::vector<float> rgba = resolve_linear(film), colour(pixels * 3), result(pixels * 3), albedo, normal;
    for (std::size_t p = 0; p < pixels; ++p)
        for (std::size_t c = 0; c < 3; ++c) colour[3 * p + c] = rgba[4 * p + c];
    if (!film.guides.empty()) {
        albedo.resize(pixels * 3), normal.resize(pixels * 3);
        for (std::size_t p = 0; p < pixels; ++p)
            for (std::size_t c = 0; c < 3; ++c) {
                albedo[3 * p + c] = film.guides[p * DENOISE_GUIDES + c];
                normal[3 * p + c] = film.guides[p * DENOISE_GUIDES + 3 + c];
            }
    }
    const auto set_image =
        library.function<void(OidnFilter, const char*, void*, int, std::size_t, std::size_t, std::size_t,
                              std::size_t, std::size_t)>("oidnSetSharedFilterImage");
    const auto release_filter = library.function<void(OidnFilter)>("oidnReleaseFilter");
    const auto release_device = library.function<void(OidnDevice)>("oidnReleaseDevice");
    const auto error_of = library.function<int(OidnDevice, const char**)>("oidnGetDeviceError");

    const OidnDevice device = library.function<OidnDevice(int)>("oidnNewDevice")(device_cpu);
    library.function<void(OidnDevice)>("oidnCommitDevice")(device);
    const OidnFilter filter =
        library.function<OidnFilter(OidnDevice, const char*)>("oidnNewFilter")(device, "RT");
    const auto image = [&](const char* name, std::vector<float>& values) {
        if (!values.empty())
            set_image(filter, name, values.data(), format_float3, film.width, film.height, 0, 0, 0);
    };
    image("color", colour), image("albedo", albedo), image("normal", normal), image("output", result);
    library.function<void(OidnFilter, const char*, bool)>("oidnSetFilterBool")(filter, "hdr", true);
    library.function<void(OidnFilter)>("oidnCommitFilter")(filter);
    library.function<void(OidnFilter)>("oidnExecuteFilter")(filter);
    const char* message = nullptr;
    const int error = error_of(device, &message);
    const std::string why = error != 0 && message ? message : "";
    release_filter(filter), release_device(device);
    if (error != 0) throw Error(Exit::unsupported, "--denoise oidn: Open Image Denoise says: " + why);
    for (std::size_t p = 0; p < pixels; ++p)
        for (std::size_t c = 0; c < 3; ++c) rgba[4 * p + c] = result[3 * p + c];
    return rgba;
}

}  // namespace triad
