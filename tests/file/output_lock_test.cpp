#include "support/scratch_folder.hpp"

#include "overturn/file/output_lock.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace overturn {
namespace {

TEST(OutputLock, IsRefusedOnlyIfAnotherExists)
{
    const ScratchFolder folder;
    const std::string path = folder / "a.h5";
    std::atomic<int> held = 0;
    // Locks of other writers may appear and disappear between any two steps.
    const auto take_turns = [&] {
        for (int turn = 0; turn < 4'000; ++turn) {
            try {
                const OutputLock writer(path);
                EXPECT_EQ(++held, 1);
                --held;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), exit_code::output);
                EXPECT_THAT(error.what(), testing::HasSubstr("is being written by another run"));
            }
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < 3; ++i) {
        threads.emplace_back(take_turns);
    }
}

} // namespace
} // namespace overturn
