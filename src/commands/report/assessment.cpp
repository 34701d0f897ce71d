#include "assessment.hpp"

#include "print.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/answers/ranges_text.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace overturn {

namespace {

constexpr int decimals = 4;

std::string strength_text(const std::optional<double>& pga, double end)
{
    return pga ? fmt::format("{:.4f}", rounded_down(*pga, decimals))
               : fmt::format("above {:.4g}", end);
}

/// Three digits, and all of those before the point.
std::string millimetres(double metres)
{
    const double length = 1000 * metres;
    return length < 999.5 ? fmt::format("{:.3g} mm", length) : fmt::format("{:.0f} mm", length);
}

/// A column of the printed table.
struct PrintedColumn {
    std::string format; ///< of its cells
    std::string_view heading;
    std::function<std::string(const ObjectAnswer&)> cell;
};

std::vector<PrintedColumn> printed_columns(const Job& job, const std::vector<ObjectAnswer>& answers,
                                           bool has_cases)
{
    const auto name = [&blocks = *job.blocks](const ObjectAnswer& answer) {
        return printable(name_of_object(blocks, answer.object));
    };
    const std::size_t longest =
        std::ranges::max(mapped(answers, [&](const auto& answer) { return name(answer).size(); }));
    const std::size_t width = std::clamp<std::size_t>(longest, 6, 32);
    std::vector<PrintedColumn> columns;
    const auto add = [&](std::string format, std::string_view heading, const auto& cell) {
        columns.push_back({std::move(format), heading, cell});
    };
    // Columns that differ in the strength that they show.
    const auto add_strength = [&](std::string_view heading,
                                  std::optional<double> ObjectAnswer::*pga) {
        add("{:>15}", heading, [pga](const ObjectAnswer& answer) {
            return strength_text(answer.*pga, answer.end_of_search) + " g";
        });
    };
    const auto moves = [](double pga) {
        return std::isinf(pga) ? std::string("never")
                               : fmt::format("{:.4f} g", rounded_down(pga, decimals));
    };
    const bool has_strength = answers.front().verdict.has_value();
    const bool may_slip = job.problem.grid.may_slip();
    add(fmt::format("{{:<{}}}", width), "object",
        [=](const ObjectAnswer& answer) { return name(answer).substr(0, width); });
    if (has_strength) {
        add("  {:<16}", "verdict", outcome_word);
        add("{:>11}", "of motions", [](const ObjectAnswer& answer) {
            return fmt::format("{:.0f} %", 100.0 * double(answer.toppling) / double(answer.cases));
        });
        add("{:>9}", "tilt", [](const ObjectAnswer& answer) -> std::string {
            return std::isnan(answer.peak)   ? "unknown"
                   : std::isinf(answer.peak) ? "over"
                                             : fmt::format("{:.0f} %", 100 * answer.peak);
        });
    }
    add("{:>13}", "lifts from",
        [=](const ObjectAnswer& answer) { return moves(answer.lifting_pga); });
    if (may_slip) {
        add("{:>13}", "slides from", [=](const ObjectAnswer& answer) {
            return answer.moving_pga < answer.lifting_pga ? moves(answer.moving_pga)
                                                          : "lifts first";
        });
    }
    add_strength("topples from", &ObjectAnswer::toppling_pga);
    if (has_cases) {
        add_strength("16 %", &ObjectAnswer::percentile_16);
        add_strength("median", &ObjectAnswer::median);
    }
    if (has_strength && may_slip) {
        add("{:>12}", "slide", [](const ObjectAnswer& answer) -> std::string {
            return std::isnan(answer.slide) ? "unknown" : millimetres(answer.slide);
        });
    }
    add("{}", "  note", [&job](const ObjectAnswer& answer) {
        const std::string note = note_on(job, answer);
        return note.empty() ? "" : "  " + note;
    });
    return columns;
}

/// How wide the object must be to stand in all cases, and in all but one or two.
std::string widths_text(const std::string& name, const Scene& scene, const LeastWidths& widths)
{
    const std::size_t cases = widths.safe_from.size();
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < std::min<std::size_t>(cases, 3); ++i) {
        const double from = widths.safe_from[cases - 1 - i];
        if (!std::isinf(from)) {
            parts.push_back(fmt::format("from {:.4f} m{}", rounded_up(from, decimals),
                                        i > 0       ? fmt::format(" in {} of {}", cases - i, cases)
                                        : cases > 1 ? " in all cases"
                                                    : ""));
        }
    }
    const double step = step_of_search(scene, {&quantity("width"), widths.width, widths.end});
    return fmt::format(
        "{} is {:.4g} m wide. {}, as searched up to {:.4g} m in steps of {:.2g} m, and "
        "finer ones near the result: single widths between them may topple.",
        name, widths.width,
        parts.empty() ? "No wider one is known to stand"
                      : fmt::format("With more width, it stands {}", fmt::join(parts, ", ")),
        widths.end, step);
}

} // namespace

void print_assessment(const Assessment& assessment, const AssessOptions& options)
{
    const auto& [job, all_cases, answers, widths] = assessment;
    const Scene& scene = job.problem.scene;
    const bool has_strength = answers.front().verdict.has_value();
    const std::int64_t cases =
        std::ranges::max(mapped(answers, [](const ObjectAnswer& each) { return each.cases; }));
    print_row("objects", fmt::format("{} in {}", answers.size(), printable(options.objects)));
    if (const auto pulse = scene.named_pulse()) {
        print_row("motion",
                  fmt::format("{}, period {} s{}", pulse->name, fmt::join(options.periods, ", "),
                              job.shape ? "; " + shape_line(*job.shape) : ""));
    } else {
        for (const std::string& line : record_lines(job)) {
            print_row("record", scene.worded(line));
        }
    }
    const Column* const share = job.problem.grid.find("restitution_of_maximum");
    if (share != nullptr && share->values.size() == 1) {
        print_row("restitution", share->values[0] == 1
                                     ? "r_max, the largest one of each object"
                                     : fmt::format("{} of r_max", share->values[0]));
    }
    if (has_strength) {
        print_row("strength", scene.worded(options.scale ? fmt::format("scale {}", *options.scale)
                                                         : fmt::format("PGA {} g", *options.pga)));
    }
    if (cases > 1) {
        print_row("cases",
                  fmt::format("up to {} of each object: motions, periods and directions", cases));
    }
    const std::vector<PrintedColumn> columns = printed_columns(job, answers, cases > 1);
    fmt::print("\n");
    for (const PrintedColumn& column : columns) {
        fmt::print(fmt::runtime(column.format), column.heading);
    }
    fmt::print("\n");
    for (const ObjectAnswer& answer : answers) {
        for (const PrintedColumn& column : columns) {
            fmt::print(fmt::runtime(column.format), column.cell(answer));
        }
        fmt::print("\n");
    }
    fmt::print("\nStrengths are {}, of the worst case, {}.{}\n",
               scene.worded("peak ground accelerations (PGA)"),
               options.fine
                   ? "searched as by overturn topple"
                   : fmt::format("searched in steps of at most {:.2g} % and refined to {:.2g} %",
                                 100 * toppling_step, 100 * width_of_lowest),
               has_strength ? " The tilt is the largest, over alpha." : "");
    if (widths) {
        fmt::print("{}\n", widths_text(printable(name_of_object(*job.blocks, widths->object)),
                                       scene, *widths));
    }
}

} // namespace overturn
