#include "read_steps.hpp"

#include "overturn/text/mapped.hpp"

#include <algorithm>

namespace overturn {

namespace {

// Each process stores the values of all axes; `check`, which scans a line of amplitudes, takes 400
// bytes for each value.
constexpr std::int64_t most_values = 10'000'000;

AxisList read_list(const Entry& entry, const Quantity& rule)
{
    const std::size_t size =
        array_size(entry, "an array of numbers, such as [0.5, 1.0]", "Give at least one value.");
    AxisList values;
    values.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
        values.push_back(quantity_of(element(entry, i), rule));
    }
    return values;
}

AxisRange read_range(const Entry& entry, const Quantity& rule)
{
    constexpr std::string_view advice = "Give first, last and count, or values.";
    const Entry first = require(entry, "first", advice);
    const Entry last = require(entry, "last", advice);
    const Entry count = require(entry, "count", advice);
    const AxisRange range{quantity_of(first, rule), quantity_of(last, rule), integer_of(count),
                          choice_of(entry, "spacing", Spacing::linear)};
    if (range.count < 1 || range.count > most_values) {
        refuse(count, " = {} is outside [1, {}], the numbers of values that an axis may have.",
               range.count, most_values);
    }
    if (range.first > range.last) {
        refuse(first, " = {} is above last = {}. Axes must ascend. Swap first and last.",
               range.first, range.last);
    }
    if (range.count == 1 && range.first != range.last) {
        refuse(count,
               " = 1 needs first = last, but first = {} and last = {}. Raise count, or make them "
               "equal.",
               range.first, range.last);
    }
    if (range.spacing == Spacing::log && !(range.first > 0)) {
        refuse(first,
               " = {} cannot start a logarithmic range. Raise it above 0, or use spacing = "
               "\"linear\".",
               range.first);
    }
    return range;
}

/// Reads a number, which gives an axis of one value, or an axis: a table with these keys only,
/// { values = [...] } or { first, last, count, spacing }.
Axis read_axis(const Entry& entry, const Quantity& rule, Names keys)
{
    if (entry.node->is_number()) {
        return Axis(AxisList{quantity_of(entry, rule)});
    }
    expect_table(entry, keys, "a number, or ");
    const auto values = find(entry, "values");
    for (const std::string_view key : {"first", "last", "count", "spacing"}) {
        if (const auto other = find(entry, key); values && other) {
            refuse(*other, " cannot be combined with {}.values. Remove one of them.", entry.key);
        }
    }
    const Axis axis = values ? Axis(read_list(*values, rule)) : Axis(read_range(entry, rule));
    double previous = axis.first();
    for (std::int64_t i = 1; i < axis.size(); ++i) {
        const double value = axis[i];
        if (!(value > previous)) { // also if a value of a range overflows
            refuse(values ? element(*values, std::size_t(i)) : *find(entry, "count"),
                   ": {} is followed by {}, but values must ascend in double precision. Sort a "
                   "list, and give each value once; lower count or change the ends of a range.",
                   previous, value);
        }
        previous = value;
    }
    return axis;
}

/// The coordinates of points in the tables of a job.
std::vector<Given> given_coordinates(const Entry& job, const MotionTraits& motion)
{
    std::vector<Given> given;
    for (const std::string_view table : coordinate_tables) {
        const Entry entries = table_of(job, table);
        for (std::string_view name : keys_of(table)) {
            const auto entry = find(entries, name);
            if (!entry) {
                continue;
            }
            if (!quantity(name).applies_under(motion)) {
                refuse(*entry, " has no meaning under a {}. Remove it.", motion.name);
            }
            std::vector<std::string_view> keys(axis_keys.begin(), axis_keys.end());
            if (name == "restitution") {
                keys.emplace_back("of");
                const auto of = entry->node->is_table() ? find(*entry, "of") : std::nullopt;
                if (of && index_of_name(*of, shares_of) == 1) {
                    name = "restitution_of_maximum"; // of which this is another spelling
                }
            }
            given.emplace_back(&quantity(name), entry->key, read_axis(*entry, quantity(name), keys),
                               entry->node->is_number() ? GivenAs::number : GivenAs::axis);
        }
    }
    return given;
}

/// The records as a coordinate: a dimension if they are a list or a pattern.
Given given_motions(const Entry& record, const std::vector<RecordedMotion>& motions)
{
    const bool is_suite = record.node->is_array() || motions.front().file != string_of(record);
    const auto last = std::int64_t(motions.size());
    return {&quantity("motion"), record.key, Axis(AxisRange{1, double(last), last}),
            is_suite ? GivenAs::axis : GivenAs::number};
}

/// A sentence on the columns of a table of blocks, among which a missing quantity may be.
std::string columns_text(const BlockTable& blocks)
{
    const auto names = mapped(blocks.table.columns, &TableColumn::name);
    return fmt::format(" {} has the columns {}.", blocks.file,
                       shortened(fmt::format("{}", fmt::join(names, ", ")), 200));
}

/// Refuses a quantity at its key, or at the second of two keys; a missing one at the table to which
/// it belongs.
[[noreturn]] void refuse_given(const Entry& job, const std::vector<Given>& given,
                               const GivenError& error, const std::optional<BlockTable>& blocks)
{
    const std::string& name = error.quantity();
    for (auto each = given.rbegin(); each != given.rend(); ++each) {
        if (each->quantity->name == name && each->as != GivenAs::column) {
            refuse({toml::at_path(*job.node, each->label).node(), each->label}, "{}", error.what());
        }
    }
    const bool is_block = find(job, "block") && (name == "width" || name == "height");
    const std::string_view table = is_block ? "block" : "plane";
    refuse({find(job, table).value_or(job).node, fmt::format("{}.{}", table, name)}, "{}{}",
           error.what(), blocks ? columns_text(*blocks) : "");
}

/// Drops the coordinates that the file of the job gives, but a column of an overriding table, too.
void drop_keys_of_file(const Entry& job, const std::vector<Given>& columns,
                       std::vector<Given>& given)
{
    std::erase_if(given, [&](const Given& each) {
        const toml::node& node = *toml::at_path(*job.node, each.label).node();
        return !is_override(node) && std::ranges::any_of(columns, [&](const Given& column) {
            return exclude_each_other(column.quantity->name, each.quantity->name);
        });
    });
}

} // namespace

void read_points(const Entry& entry, const std::string& folder, Job& job)
{
    const MotionTraits& motion = job.problem.scene.motion_traits();
    if (!find(entry, "block") && !find(entry, "blocks")) {
        require(entry, "plane",
                fmt::format("Add [plane] with {}, restitution and slenderness.", motion.examples));
    }
    std::vector<Given> given = given_coordinates(entry, motion);
    if (find(entry, "blocks")) {
        const Entry path =
            require(table_of(entry, "blocks"), "table", "Give the path of a table of blocks.");
        job.blocks = read_block_table(string_of(path), folder, motion, job.motions);
        std::vector<Given> columns = columns_of(*job.blocks, motion);
        if (is_override(*path.node)) {
            drop_keys_of_file(entry, columns, given);
        }
        std::ranges::move(columns, std::back_inserter(given));
    }
    const auto csv_has = [&](std::string_view name) {
        return job.blocks && job.blocks->table.find(name) != nullptr;
    };
    if (!motion.choice.empty() && !csv_has(motion.choice)) {
        given.push_back(given_motions(*find(*find(entry, "scene"), "record"), job.motions));
    }
    try {
        job.problem.grid = grid_of(job.problem.scene, given);
    } catch (const GivenError& error) {
        if (csv_has(error.quantity()) || (job.blocks && !find(entry, "plane"))) {
            refuse(*job.blocks, error);
        }
        refuse_given(entry, given, error, job.blocks);
    }
}

} // namespace overturn
