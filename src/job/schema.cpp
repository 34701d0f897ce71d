#include "overturn/job/schema.hpp"

#include "overturn/job/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace overturn {

namespace {

constexpr std::array keys{
    Key{"", "title"},
    Key{"", "scene"},
    Key{"", "plane"},
    Key{"", "block"},
    Key{"", "blocks"},
    Key{"", "numerics"},
    Key{"", "output"},
    Key{"scene", "pulse", Under::pulse},
    Key{"scene", "record", Under::record},
    Key{"scene", "theory"},
    Key{"scene", "window", Under::pulse},
    Key{"scene", "cycles", Under::pulse},
    Key{"scene", "gamma", Under::pulse},
    Key{"scene", "nu", Under::pulse},
    Key{"scene", "units", Under::record},
    Key{"scene", "component", Under::record},
    Key{"scene", "second_component", Under::record},
    Key{"scene", "vertical", Under::record},
    Key{"scene", "time_step", Under::record},
    Key{"scene", "gravity"},
    Key{"blocks", "table"},
    Key{"numerics", "method"},
    Key{"numerics", "tolerance"},
    Key{"numerics", "resolve"},
    Key{"numerics", "fill"},
    Key{"numerics", "audit"},
    Key{"output", "fields"},
};

} // namespace

std::vector<std::string_view> keys_of(std::string_view table)
{
    std::vector<std::string_view> names;
    for (const Key& key : keys) {
        if (key.table == table) {
            names.push_back(key.name);
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

std::vector<std::string_view> scene_keys_of(Under motion)
{
    std::vector<std::string_view> names;
    for (const Key& key : keys) {
        if (key.table == "scene" && key.motion == motion) {
            names.push_back(key.name);
        }
    }
    return names;
}

std::span<const std::string_view> axis_keys()
{
    static constexpr std::array<std::string_view, 5> names{"values", "first", "last", "count",
                                                           "spacing"};
    return names;
}

std::vector<std::string_view> axis_names()
{
    return keys_of("plane");
}

std::vector<std::string> override_keys()
{
    std::vector<std::string> all{"title"};
    for (const std::string_view table : keys_of("")) {
        for (const std::string_view name : keys_of(table)) {
            const std::string key = fmt::format("{}.{}", table, name);
            all.push_back(key);
            if (find_quantity(name) != nullptr &&
                std::ranges::count(coordinate_tables, table) > 0) {
                for (const std::string_view part : axis_keys()) {
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
