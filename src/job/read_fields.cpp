#include "read_steps.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace overturn {

std::vector<Field> read_fields(const Entry& job)
{
    const auto entry = find(table_of(job, "output"), "fields");
    if (!entry) {
        return {Field::region};
    }
    const std::size_t size = array_size(
        *entry, "an array of strings, such as [\"region\"]",
        fmt::format("Give at least one of {}.", fmt::join(spectrum_field_names(), ", ")));
    std::vector<Field> fields;
    for (std::size_t i = 0; i < size; ++i) {
        const auto field = choice_of<Field>(element(*entry, i), spectrum_field_names());
        if (std::ranges::count(fields, field) > 0) {
            refuse(element(*entry, i), " = \"{}\" is listed twice. List each field once.",
                   name_of(field));
        }
        fields.push_back(field);
    }
    return fields;
}

} // namespace overturn
