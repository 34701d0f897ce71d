#include "commands/report/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

namespace overturn {
namespace {

constexpr bool terminal = true;
constexpr bool log_file = false;

/// Returns the output of a Progress on the given kind of stream while `use` updates it.
template <class Use>
std::string written(bool is_terminal, Use use)
{
    std::FILE* const stream = std::tmpfile();
    {
        Progress progress("points", 0, stream, is_terminal);
        use(progress);
    }
    std::string text(std::size_t(std::ftell(stream)), '\0');
    std::rewind(stream);
    EXPECT_EQ(std::fread(text.data(), 1, text.size(), stream), text.size());
    std::fclose(stream);
    return text;
}

TEST(ProgressText, ShowsCountShareRateAndTimeLeft)
{
    const ProgressState state{.before = 0, .done = 1'200'000, .all = 3'000'000, .seconds = 2};
    EXPECT_EQ(progress_text(state), "1.20 M of 3.00 M points, 40 %, 600 k points/s, 3.00 s left");
}

TEST(ProgressText, ExcludesThePointsOfAnEarlierRunFromTheRate)
{
    const ProgressState state{.before = 1000, .done = 2000, .all = 12'000, .seconds = 1};
    EXPECT_EQ(progress_text(state), "2.00 k of 12.0 k points, 16 %, 1.00 k points/s, 10 s left");
}

TEST(ProgressText, ShowsAHundredPercentOnlyWhenComplete)
{
    const ProgressState nearly{.before = 0, .done = 99'999, .all = 100'000, .seconds = 1};
    EXPECT_NE(progress_text(nearly).find(" 99 %"), std::string::npos);
}

TEST(ProgressText, ShowsNoRateBeforeTheFirstPoint)
{
    ProgressState state{.before = 500, .done = 500, .all = 1000, .seconds = 1};
    EXPECT_EQ(progress_text(state), "500 of 1.00 k points, 50 %");
    state.items = "lines";
    EXPECT_EQ(progress_text(state), "500 of 1.00 k lines, 50 %");
}

TEST(Progress, IsSilentInAShortRun)
{
    const auto short_run = [](Progress& progress) {
        progress.update(500, 1000);
        progress.update(1000, 1000);
    };
    EXPECT_EQ(written(terminal, short_run), "");
    EXPECT_EQ(written(log_file, short_run), "");
}

TEST(Progress, PrintsTheFirstLineOfALogAfterTwoSeconds)
{
    const std::string text = written(log_file, [](Progress& progress) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2050));
        progress.update(500, 1000);
        progress.update(501, 1000); // the next line appears after another 10 s
    });
    EXPECT_TRUE(text.starts_with("500 of 1.00 k points, 50 %")) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, RedrawsOneLineOnATerminalAndTerminatesIt)
{
    const std::string text = written(terminal, [](Progress& progress) {
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
        for (int points = 1; points <= 400; ++points) {
            progress.update(points, 1000); // all within one redraw interval: drawn once
        }
        progress.update(1000, 1000); // complete: always drawn
    });
    EXPECT_EQ(text.front(), '\r');
    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    EXPECT_EQ(text.back(), '\n');
    EXPECT_NE(text.find("100 %"), std::string::npos);
}

} // namespace
} // namespace overturn
