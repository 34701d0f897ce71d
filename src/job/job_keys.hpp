// The keys of a job, table by table.
#pragma once

#include <array>
#include <string_view>

namespace overturn {

inline constexpr std::array<std::string_view, 7> job_keys{"title",  "scene",    "plane", "block",
                                                          "blocks", "numerics", "output"};
inline constexpr std::array<std::string_view, 12> scene_keys{
    "pulse", "record", "theory",    "window",   "cycles",    "gamma",
    "nu",    "units",  "component", "vertical", "time_step", "gravity"};
inline constexpr std::array<std::string_view, 5> pulse_keys{"pulse", "window", "cycles", "gamma",
                                                            "nu"};
inline constexpr std::array<std::string_view, 4> record_keys{"component", "vertical", "time_step",
                                                             "units"};
inline constexpr std::array<std::string_view, 8> pulse_plane_keys{
    "frequency", "pulse_period", "pulse_frequency", "amplitude",
    "pga",       "restitution",  "slenderness",     "size"};
inline constexpr std::array<std::string_view, 6> record_plane_keys{
    "scale", "pga", "size", "frequency_parameter", "restitution", "slenderness"};
inline constexpr std::array<std::string_view, 5> list_keys_under_pulses{
    "frequency", "pulse_period", "pulse_frequency", "amplitude", "pga"};
inline constexpr std::array<std::string_view, 2> list_keys_under_records{"scale", "pga"};
inline constexpr std::array<std::string_view, 5> axis_keys{"values", "first", "last", "count",
                                                           "spacing"};
inline constexpr std::array<std::string_view, 6> restitution_keys{"values", "first",   "last",
                                                                  "count",  "spacing", "of"};
inline constexpr std::array<std::string_view, 4> block_keys{"width", "height", "half_width",
                                                            "half_height"};
inline constexpr std::array<std::string_view, 1> blocks_keys{"table"};
inline constexpr std::array<std::string_view, 3> numerics_keys{"method", "tolerance", "resolve"};
inline constexpr std::array<std::string_view, 1> output_keys{"fields"};

} // namespace overturn
