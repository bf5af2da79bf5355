#pragma once
/// The drivers (ICDs) that the system's OpenCL loader would load, and how it is held to some of them.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triad::opencl {

struct Icd {
    std::string name;            ///< of its file, "intel.icd", or of its library where no file names it
    std::filesystem::path file;  ///< empty: named by OCL_ICD_FILENAMES, or by OCL_ICD_VENDORS directly
    std::string library;         ///< as dlopen takes it
    bool extra = false;          ///< named by OCL_ICD_FILENAMES, which Khronos' loader knows
};

/// As ocl-icd and Khronos' loader find them: OCL_ICD_VENDORS (a folder, a file, or a library),
/// OPENCL_VENDOR_PATH, /etc/OpenCL/vendors; and OCL_ICD_FILENAMES. By name.
std::vector<Icd> installed_icds();

/// Names this set of drivers as it is now: files and libraries with sizes and times, the variables that
/// drivers and loaders read, and this machine.
std::string key_of(const std::vector<Icd>& icds);

/// What a loader's environment must hold so that it sees these drivers alone; fills the empty `folder`.
std::map<std::string, std::string> environment_for(const std::vector<Icd>& icds,
                                                   const std::filesystem::path& folder);

}  // namespace triad::opencl
