#include "read_steps.hpp"

#include "block_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace overturn {

namespace {

/// The quantities of a job, and where each is given.
class GivenQuantities {
public:
    GivenQuantities(const Entry& job, bool is_recorded) : job_(job), is_recorded_(is_recorded) {}

    /// Reads the keys of a table of coordinates, if the job has it.
    void read(std::string_view table)
    {
        const auto entry = find(job_, table);
        if (!entry) {
            return;
        }
        const std::vector<std::string_view> names = keys_of(table);
        expect_table(*entry, names);
        for (const std::string_view name : names) {
            if (const auto given = find(*entry, name)) {
                add(*given, quantity(name));
            }
        }
    }

    void add(Given given) { all_.push_back(std::move(given)); }
    const std::vector<Given>& all() const { return all_; }

    /// Refuses a quantity at its place; that of a missing one is the table to which it belongs.
    [[noreturn]] void refuse(const GivenError& error) const
    {
        if (const auto found = entries_.find(error.quantity()); found != entries_.end()) {
            overturn::refuse(found->second, error.what());
        }
        const bool is_block =
            find(job_, "block") && (error.quantity() == "width" || error.quantity() == "height");
        const auto table = find(job_, is_block ? "block" : "plane");
        overturn::refuse({table ? table->node : job_.node,
                          fmt::format("{}.{}", is_block ? "block" : "plane", error.quantity())},
                         error.what());
    }

private:
    void add(const Entry& entry, const Quantity& named)
    {
        if (!applies_to(named, is_recorded_)) {
            overturn::refuse(entry, is_recorded_ ? " has no meaning under a record. Remove it."
                                                 : " has no meaning under a pulse. Remove it.");
        }
        // { ..., of = "maximum" } is another spelling of restitution_of_maximum.
        const Quantity* quantity = &named;
        std::vector<std::string_view> keys(axis_keys().begin(), axis_keys().end());
        if (named.name == "restitution" && entry.node->is_table()) {
            keys.push_back("of");
            constexpr std::array<std::string_view, 2> of_names{"absolute", "maximum"};
            const auto of = find(entry, "of");
            if (of && index_of_name(*of, of_names) == 1) {
                quantity = &overturn::quantity("restitution_of_maximum");
            }
        }
        // Of two entries of one quantity, the latter is refused.
        entries_.insert_or_assign(std::string(quantity->name), entry);
        all_.push_back({quantity, entry.key, read_axis(entry, *quantity, keys),
                        entry.node->is_number() ? GivenAs::number : GivenAs::axis});
    }

    const Entry& job_;
    bool is_recorded_;
    std::vector<Given> all_;
    std::map<std::string, Entry, std::less<>> entries_;
};

Given motion_of(std::size_t count, bool is_suite)
{
    const auto last = std::int64_t(count);
    return {&quantity("motion"), "scene.record", Axis(AxisRange{1, double(last), last}),
            is_suite ? GivenAs::axis : GivenAs::number};
}

} // namespace

void read_points(const Entry& entry, const std::string& folder, bool is_suite, Job& job)
{
    const bool is_recorded = job.problem.scene.is_recorded();
    if (!find(entry, "block") && !find(entry, "blocks")) {
        require(entry, "plane",
                is_recorded ? "Add [plane] with scale, size, restitution and slenderness."
                            : "Add [plane] with frequency, amplitude, restitution and "
                              "slenderness.");
    }
    GivenQuantities given(entry, is_recorded);
    for (const std::string_view table : coordinate_tables) {
        given.read(table);
    }
    std::optional<BlockTableReader> table;
    if (const auto blocks = find(entry, "blocks")) {
        expect_table(*blocks, keys_of("blocks"));
        table.emplace(string_of(require(*blocks, "table", "Give the path of a table of blocks.")),
                      folder, job.motions);
        for (Given& column : table->columns()) {
            given.add(std::move(column));
        }
    }
    if (is_recorded && !(table && table->has("motion_number"))) {
        given.add(motion_of(job.motions.size(), is_suite));
    }
    try {
        job.problem.grid = grid_of(job.problem.scene, given.all());
    } catch (const GivenError& error) {
        if (table && (table->has(error.quantity()) || !find(entry, "plane"))) {
            table->refuse(error);
        }
        given.refuse(error);
    }
    if (table) {
        job.blocks = std::move(*table).result();
    }
}

} // namespace overturn
