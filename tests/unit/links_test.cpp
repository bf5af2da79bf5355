// What programs ask the loader for. triad-replay is carried to machines that have a driver and nothing else.
#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

#include "base/files.h"
#include "program.h"

namespace {

/// The libraries that an ELF program names in its dynamic section.
std::set<std::string> needed_by(const std::string& path) {
    const auto bytes = triad::read_file(path);
    const auto at = [&](std::uint64_t offset, auto& to) {
        if (offset + sizeof to > bytes.size()) return false;
        std::memcpy(&to, bytes.data() + offset, sizeof to);
        return true;
    };
    Elf64_Ehdr head;
    EXPECT_TRUE(at(0, head) && std::memcmp(head.e_ident, ELFMAG, SELFMAG) == 0);
    std::set<std::string> names;
    for (unsigned i = 0; i < head.e_shnum; ++i) {
        Elf64_Shdr section, text;
        EXPECT_TRUE(at(head.e_shoff + i * sizeof section, section));
        if (section.sh_type != SHT_DYNAMIC) continue;
        EXPECT_TRUE(at(head.e_shoff + section.sh_link * sizeof text, text));
        for (std::uint64_t j = 0; j < section.sh_size / sizeof(Elf64_Dyn); ++j) {
            Elf64_Dyn entry;
            EXPECT_TRUE(at(section.sh_offset + j * sizeof entry, entry));
            if (entry.d_tag == DT_NEEDED)
                names.insert(reinterpret_cast<const char*>(bytes.data() + text.sh_offset + entry.d_un.d_val));
        }
    }
    return names;
}

}  // namespace

TEST(ReplayLinks, name_an_opencl_loader_and_the_c_runtime_alone) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "with sanitizers it links their runtime";
#endif
    const std::set<std::string> allowed{"libOpenCL.so.1",       "libc.so.6",  "libm.so.6",
                                        "libpthread.so.0",      "libdl.so.2", "ld-linux-x86-64.so.2",
                                        "ld-linux-aarch64.so.1"};
    const std::set<std::string> names = needed_by(TRIAD_REPLAY);
    EXPECT_TRUE(names.contains("libOpenCL.so.1"));
    for (const std::string& name : names) EXPECT_TRUE(allowed.contains(name)) << name;
    EXPECT_TRUE(needed_by(TRIAD_PROGRAM).contains("libstdc++.so.6"));  // else the reader reads nothing
}

/// Its 230 libraries take longer to start than a small picture takes.
TEST(ProgramLinks, start_without_openimageio) {
    for (const std::string& name : needed_by(TRIAD_PROGRAM))
        EXPECT_EQ(name.find("OpenImageIO"), std::string::npos) << name;
}
