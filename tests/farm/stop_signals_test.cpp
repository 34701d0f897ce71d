#include "overturn/farm/stop_signals.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace overturn {
namespace {

TEST(StopSignals, AreDetectedAfterOneWasSent)
{
    const StopSignals signals;
    EXPECT_FALSE(StopSignals::requested());
    std::raise(SIGUSR1);
    EXPECT_TRUE(StopSignals::requested());
}

TEST(StopSignals, OfABatchSystemDoNotKillARunThatHasJustEnded)
{
    {
        const StopSignals signals;
    }
    EXPECT_EXIT(
        {
            std::raise(SIGUSR1);
            std::_Exit(0);
        },
        testing::ExitedWithCode(0), "");
    std::signal(SIGUSR1, SIG_DFL);
}

} // namespace
} // namespace overturn
