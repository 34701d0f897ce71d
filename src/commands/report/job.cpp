#include "job.hpp"

#include "print.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

/// The friction coefficients that rocking needs.
std::string contact_line(const Job& job)
{
    constexpr double large = 0.7;
    Extent lift, impact;
    const Grid corners = corners_of(job.problem.grid);
    for (const Point& point : Coordinates(job.problem.scene, corners).points()) {
        const ContactSides<double> sides(point.block, point.gyration);
        const Block<double> other = point.block.turned();
        lift.include(friction_to_lift(sides.plus, point.block.slenderness));
        lift.include(friction_to_lift(sides.minus, other.slenderness));
        impact.include(friction_of_impact(point.block, sides.plus, sides.minus));
        impact.include(friction_of_impact(other, sides.minus, sides.plus));
    }
    const auto text = [](const Extent& extent) {
        const std::string first = fmt::format("{:.3g}", extent.first);
        const std::string last = fmt::format("{:.3g}", extent.last);
        return first == last ? first : fmt::format("{} to {}", first, last);
    };
    const auto impact_text = [&] {
        constexpr std::string_view none = "more than any, since the base would have to pull";
        return std::isfinite(impact.last)    ? text(impact)
               : std::isfinite(impact.first) ? fmt::format("from {:.3g} to {}", impact.first, none)
                                             : std::string(none);
    };
    return fmt::format("lifting needs a friction coefficient of {} (b / h), an impact {}{}; the "
                       "motion may need more, see the field friction_demand",
                       text(lift), impact_text(),
                       lift.last > large ? fmt::format("; few contacts have more than {}", large)
                                         : "");
}

/// What blocks that may slip do first, at which peak ground acceleration.
std::string sliding_line(const Job& job)
{
    const Scene& scene = job.problem.scene;
    Extent flat, sliding, lifting;
    for (const Point& point : Coordinates(scene, corners_of(job.problem.grid)).points()) {
        const double pga = moving_pga(scene, point);
        (stays_flat(point)                 ? flat
         : pga < lifting_pga(scene, point) ? sliding
                                           : lifting)
            .include(pga);
    }
    std::vector<std::string> texts;
    const auto add = [&](const Extent& extent, std::string_view verb, std::string_view rest) {
        if (extent.first <= extent.last) {
            texts.push_back(fmt::format("{} from {}{}", verb, extent.text(" g"), rest));
        }
    };
    add(flat, "slides", ", does not rock");
    add(sliding, "slides", ", may rock");
    add(lifting, "lifts", " before it slides");
    return fmt::format("{}", fmt::join(texts, "; or "));
}

std::string ground_line(const Job& job)
{
    std::string line = "peak " + extent_of(job, "pga")->text(" g");
    if (const auto period = extent_of(job, "pulse_period")) {
        line = fmt::format("period {}, {}", period->text(" s"), line);
    }
    const Dimension* table = job.problem.grid.table();
    const auto has = [&](Role role) {
        return table != nullptr && std::ranges::any_of(table->columns, [&](const Column& column) {
                   return column.quantity->role == role;
               });
    };
    if (has(Role::motion) || has(Role::rate)) {
        line += has(Role::motion) ? ", each block under a record of its own"
                                  : ", each block under a pulse of its own";
    }
    return line;
}

void print_pulse(const NamedPulse& pulse, const Job& job)
{
    print_row("pulse", pulse.name);
    for (const auto& [name, value] : pulse.numbers) {
        print_row(name,
                  name == "window"
                      ? fmt::format("-{0} to {0} pulse periods, truncated at {1:.2g} % of the peak",
                                    value, 100 * cut_by_window(*job.problem.scene.pulse()))
                      : fmt::format("{}{}", value, name == "nu" ? " rad" : " pulse periods"));
    }
    if (job.shape) {
        print_row("shape", shape_line(*job.shape));
    }
}

void print_scene(const Job& job)
{
    for (const std::string& line : record_lines(job)) {
        print_row("record", line);
    }
    const auto& [scene, grid, numerics, product, fields] = job.problem;
    if (const auto pulse = scene.named_pulse()) {
        print_pulse(*pulse, job);
    }
    print_motion_of("motion", scene.motion_of);
    print_row("theory", name_of(scene.theory));
    print_row("method",
              fmt::format("{}, tolerance {}{}", name_of(numerics.method), numerics.tolerance,
                          numerics.resolve ? ", verdicts resolved" : ""));
}

void print_coordinates(const Grid& grid)
{
    for (const Column* column : grid.outside_table()) {
        const auto& [quantity, values] = *column;
        const std::string units = quantity->printed_units();
        print_axis(quantity->name, values.size(), values.first(), values.last(),
                   units.empty() ? "" : " " + units);
    }
}

} // namespace

void print_job(const Job& job)
{
    if (!job.title.empty()) {
        fmt::print("{}\n\n", printable(job.title));
    }
    print_scene(job);
    print_coordinates(job.problem.grid);
    print_row(job.blocks ? "blocks" : "block", block_line(job));
    if (has_contact_forces(job.problem.scene.theory)) {
        print_row("contact", contact_line(job));
    }
    if (job.problem.grid.may_slip()) {
        print_row("slip", sliding_line(job));
    }
    if (const std::string names = unused_columns(job); !names.empty()) {
        print_row("columns", names + ": stored, not used in the computation");
    }
    print_row(name_of(job.problem.scene.motion_of), ground_line(job));
    for (const std::string& line : free_fall_lines(job)) {
        print_row("note", line);
    }
}

} // namespace overturn
