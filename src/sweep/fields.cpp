#include "overturn/sweep/fields.hpp"

namespace overturn {

FieldValues make_field_values(Field field, std::size_t points)
{
    switch (field) {
    case Field::region:
    case Field::status:
    case Field::region_below:
    case Field::region_above: return std::vector<std::uint8_t>(points);
    case Field::impacts: return std::vector<std::uint16_t>(points);
    case Field::steps: return std::vector<std::uint32_t>(points);
    default: return std::vector<double>(points);
    }
}

} // namespace overturn
