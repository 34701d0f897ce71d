// Parts of the text of a job that commands make from their options.
#pragma once

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

/// The keys `pulse` and `shape` of [scene]; shape: the path of a table, or empty.
inline std::string pulse_lines(const std::string& pulse, const std::string& shape)
{
    return fmt::format("pulse = {}\n{}", quoted_utf8(pulse),
                       shape.empty() ? "" : fmt::format("shape = {}\n", quoted_utf8(shape)));
}

/// The key `component` of [scene]; empty without a component.
inline std::string component_line(const std::string& component)
{
    if (component.empty()) {
        return "";
    }
    const bool is_number = component.find_first_not_of("0123456789") == std::string::npos &&
                           !component.starts_with('0');
    return fmt::format("component = {}\n", is_number ? component : quoted_utf8(component));
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
