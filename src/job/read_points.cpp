#include "read_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace overturn {

namespace {

Given given_by(const Entry& entry, const Quantity& named, bool is_recorded)
{
    if (!applies_to(named, is_recorded)) {
        refuse(entry, is_recorded ? " has no meaning under a record. Remove it."
                                  : " has no meaning under a pulse. Remove it.");
    }
    // { ..., of = "maximum" } is another spelling of restitution_of_maximum.
    const Quantity* given = &named;
    std::vector<std::string_view> keys(axis_keys().begin(), axis_keys().end());
    if (named.name == "restitution" && entry.node->is_table()) {
        keys.push_back("of");
        constexpr std::array<std::string_view, 2> of_names{"absolute", "maximum"};
        const auto of = find(entry, "of");
        if (of && index_of_name(*of, of_names) == 1) {
            given = &quantity("restitution_of_maximum");
        }
    }
    return {given, entry.key, read_axis(entry, *given, keys),
            entry.node->is_number() ? GivenAs::number : GivenAs::axis};
}

/// The coordinates of points in the tables of the job.
std::vector<Given> given_coordinates(const Entry& job, bool is_recorded)
{
    std::vector<Given> given;
    for (const std::string_view table : coordinate_tables) {
        const Entry entry = table_of(job, table);
        for (const std::string_view name : keys_of(table)) {
            if (const auto coordinate = find(entry, name)) {
                given.push_back(given_by(*coordinate, quantity(name), is_recorded));
            }
        }
    }
    return given;
}

/// Refuses a quantity at its key, or at the second of two keys; a missing one at the table to which
/// it belongs.
[[noreturn]] void refuse_given(const Entry& job, const std::vector<Given>& given,
                               const GivenError& error)
{
    const std::string& name = error.quantity();
    const auto found = std::find_if(given.rbegin(), given.rend(), [&](const Given& each) {
        return each.quantity->name == name && each.as != GivenAs::column;
    });
    if (found != given.rend()) {
        const std::size_t dot = found->label.find('.');
        const Entry table = *find(job, found->label.substr(0, dot));
        refuse(*find(table, found->label.substr(dot + 1)), error.what());
    }
    const bool is_block = find(job, "block") && (name == "width" || name == "height");
    const std::string_view table = is_block ? "block" : "plane";
    refuse({find(job, table).value_or(job).node, fmt::format("{}.{}", table, name)}, error.what());
}

} // namespace

void read_points(const Entry& entry, const std::string& folder, bool is_suite, Job& job)
{
    const bool is_recorded = job.problem.scene.is_recorded();
    if (!find(entry, "block") && !find(entry, "blocks")) {
        require(entry, "plane",
                is_recorded
                    ? "Add [plane] with scale, size, restitution and slenderness."
                    : "Add [plane] with frequency, amplitude, restitution and slenderness.");
    }
    std::vector<Given> given = given_coordinates(entry, is_recorded);
    if (find(entry, "blocks")) {
        const Entry path =
            require(table_of(entry, "blocks"), "table", "Give the path of a table of blocks.");
        job.blocks = read_block_table(string_of(path), folder, job.motions);
        std::ranges::move(columns_of(*job.blocks, is_recorded), std::back_inserter(given));
    }
    const auto csv_has = [&](std::string_view name) {
        return job.blocks && job.blocks->table.find(name) != nullptr;
    };
    if (is_recorded && !csv_has("motion")) {
        const auto last = std::int64_t(job.motions.size());
        given.push_back({&quantity("motion"), "scene.record",
                         Axis(AxisRange{1, double(last), last}),
                         is_suite ? GivenAs::axis : GivenAs::number});
    }
    try {
        job.problem.grid = grid_of(job.problem.scene, given);
    } catch (const GivenError& error) {
        if (csv_has(error.quantity()) || (job.blocks && !find(entry, "plane"))) {
            refuse(*job.blocks, error);
        }
        refuse_given(entry, given, error);
    }
}

} // namespace overturn
