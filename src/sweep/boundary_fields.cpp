#include "overturn/sweep/boundary.hpp"

namespace overturn {

std::vector<Field> boundary_fields(const Scene& scene, const Plane& plane)
{
    std::vector<Field> fields{Field::flip_amplitude, Field::region_below, Field::region_above};
    if (scene.is_recorded() || plane.size) {
        fields.push_back(Field::flip_pga);
    }
    if (scene.is_recorded()) {
        fields.insert(fields.end(), line_fields.begin(), line_fields.end());
    }
    return fields;
}

} // namespace overturn
