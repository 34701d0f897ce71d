#include "history.hpp"

#include "print.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/answers/ranges_text.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

/// The units of printed values: seconds and degrees if p is known, otherwise 1/p and radians.
struct Units {
    Units(const std::optional<double>& p, const std::optional<double>& size_of_block)
        : size(size_of_block), per_second(p.value_or(1)), per_angle(p ? in_degrees(1) : 1),
          time(p ? "s" : "1/p"), after(p ? "s" : "/ p"), angle(p ? "deg" : "rad"),
          rate(p ? "deg/s" : "rad")
    {}

    std::optional<double> size; ///< R [m]
    double per_second;          ///< p [1/s]
    double per_angle;
    const char* time;
    const char* after; ///< the unit after a number
    const char* angle;
    const char* rate;
};

void print_event(const HistoryEvent& event, const Units& units, bool may_slip)
{
    // A tiny negative angle would print as -0.
    const auto shown = [&](double value) {
        const double scaled = value * units.per_angle;
        return std::abs(scaled) < 5e-6 ? 0 : scaled;
    };
    const auto rate = [&](double value) { return shown(value) * units.per_second; };
    fmt::print("{:>10.4f}  {:<13}{:>11.5f}{:>21.5f}{:>20.5f}{:>16.3e}",
               event.after.time / units.per_second, event_names[std::size_t(event.kind)],
               shown(event.after.angle), rate(event.before.velocity), rate(event.after.velocity),
               event.after.q);
    if (may_slip) {
        const double slide = event.after.slide * units.size.value_or(1) * (units.size ? 1000 : 1);
        fmt::print("{:>13.4g}", std::abs(slide) < 5e-13 ? 0 : slide);
    }
    fmt::print("\n");
}

void print_events(const History& history, const Units& units, bool may_slip)
{
    constexpr std::size_t most_lines = 24;
    fmt::print("\n{:>10}  {:<13}{:>11}{:>21}{:>20}{:>16}{}\n", fmt::format("time [{}]", units.time),
               "event", fmt::format("angle [{}]", units.angle),
               fmt::format("vel. before [{}]", units.rate),
               fmt::format("vel. after [{}]", units.rate), "q after [rad2]",
               may_slip ? fmt::format("{:>13}", units.size ? "slide [mm]" : "slide [R]") : "");
    const std::size_t shown = std::min(most_lines, history.events.size());
    for (std::size_t i = 0; i < shown; ++i) {
        print_event(history.events[i], units, may_slip);
    }
    if (shown < history.events.size()) {
        fmt::print("{:>10}  and {} more\n", "", history.events.size() - shown);
    }
}

void print_outcome(const History& history, const Problem& problem, const Units& units)
{
    const auto time = [&](double value) {
        return std::isnan(value) ? std::string("unknown")
               : std::isinf(value)
                   ? std::string("never")
                   : fmt::format("after {:.6g} {}", value / units.per_second, units.after);
    };
    print_row("region", name_of(history.region));
    const bool is_known = history.is_curve_certain && !std::isnan(history.margin);
    print_row("margin",
              is_known ? fmt::format("{:.6g}, error at most {:.1g}", history.margin, history.error)
              : history.is_curve_certain && history.slips
                  ? "unknown, because the block slips after the end of the motion"
                  : "unknown");
    print_row("peak", peak_text(accurate_values(problem, Field::peak).front(), problem));
    if (problem.grid.may_slip()) {
        print_row("slide",
                  slide_text(accurate_values(problem, Field::slide).front(),
                             accurate_values(problem, Field::slide_peak).front(), units.size));
    }
    print_row("falls", time(history.time_of_fall));
    print_row("rests", time(history.time_of_rest));
    if (!history.is_curve_certain) {
        print_row("note",
                  "The motion is so sensitive that doubles cannot follow it: the true motion "
                  "may differ from these events");
        print_row("", history.region == Region::undecided
                          ? "and the curve. More digits do not settle the region either."
                          : "and the curve. The region was settled with more digits.");
    }
    if (history.shortened) {
        print_row("note", history.slips
                              ? "The history is incomplete: it ends where the block would jam or "
                                "leave the base, or has too many events."
                              : "The history is incomplete: it has too many events.");
    }
}

} // namespace

void print_history(const Job& job, const History& history)
{
    const auto parameter = extent_of(job, "frequency_parameter");
    const Units units(parameter ? std::optional(parameter->first) : std::nullopt,
                      size_of_only_block(job));
    print_outcome(history, job.problem, units);
    print_events(history, units, job.problem.grid.may_slip());
}

} // namespace overturn
