// What the channels of V2A, CSMIP and COSMOS files have in common.
#pragma once

#include "numbers.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// Refuses a line that is not the title of a corrected accelerogram.
void expect_corrected_accelerogram(const Lines& lines);

/// What the header states of its channel.
struct ChannelName {
    std::string direction; ///< such as "340 deg"
    std::string place;     ///< of the sensor, such as "roof"
};

/// The name in the first line such as `Chan  1:  90 Deg    Location: Roof: SW`, `Chan  2: Up
/// Ground` or `Sta Chan  1: 340 deg (Rcrdr Chan 1) Location: roof`, before the line `end`. The
/// direction follows the number of the channel, and ends before a bracket, two blanks, or the
/// place. Empty if there is none.
ChannelName channel_name(Lines header, std::size_t end);

/// Takes the values that the current line announces, such as `100 Real-header values follow on 20
/// lines, Format= (5F15.6)`. usual: the columns if the line states no format; refused without.
std::vector<double> take_announced(Lines& lines, std::string_view name,
                                   const std::optional<Columns>& usual = {});

/// The same as they are printed, in the format of the line.
std::vector<Printed> take_announced_as_printed(Lines& lines, std::string_view name);

} // namespace overturn
