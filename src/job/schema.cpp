#include "overturn/job/schema.hpp"

#include "overturn/text/is_one_of.hpp"

#include <fmt/format.h>

namespace overturn {

namespace {

/// Keys of a table of a job. The coordinates of points are keys, too; they follow from the table of
/// quantities.
struct Keys {
    std::string_view table; ///< empty: at the top
    Under motion;
    std::vector<std::string_view> names;
};

const Keys all_keys[] = {
    {"", Under::any_motion, {"title", "scene", "plane", "block", "blocks", "numerics", "output"}},
    {"scene", Under::pulse, {"pulse", "window", "cycles", "gamma", "nu"}},
    {"scene",
     Under::record,
     {"record", "units", "component", "second_component", "vertical", "time_step"}},
    {"scene", Under::any_motion, {"theory", "gravity", "motion_of"}},
    {"blocks", Under::any_motion, {"table"}},
    {"numerics", Under::any_motion, {"method", "tolerance", "resolve", "fill", "audit"}},
    {"output", Under::any_motion, {"fields"}}};

} // namespace

std::vector<std::string_view> keys_of(std::string_view table, std::optional<Under> motion)
{
    std::vector<std::string_view> names;
    for (const Keys& keys : all_keys) {
        if (keys.table == table && (!motion || keys.motion == *motion)) {
            names.insert(names.end(), keys.names.begin(), keys.names.end());
        }
    }
    for (const Quantity& quantity : all_quantities()) {
        if (quantity.is_coordinate() && quantity.role != Role::motion &&
            (table == "plane" || (table == "block" && quantity.role == Role::block))) {
            names.push_back(quantity.name);
        }
    }
    return names;
}

std::vector<std::string> override_keys()
{
    std::vector<std::string> all{"title"};
    for (const std::string_view table : keys_of("")) {
        for (const std::string_view name : keys_of(table)) {
            const std::string key = fmt::format("{}.{}", table, name);
            all.push_back(key);
            if (is_one_of(table, coordinate_tables)) {
                for (const std::string_view part : axis_keys) {
                    all.push_back(fmt::format("{}.{}", key, part));
                }
                if (name == "restitution") {
                    all.push_back(key + ".of");
                }
            }
        }
    }
    return all;
}

} // namespace overturn
