#include "overturn/sweep/block_list.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/quantity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace overturn {

namespace {

/// The columns of a list, looked up by name and checked value by value.
class ColumnReader {
public:
    ColumnReader(const Columns& columns) : columns_(columns) {}

    bool has(const char* name) const { return columns_.contains(name); }

    /// The only one of these columns that exists; nullptr if there is none.
    const char* only_one_of(std::initializer_list<const char*> names) const
    {
        const char* found = nullptr;
        for (const char* name : names) {
            if (has(name) && found != nullptr) {
                throw ListError(
                    ListError::no_row, name,
                    fmt::format("cannot be combined with {}, which gives the same quantity. "
                                "Remove one of them.",
                                found));
            }
            found = has(name) ? name : found;
        }
        return found;
    }

    /// All values of a column. Throws ListError if one is not allowed.
    const std::vector<double>& values(const char* name) const
    {
        const std::vector<double>& column = columns_.at(name);
        const Quantity& rule = quantity(name);
        for (std::size_t row = 0; row < column.size(); ++row) {
            if (!rule.allows(column[row])) {
                throw ListError(std::int64_t(row), name,
                                fmt::format("{} = {} is outside {}. {}", name, column[row],
                                            rule.interval, rule.reason));
            }
        }
        return column;
    }

private:
    const Columns& columns_;
};

/// The factor on a record. Throws ListError if it or the scaled vertical motion overflows. name: of
/// the strength.
double factor_on(const Accelerogram& record, const char* name, double strength, std::size_t row)
{
    const bool is_pga = name == std::string_view("pga");
    const double factor = strength / (is_pga ? record.peak() : 1);
    if (!std::isfinite(factor) || !std::isfinite(factor * record.upwards_peak())) {
        throw ListError(std::int64_t(row), name,
                        fmt::format("{} = {} exceeds the range of double precision as a factor on "
                                    "the record, whose peak is {} g. Correct the unit of the "
                                    "record, or lower {}.",
                                    name, strength, record.peak(), name));
    }
    return factor;
}

[[noreturn]] void refuse_columns(const std::string& message)
{
    throw ListError(ListError::no_row, "", message);
}

/// of(row) for all rows.
template <class Of>
std::vector<double> for_each_row(std::size_t rows, const Of& of)
{
    std::vector<double> result(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        result[row] = of(row);
    }
    return result;
}

std::vector<double> halves(const ColumnReader& columns, const char* whole, const char* half)
{
    if (columns.only_one_of({whole, half}) == half) {
        return columns.values(half);
    }
    const std::vector<double>& values = columns.values(whole);
    return for_each_row(values.size(), [&](std::size_t row) { return values[row] / 2; });
}

void read_blocks(const Scene& scene, const ColumnReader& columns, BlockList& list)
{
    const char* width = columns.only_one_of({"width", "half_width", "slenderness"});
    const char* height = columns.only_one_of({"height", "half_height", "slenderness"});
    const char* size = columns.only_one_of({"size", "frequency_parameter"});
    if (width == nullptr || height == nullptr) {
        refuse_columns("the blocks are not described. Give width and height, or "
                       "half_width and half_height, or slenderness and size.");
    }
    const bool has_slenderness = columns.has("slenderness");
    if (!has_slenderness && size != nullptr) {
        throw ListError(ListError::no_row, size,
                        fmt::format("cannot be combined with {} and {}, which also give the size. "
                                    "Remove one of them.",
                                    width, height));
    }
    if (has_slenderness) {
        list.slenderness = columns.values("slenderness");
        if (columns.has("frequency_parameter")) {
            list.frequency_parameter = columns.values("frequency_parameter");
        } else if (columns.has("size")) {
            const std::vector<double>& values = columns.values("size");
            list.frequency_parameter = for_each_row(values.size(), [&](std::size_t row) {
                return frequency_parameter(values[row], scene.gravity);
            });
        }
        return;
    }
    const std::vector<double> b = halves(columns, "width", "half_width");
    const std::vector<double> h = halves(columns, "height", "half_height");
    const Quantity& rule = quantity("slenderness");
    list.slenderness = for_each_row(b.size(), [&](std::size_t row) {
        const double slenderness = std::atan(b[row] / h[row]);
        if (!rule.allows(slenderness)) {
            throw ListError(std::int64_t(row), width,
                            fmt::format("the slenderness {} of the block is outside {}. Choose a "
                                        "ratio of width and height closer to 1.",
                                        slenderness, rule.interval));
        }
        return slenderness;
    });
    list.frequency_parameter = for_each_row(b.size(), [&](std::size_t row) {
        return frequency_parameter(half_diagonal({b[row], h[row]}), scene.gravity);
    });
}

void read_restitutions(const ColumnReader& columns, BlockList& list)
{
    const char* name = columns.only_one_of({"restitution", "restitution_of_maximum"});
    if (name == nullptr) {
        refuse_columns("the restitution is missing. Give restitution (the energy ratio "
                       "r) or restitution_of_maximum (its share of r_max).");
    }
    list.restitution = columns.values(name);
    if (columns.has("restitution")) {
        return;
    }
    const Quantity& rule = quantity("restitution");
    for (std::size_t row = 0; row < list.restitution.size(); ++row) {
        const double share = list.restitution[row];
        const double alpha = list.slenderness[row];
        const double r = share * largest_restitution(alpha);
        const double largest_slenderness = std::asin(std::sqrt(2.0 / 3.0));
        if (!(alpha < largest_slenderness)) {
            throw ListError(std::int64_t(row), name,
                            fmt::format("{} = {}: r_max is defined only for a slenderness below "
                                        "{} rad (Eq. 17), but that of this block is {} rad. Use "
                                        "restitution instead.",
                                        name, share, largest_slenderness, alpha));
        }
        if (!rule.allows(r)) {
            throw ListError(std::int64_t(row), name,
                            fmt::format("{} = {} gives r = {}, which is outside {}, at the "
                                        "slenderness {} rad. Use restitution instead.",
                                        name, share, r, rule.interval, alpha));
        }
        list.restitution[row] = r;
    }
}

/// p of every block. Throws ListError if it is unknown; `needed_by` names the column or motion.
const std::vector<double>& parameters(const BlockList& list, const char* needed_by)
{
    if (list.frequency_parameter.empty()) {
        refuse_columns(fmt::format("{} needs the size of the blocks. Give size or "
                                   "frequency_parameter.",
                                   needed_by));
    }
    return list.frequency_parameter;
}

void read_pulses(const Scene& scene, const ColumnReader& columns, BlockList& list)
{
    const char* strength = columns.only_one_of({"amplitude", "pga"});
    const char* rate = columns.only_one_of({"frequency", "pulse_period", "pulse_frequency"});
    if (strength == nullptr && rate == nullptr) {
        return;
    }
    if (strength == nullptr || rate == nullptr) {
        throw ListError(ListError::no_row, strength == nullptr ? rate : strength,
                        fmt::format("does not describe a pulse by itself. Add the column {}, or "
                                    "give both as axes in [plane].",
                                    strength == nullptr ? "pga (or amplitude)"
                                                        : "pulse_period (or frequency)"));
    }
    const std::vector<double>& strengths = columns.values(strength);
    const bool is_pga = columns.has("pga");
    list.amplitude = for_each_row(strengths.size(), [&](std::size_t row) {
        const double unit = is_pga ? pga_of_unit_amplitude(scene, 0, list.slenderness[row]) : 1;
        return strengths[row] / unit;
    });
    const std::vector<double>& rates = columns.values(rate);
    if (columns.has("frequency")) {
        list.frequency = rates;
        return;
    }
    const std::vector<double>& p = parameters(list, rate);
    const auto is = columns.has("pulse_period") ? FrequencyQuantity::pulse_period
                                                : FrequencyQuantity::pulse_frequency;
    list.frequency = for_each_row(rates.size(), [&](std::size_t row) {
        return frequency_of_point(scene, is, 0, rates[row], p[row]);
    });
}

void read_scales(const Scene& scene, const ColumnReader& columns,
                 const std::vector<std::int64_t>& motion, BlockList& list)
{
    const std::vector<double>& p = parameters(list, "a recorded motion");
    const char* strength = columns.only_one_of({"scale", "pga"});
    if (strength == nullptr && motion.empty()) {
        return;
    }
    if (strength == nullptr) {
        throw ListError(ListError::no_row, "motion",
                        "needs a strength for every row. Add the column scale or pga.");
    }
    if (motion.empty() && scene.records.size() > 1) {
        throw ListError(ListError::no_row, strength,
                        fmt::format("needs the record of every row, because the job has {} "
                                    "records. Add the column motion, or give {} as an axis in "
                                    "[plane].",
                                    scene.records.size(), strength));
    }
    list.motion = motion.empty() ? std::vector<std::int64_t>(p.size()) : motion;
    const std::vector<double>& strengths = columns.values(strength);
    list.amplitude = for_each_row(strengths.size(), [&](std::size_t row) {
        const Accelerogram& record = *scene.records[std::size_t(list.motion[row])];
        return factor_on(record, strength, strengths[row], row);
    });
    list.frequency = for_each_row(p.size(), [&](std::size_t row) {
        return frequency_of_point(scene, FrequencyQuantity::frequency_parameter, list.motion[row],
                                  p[row], p[row]);
    });
}

} // namespace

BlockList block_list(const Scene& scene, const Columns& columns,
                     const std::vector<std::int64_t>& motion)
{
    const ColumnReader reader(columns);
    BlockList list;
    read_blocks(scene, reader, list);
    read_restitutions(reader, list);
    if (scene.is_recorded()) {
        read_scales(scene, reader, motion, list);
    } else {
        read_pulses(scene, reader, list);
    }
    list.size = std::int64_t(list.slenderness.size());
    list.has_own_motions = !list.amplitude.empty();
    return list;
}

} // namespace overturn
