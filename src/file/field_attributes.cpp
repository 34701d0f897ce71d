#include "field_attributes.hpp"

#include "attributes.hpp"
#include "layout.hpp"

#include "overturn/sweep/boundary.hpp"

#include <fmt/format.h>

#include <string>
#include <variant>
#include <vector>

namespace overturn {

namespace {

using hdf5::write_attribute;

/// The values of the flags, in the type of the field.
void write_flags(hid_t dataset, Field field)
{
    const FieldTraits& traits = traits_of(field);
    if (traits.flags.empty()) {
        return;
    }
    std::string meanings;
    for (const FieldFlag& flag : traits.flags) {
        meanings += (meanings.empty() ? "" : " ") + std::string(flag.meaning);
    }
    std::visit(
        [&]<class Value>(std::vector<Value> values) {
            if constexpr (std::is_integral_v<Value>) {
                for (const FieldFlag& flag : traits.flags) {
                    values.push_back(Value(flag.value));
                }
                write_attribute(dataset, traits.has_bits ? "flag_masks" : "flag_values", values);
            }
        },
        make_field_values(field, 0));
    write_attribute(dataset, "flag_meanings", meanings);
}

} // namespace

void write_field_attributes(hid_t dataset, Field field, const Scene& scene,
                            const std::string& coordinates)
{
    const FieldTraits& traits = traits_of(field);
    write_attribute(dataset, "long_name", traits.long_name);
    write_attribute(dataset, "units", traits.units);
    // Readers interpret NaN as missing, so it can be declared; a fill value declared on an integer
    // field would make them convert codes to floats.
    const auto fill = layout::stored_as(field).fill;
    if (const auto* not_a_number = std::get_if<double>(&fill)) {
        write_attribute(dataset, "_FillValue", *not_a_number);
    }
    if (field == Field::flip_amplitude) {
        const FlipSearch search = flip_search(scene);
        write_attribute(dataset, "width", search.flip_width);
        write_attribute(dataset, "finest_step", search.finest_step);
    }
    write_flags(dataset, field);
    write_attribute(dataset, "comment", traits.comment);
    write_attribute(dataset, "coordinates", coordinates);
}

} // namespace overturn
