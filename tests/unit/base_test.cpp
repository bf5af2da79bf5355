// Built-in checks of base.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/file_lock.h"
#include "base/files.h"
#include "base/hash.h"
#include "own_cache.h"
#include "sentence_of.h"
#include "temporary_folder.h"

TEST(Hash, separates_lengths) {
    EXPECT_NE(triad::Hash().add("ab").add("c").hex(), triad::Hash().add("a").add("bc").hex());
    EXPECT_EQ(triad::Hash().add("ab").hex().size(), 32u);
}

TEST(CacheFolder, is_below_home_where_xdg_names_no_absolute_path) {
    const TemporaryFolder home;
    const triad::OwnCache restored;
    const std::string before = std::getenv("HOME") ? std::getenv("HOME") : "";
    ::setenv("HOME", (home / "").c_str(), 1);
    for (const char* relative : {"", "cache", "./cache"}) {
        ::setenv("XDG_CACHE_HOME", relative, 1);
        EXPECT_EQ(triad::cache_folder(), home / ".cache/triad") << relative;
    }
    ::setenv("XDG_CACHE_HOME", (home / "own").c_str(), 1);
    EXPECT_EQ(triad::cache_folder(), home / "own/triad");
    ::setenv("HOME", before.c_str(), 1);
}

TEST(FileLock, is_held_once_named_and_gone_with_its_holder) {
    const TemporaryFolder folder;
    const auto file = folder / "a.film", lock = folder / ".a.film.lock";
    {
        const triad::FileLock held(file);
        EXPECT_NE(sentence_of(triad::Exit::scene, [&] { triad::FileLock second(file); })
                      .find("process " + std::to_string(::getpid())),
                  std::string::npos);
        EXPECT_TRUE(std::filesystem::exists(lock));
    }
    EXPECT_FALSE(std::filesystem::exists(lock));
    std::ofstream(lock) << "process 1 on a machine that went down";
    triad::FileLock::clear(file);
    EXPECT_FALSE(std::filesystem::exists(lock));
    const triad::FileLock again(file);
}
