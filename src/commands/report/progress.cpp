#include "progress.hpp"

#include "print.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace overturn {

namespace {

constexpr double redraw_interval = 0.2; // [s]

// A log line after 2 s, then every 10 s at first, later after another tenth of the time, at least
// every 10 min.
constexpr double first_log_line = 2; // [s]
constexpr double shortest_log_interval = 10;
constexpr double longest_log_interval = 600;

} // namespace

std::optional<double> ProgressState::rate() const
{
    const double computed = double(done) - double(before);
    return computed > 0 && seconds > 0 ? std::optional(computed / seconds) : std::nullopt;
}

std::optional<double> ProgressState::seconds_left() const
{
    const auto known = rate();
    return known ? std::optional(double(all - done) / *known) : std::nullopt;
}

std::string progress_text(const ProgressState& state)
{
    // Truncated: only a complete run shows 100 %.
    const int percent = int(100 * double(state.done) / double(state.all));
    std::string text = fmt::format("{} of {} {}, {} %", human_count(double(state.done)),
                                   human_count(double(state.all)), state.items, percent);
    if (const auto rate = state.rate()) {
        if (*rate >= 0.5) { // otherwise 0 when rounded
            text += fmt::format(", {} {}/s", human_count(*rate), state.items);
        }
        if (state.done < state.all) {
            text += fmt::format(", {} left", human_duration(*state.seconds_left()));
        }
    }
    return text;
}

Progress::Progress(const char* items, std::int64_t before, std::FILE* stream, bool terminal)
    : state_{.before = before, .items = items}, stream_(stream), terminal_(terminal),
      next_(terminal ? redraw_interval : first_log_line)
{}

Progress::~Progress()
{
    if (line_is_open_) {
        std::fputc('\n', stream_);
    }
}

void Progress::update(std::int64_t done, std::int64_t all)
{
    state_.done = done;
    state_.all = all;
    state_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const bool last_redraw = line_is_open_ && done == all;
    if (state_.seconds < next_ && !last_redraw) {
        return;
    }
    next_ = state_.seconds + (terminal_ ? redraw_interval
                                        : std::clamp(state_.seconds / 10, shortest_log_interval,
                                                     longest_log_interval));
    // On a terminal: return to the first column, and erase the rest of a longer line.
    std::fprintf(stream_, terminal_ ? "\r%s\x1b[K" : "%s\n", progress_text(state_).c_str());
    std::fflush(stream_); // failure ignored: the reader may have ended
    line_is_open_ = terminal_;
}

} // namespace overturn
