// JSON for programs. Numbers that are not finite are null, because JSON has none.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace overturn {

using Json = nlohmann::ordered_json;

/// Invalid UTF-8, as in names of files, is replaced.
inline std::string text_of(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

inline Json if_finite(double value)
{
    return std::isfinite(value) ? Json(value) : Json();
}

inline Json if_known(const std::optional<double>& value)
{
    return value ? Json(*value) : Json();
}

inline Json if_named(const std::string& name)
{
    return name.empty() ? Json() : Json(name);
}

} // namespace overturn
