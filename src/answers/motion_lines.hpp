// Parts of the text of a job that commands make from their options.
#pragma once

#include "overturn/answers/motion_request.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/utf8.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace overturn {

/// The name of a file or component, or another text, as a string of TOML. Throws Error if
/// it is not UTF-8.
inline std::string quoted_utf8(const std::string& text)
{
    if (!is_utf8(text)) {
        throw Error(exit_code::usage, "{} is not UTF-8. Rename the file.", as_utf8(text));
    }
    return in_quotes(text);
}

/// [scene], and [plane] with the strength of the motion, which is 0 if none is asked for. record:
/// the value of this key in TOML; empty: a pulse.
inline std::string motion_lines(const MotionRequest& request, const std::string& record)
{
    std::string text = "[scene]\n";
    if (!record.empty()) {
        text += fmt::format("record = {}\n", record);
    } else {
        text += fmt::format("pulse = {}\n", quoted_utf8(request.pulse));
        text +=
            request.shape.empty() ? "" : fmt::format("shape = {}\n", quoted_utf8(request.shape));
    }
    if (const std::string& component = request.component; !component.empty()) {
        const bool is_number = component.find_first_not_of("0123456789") == std::string::npos &&
                               !component.starts_with('0');
        text += fmt::format("component = {}\n", is_number ? component : quoted_utf8(component));
    }
    return text + (request.scale || (!record.empty() && !request.pga)
                       ? fmt::format("[plane]\nscale = {}\n", request.scale.value_or(0))
                       : fmt::format("[plane]\npga = {}\n", request.pga.value_or(0)));
}

/// Refuses keys other than those of [scene] that no option has.
inline void expect_keys_of_scene(const std::vector<std::string>& overrides)
{
    for (const std::string& argument : overrides) {
        if (!argument.starts_with("scene.") || argument.starts_with("scene.pulse") ||
            argument.starts_with("scene.shape") || argument.starts_with("scene.record")) {
            throw Error(exit_code::usage,
                        "--set takes keys of [scene] here, such as scene.gravity. The other "
                        "options give the block and the motion.");
        }
    }
}

} // namespace overturn
