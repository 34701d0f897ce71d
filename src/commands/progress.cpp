#include "progress.hpp"

#include "human_units.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>

namespace overturn {

namespace {

constexpr double redraw_interval = 0.2; // [s]

// A log line every 10 s at first; in long runs when they are a tenth longer, at least every 10 min.
constexpr double shortest_log_interval = 10;
constexpr double longest_log_interval = 600;

double log_interval(double seconds)
{
    return std::clamp(seconds / 10, shortest_log_interval, longest_log_interval);
}

} // namespace

std::string progress_text(const Moment& moment)
{
    // Truncated: 100 % is for a run that is complete.
    const int percent = int(100 * double(moment.done) / double(moment.all));
    std::string text = fmt::format("{} of {} {}, {} %", human_count(double(moment.done)),
                                   human_count(double(moment.all)), moment.items, percent);
    const double computed = double(moment.done - moment.before);
    if (computed > 0 && moment.seconds > 0) {
        const double rate = computed / moment.seconds;
        text += fmt::format(", {} {}/s", human_count(rate), moment.items);
        if (moment.done < moment.all) {
            text +=
                fmt::format(", {} left", human_duration(double(moment.all - moment.done) / rate));
        }
    }
    return text;
}

Progress::Progress(std::int64_t before, std::int64_t all, std::FILE* stream, bool terminal,
                   const char* items)
    : before_(before), all_(all), stream_(stream), items_(items), terminal_(terminal),
      start_(std::chrono::steady_clock::now()),
      next_(terminal ? redraw_interval : shortest_log_interval)
{}

Progress::Progress(std::int64_t before, std::int64_t all, const char* items)
    : Progress(before, all, stderr, isatty(STDERR_FILENO) == 1, items)
{}

Progress::~Progress()
{
    if (line_is_open_) {
        std::fputc('\n', stream_);
    }
}

void Progress::update(std::int64_t done)
{
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const bool last_redraw = line_is_open_ && done == all_;
    if (seconds < next_ && !last_redraw) {
        return;
    }
    next_ = seconds + (terminal_ ? redraw_interval : log_interval(seconds));
    show({.before = before_, .done = done, .all = all_, .seconds = seconds, .items = items_});
}

void Progress::show(const Moment& moment)
{
    const std::string text = progress_text(moment);
    if (terminal_) {
        // Back to the first column; what is left of a longer line is erased.
        std::fputs(fmt::format("\r{}\x1b[K", text).c_str(), stream_);
        line_is_open_ = true;
    } else {
        std::fputs(fmt::format("{}\n", text).c_str(), stream_);
    }
    std::fflush(stream_); // a failure is ignored: the reader may be gone
}

} // namespace overturn
