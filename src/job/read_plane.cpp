#include "read_steps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace overturn {

namespace {

constexpr std::string_view axis_advice =
    "Give a number, { first, last, count } or { values = [...] }.";

/// The only one of two entries; nullopt if there is neither.
std::optional<Entry> only_one_of(const Entry& table, std::string_view one, std::string_view other)
{
    const auto first = find(table, one);
    const auto second = find(table, other);
    if (first && second) {
        refuse(*second,
               fmt::format(" cannot be combined with {}, which gives the same quantity. Remove one "
                           "of them.",
                           first->key));
    }
    return first ? first : second;
}

constexpr std::string_view block_advice = "Give width and height, or their halves, in metres.";

/// Half of a side of the block [m], given whole or as the half.
double read_half(const Entry& block, std::string_view whole, std::string_view half)
{
    const auto entry = only_one_of(block, whole, half);
    const Entry given = entry ? *entry : require(block, whole, block_advice);
    const double length = number_of(given);
    expect_allowed(given, quantity(whole), length);
    return given.key == block.key + "." + std::string(whole) ? length / 2 : length;
}

/// The slenderness arctan(b / h) [rad] of the block.
double slenderness_of(const Entry& entry, const BlockSize& block)
{
    const double slenderness = std::atan(block.half_width / block.half_height);
    if (!quantity("slenderness").allows(slenderness)) {
        refuse(entry,
               fmt::format(" is {} m wide and {} m high: its slenderness {} is outside {}. Choose "
                           "a ratio closer to 1.",
                           2 * block.half_width, 2 * block.half_height, slenderness,
                           quantity("slenderness").interval));
    }
    return slenderness;
}

/// The entry that gives the slenderness: either plane.slenderness or block.
Entry slenderness_entry(const Entry& job, const Entry& plane)
{
    const auto slenderness = find(plane, "slenderness");
    const auto block = find(job, "block");
    if (slenderness && block) {
        refuse(*slenderness,
               " cannot be combined with [block], which also gives the slenderness. Remove one of "
               "them.");
    }
    if (block) {
        return *block;
    }
    return require(plane, "slenderness",
                   fmt::format("{} Or add [block] with width and height.", axis_advice));
}

/// With of = "maximum", r_max (Eq. 17), which decreases with the slenderness, must be positive, and
/// r must be in (0, 1]. A share above 1 is allowed: r_max is the maximum for a block on a flat
/// base, not a physical limit.
void check_restitution(const Entry& slenderness, const Entry& restitution, const Plane& plane)
{
    const double limit = std::asin(std::sqrt(2.0 / 3.0));
    const double last = plane.slenderness.last();
    const char* has_slenderness = plane.block ? " has the slenderness" : " reaches";
    if (plane.restitution_of == RestitutionOf::maximum && !(last < limit)) {
        refuse(slenderness,
               fmt::format("{} {} rad, but plane.restitution.of = \"maximum\" is defined only "
                           "below arcsin sqrt(2/3) = {} rad (Eq. 17). Choose a more slender "
                           "block, or give r itself: of = \"absolute\", or --restitution "
                           "of topple.",
                           has_slenderness, last, limit));
    }
    if (!(plane.restitution_ratio(plane.slenderness.size() - 1, 0) > 0)) {
        refuse(slenderness, fmt::format("{} {} rad, where the largest restitution times {} "
                                        "(plane.restitution[0]) is 0. Choose a more slender block.",
                                        has_slenderness, last, plane.restitution.first()));
    }
    const double largest = plane.restitution_ratio(0, plane.restitution.size() - 1);
    if (!(largest <= 1)) {
        refuse(restitution,
               fmt::format(" reaches r = {}, which is outside (0, 1], at the slenderness {} rad. A "
                           "block cannot gain energy at an impact.",
                           largest, plane.slenderness.first()));
    }
}

/// The strength under a record.
void read_strength(const Entry& entry, Plane& plane)
{
    const auto strength = only_one_of(entry, "scale", "pga");
    if (!strength) {
        require(entry, "scale", fmt::format("{} Or give pga [g].", axis_advice));
    }
    const bool is_scale = strength->key == "plane.scale";
    plane.amplitude_is = is_scale ? AmplitudeQuantity::scale : AmplitudeQuantity::pga;
    plane.amplitude = read_axis(*strength, quantity(name_of(plane.amplitude_is)));
}

/// The strength and the size under a record.
void read_record_axes(const Entry& job, const Entry& entry, Plane& plane)
{
    read_strength(entry, plane);
    const auto size = only_one_of(entry, "size", "frequency_parameter");
    const bool has_block = find(job, "block").has_value();
    if (size && has_block) {
        refuse(*size, " cannot be combined with [block], which also gives the size. Remove one of "
                      "them.");
    }
    plane.frequency_is = FrequencyQuantity::size;
    if (!size && !has_block) {
        require(entry, "size",
                fmt::format("{} Or give frequency_parameter [1/s], or [block] with width and "
                            "height.",
                            axis_advice));
    }
    if (size) {
        const bool is_size = size->key == "plane.size";
        plane.frequency_is =
            is_size ? FrequencyQuantity::size : FrequencyQuantity::frequency_parameter;
        plane.frequency = read_axis(*size, quantity(name_of(plane.frequency_is)));
    }
}

/// The strength and the frequency under a pulse. Period, frequency in Hz and peak acceleration
/// belong to a block of known size.
void read_pulse_axes(const Entry& entry, Plane& plane)
{
    const auto of_known_size = [&](const Entry& axis, const Quantity& rule) {
        const bool lacks_size =
            plane.list ? !plane.list->slenderness.empty() && plane.list->frequency_parameter.empty()
                       : !plane.size;
        if (lacks_size) {
            refuse(axis, plane.list ? " needs the dimensions of the blocks. Add the columns width "
                                      "and height, or size, in metres, to the table."
                                    : " needs the dimensions of the block. Add [block] with width "
                                      "and height, or the half diagonal plane.size, in metres.");
        }
        return read_axis(axis, rule);
    };
    if (const auto pga = only_one_of(entry, "amplitude", "pga"); pga && pga->key == "plane.pga") {
        plane.amplitude_is = AmplitudeQuantity::pga;
        plane.amplitude = of_known_size(*pga, quantity("pga"));
    } else {
        plane.amplitude =
            read_axis(require(entry, "amplitude",
                              fmt::format("{} Or give pga [g] and [block].", axis_advice)),
                      quantity("amplitude"));
    }
    only_one_of(entry, "frequency", "pulse_period");
    only_one_of(entry, "frequency", "pulse_frequency");
    only_one_of(entry, "pulse_period", "pulse_frequency");
    if (const auto period = find(entry, "pulse_period")) {
        plane.frequency_is = FrequencyQuantity::pulse_period;
        plane.frequency = of_known_size(*period, quantity("pulse_period"));
    } else if (const auto hertz = find(entry, "pulse_frequency")) {
        plane.frequency_is = FrequencyQuantity::pulse_frequency;
        plane.frequency = of_known_size(*hertz, quantity("pulse_frequency"));
    } else {
        plane.frequency = read_axis(
            require(entry, "frequency",
                    fmt::format("{} Or give pulse_period [s] or pulse_frequency [Hz], and [block].",
                                axis_advice)),
            quantity("frequency"));
    }
}

/// R [m] of all blocks under a pulse, if it is given.
std::optional<double> read_size_of_blocks(const Entry& entry, const Plane& plane)
{
    const auto size = find(entry, "size");
    if (!size) {
        return plane.block ? std::optional(half_diagonal(*plane.block)) : std::nullopt;
    }
    if (plane.block) {
        refuse(*size, " cannot be combined with [block], which also gives the size. Remove one of "
                      "them.");
    }
    const Axis axis = read_axis(*size, quantity("size"));
    if (axis.size() > 1) {
        refuse(*size, fmt::format(" has {} values, but under a pulse all blocks have the same "
                                  "size. Give one value, and pulse_period or pulse_frequency as "
                                  "an axis.",
                                  axis.size()));
    }
    return axis.first();
}

/// The axes that are not replaced by a list of blocks.
void read_axes_of_list(const Entry& job, Plane& plane)
{
    if (const auto block = find(job, "block")) {
        refuse(*block, " cannot be combined with [blocks], which lists all blocks. Remove one of "
                       "them.");
    }
    const bool is_recorded = plane.motions > 0;
    if (plane.list->has_own_motions) {
        if (const auto entry = find(job, "plane")) {
            refuse(*entry, " cannot be combined with a table whose rows have motions of their own. "
                           "Remove [plane], or the columns of the motions.");
        }
        return;
    }
    const Entry entry = require(job, "plane",
                                is_recorded ? "Add [plane] with scale or pga."
                                            : "Add [plane] with pga or amplitude, and pulse_period "
                                              "or frequency; or add them to the table as columns.");
    for (const std::string_view axis :
         {"restitution", "slenderness", "size", "frequency_parameter"}) {
        if (const auto found = find(entry, axis)) {
            refuse(*found, " cannot be combined with [blocks], whose table gives it. Remove it.");
        }
    }
    expect_table(entry,
                 is_recorded ? Names(list_keys_under_records) : Names(list_keys_under_pulses));
    if (is_recorded) {
        read_strength(entry, plane);
    } else {
        read_pulse_axes(entry, plane);
    }
}

} // namespace

void read_plane(const Entry& job, Plane& plane)
{
    const bool is_recorded = plane.motions > 0;
    if (plane.list) {
        read_axes_of_list(job, plane);
        return;
    }
    const Entry entry = require(
        job, "plane",
        is_recorded ? "Add [plane] with scale, size, restitution and slenderness."
                    : "Add [plane] with frequency, amplitude, restitution and slenderness.");
    expect_table(entry, is_recorded ? Names(record_plane_keys) : Names(pulse_plane_keys));
    if (is_recorded) {
        read_record_axes(job, entry, plane);
    }

    const Entry restitution = require(entry, "restitution", axis_advice);
    const bool is_table = restitution.node->is_table();
    if (const auto of = is_table ? find(restitution, "of") : std::nullopt) {
        plane.restitution_of = choice_of<RestitutionOf>(*of, restitution_of_names);
    }
    const bool is_share = plane.restitution_of == RestitutionOf::maximum;
    plane.restitution =
        read_axis(restitution, quantity(is_share ? "restitution_of_maximum" : "restitution"),
                  restitution_keys);

    const Entry slenderness = slenderness_entry(job, entry);
    if (slenderness.key == "block") {
        expect_table(slenderness, block_keys);
        plane.block = BlockSize{.half_width = read_half(slenderness, "width", "half_width"),
                                .half_height = read_half(slenderness, "height", "half_height")};
        plane.slenderness = Axis(AxisList{slenderness_of(slenderness, *plane.block)});
        if (is_recorded) {
            plane.frequency = Axis(AxisList{half_diagonal(*plane.block)});
        }
    } else {
        plane.slenderness = read_axis(slenderness, quantity("slenderness"));
    }
    check_restitution(slenderness, restitution, plane);
    if (!is_recorded) {
        plane.size = read_size_of_blocks(entry, plane);
        read_pulse_axes(entry, plane);
    }
}

} // namespace overturn
