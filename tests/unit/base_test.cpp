// Built-in checks of base.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/file_lock.h"
#include "base/hash.h"
#include "sentence_of.h"
#include "temporary_folder.h"

TEST(Hash, separates_lengths) {
    EXPECT_NE(triad::Hash().add("ab").add("c").hex(), triad::Hash().add("a").add("bc").hex());
    EXPECT_EQ(triad::Hash().add("ab").hex().size(), 32u);
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
