// The regions of a spectrum and their names (Fig. 4). The criteria are in energy_criteria.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace overturn {

/// The regions of a spectrum; F+ and F- are the paper's "failure during the forced stage". U2+ and
/// U2-, overturning after two impacts, exist only for blocks with two different sides.
enum class Region : std::uint8_t {
    S = 0,
    S_plus = 1,
    S_minus = 2,
    U0_plus = 3,
    U0_minus = 4,
    U1_plus = 5,
    U1_minus = 6,
    F_plus = 7,
    F_minus = 8,
    U2_plus = 9,
    U2_minus = 10,
    undecided = 254,
    not_computed = 255
};

/// Names in result files, in the order of the codes.
inline constexpr std::array<std::string_view, 11> region_names{
    "S", "S+", "S-", "U0+", "U0-", "U1+", "U1-", "F+", "F-", "U2+", "U2-"};

constexpr std::string_view name_of(Region region)
{
    const auto code = std::size_t(region);
    return code < region_names.size()    ? region_names[code]
           : region == Region::undecided ? "undecided"
                                         : "not_computed";
}

constexpr bool is_safe(Region region)
{
    return region <= Region::S_minus;
}
constexpr bool is_unsafe(Region region)
{
    return region >= Region::U0_plus && region <= Region::U2_minus;
}

constexpr bool is_decided(Region region)
{
    return is_safe(region) || is_unsafe(region);
}

/// Whether the block overturns to its positive side.
constexpr bool falls_to_plus(Region region)
{
    return region == Region::U0_plus || region == Region::U1_plus || region == Region::F_plus ||
           region == Region::U2_plus;
}

} // namespace overturn
