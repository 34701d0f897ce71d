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

/// The direction in the first line such as `Chan  1:  90 Deg` or `Sta Chan  1: 340 deg (Rcrdr Chan
/// 1) Location: roof`, before the line `end`: the text between the last colon before a bracket and
/// this bracket. Empty if there is none.
std::string channel_name(Lines header, std::size_t end);

/// Takes the values that the current line announces, such as `100 Real-header values follow on 20
/// lines, Format= (5F15.6)`. usual: the columns if the line states no format; refused without.
std::vector<double> take_announced(Lines& lines, std::string_view name,
                                   const std::optional<Columns>& usual = {});

/// The same as they are printed, in the format of the line.
std::vector<Printed> take_announced_as_printed(Lines& lines, std::string_view name);

} // namespace overturn
