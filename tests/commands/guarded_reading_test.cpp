// A crash, an endless loop and huge allocations while a file is read.
#include "commands/guarded_reading.hpp"

#include "overturn/text/error.hpp"
#include "support/scratch_folder.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <sys/time.h>
#include <vector>

namespace overturn {
namespace {

using testing::ExitedWithCode;

TEST(GuardedReadingDeathTest, EndsTheProcessWithAMessageIfItCrashes)
{
    const auto crash = [](int signal) {
        const GuardedReading guarded("a.h5");
        std::raise(signal);
    };
    EXPECT_EXIT(crash(SIGSEGV), ExitedWithCode(exit_code::output),
                "^overturn: \"a.h5\" is damaged: the HDF5 library crashes while reading it "
                "\\(Segmentation fault\\).\n$");
    EXPECT_EXIT(crash(SIGFPE), ExitedWithCode(exit_code::output), "\\(Floating point exception\\)");
    EXPECT_EXIT(crash(SIGABRT), ExitedWithCode(exit_code::output), "\\(Aborted\\)");
}

int overflow_stack(int depth)
{
    volatile char frame[4096] = {};
    return depth < 0 ? 0 : overflow_stack(depth + 1) + frame[depth % 4096];
}

TEST(GuardedReadingDeathTest, EndsTheProcessIfTheStackOverflows)
{
    const auto overflow = [] {
        const GuardedReading guarded("a.h5");
        overflow_stack(0);
    };
    EXPECT_EXIT(overflow(), ExitedWithCode(exit_code::output), "Segmentation fault");
}

TEST(GuardedReadingDeathTest, RemovesTheLockOfTheFile)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.h5.lock", "");
    const auto crash = [&] {
        const GuardedReading guarded(folder / "a.h5", folder / "a.h5.lock");
        std::raise(SIGBUS);
    };
    EXPECT_EXIT(crash(), ExitedWithCode(exit_code::output), "Bus error");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.lock"));
}

TEST(GuardedReadingDeathTest, EndsTheProcessWhenTheTimeIsOver)
{
    const auto wait = [] {
        const GuardedReading guarded("a.h5");
        itimerval left{};
        getitimer(ITIMER_PROF, &left);
        EXPECT_NEAR(double(left.it_value.tv_sec), 60, 1);
        left.it_value = {.tv_sec = 0, .tv_usec = 1000};
        setitimer(ITIMER_PROF, &left, nullptr);
        for (;;) {
        }
    };
    EXPECT_EXIT(wait(), ExitedWithCode(exit_code::output),
                "^overturn: \"a.h5\" is damaged: the HDF5 library does not finish reading it in "
                "time.\n$");
}

#ifndef __SANITIZE_ADDRESS__
TEST(GuardedReading, LimitsTheMemory)
{
    std::vector<char> values;
    constexpr std::size_t size = std::size_t(1) << 30;
    {
        const GuardedReading guarded("a.h5");
        EXPECT_THROW(values.reserve(size), std::bad_alloc);
    }
    values.reserve(size);
}
#endif

TEST(GuardedReadingDeathTest, RestoresTheHandlersAndTheTimer)
{
    EXPECT_EXIT(
        {
            std::signal(SIGSEGV, [](int) { _exit(3); });
            {
                const GuardedReading guarded("a.h5");
            }
            itimerval left{};
            getitimer(ITIMER_PROF, &left);
            std::raise(left.it_value.tv_sec == 0 ? SIGSEGV : SIGKILL);
        },
        ExitedWithCode(3), "^$");
}

} // namespace
} // namespace overturn
