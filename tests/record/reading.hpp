// Reading of records from texts in tests.
#pragma once

#include "overturn/record/read_record.hpp"
#include "support/refusal.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace overturn {

using Values = std::vector<double>;

inline constexpr RecordOptions in_g{.time_step = {}, .unit = AccelerationUnit::g};

/// The only component of a text.
inline RecordComponent component_of(std::string_view text, const RecordOptions& options = {})
{
    RecordFile file = parse_record(text, "a.txt", options);
    EXPECT_EQ(file.components.size(), 1);
    return std::move(file.components.at(0));
}

/// The message of the refusal of a text; empty if it is accepted.
inline std::string refusal_of(std::string_view text, const RecordOptions& options = {})
{
    return refusal(exit_code::job, [&] { parse_record(text, "a.txt", options); });
}

/// A text that is refused with a message.
struct Refusal {
    const char* name;
    std::string text;
    const char* message;
};

inline void expect_refused(const std::vector<Refusal>& refusals)
{
    for (const auto& [name, text, message] : refusals) {
        EXPECT_EQ(refusal_of(text), message) << name;
    }
}

inline std::string with_line_ends(std::string_view text, const std::string& end)
{
    std::string result;
    for (const char letter : text) {
        result += letter == '\n' ? end : std::string(1, letter);
    }
    return result;
}

/// Ends of published files: of DOS, and those that fill a block of a tape or a disk.
inline std::vector<std::string> paddings()
{
    std::vector<std::string> all;
    for (const std::string& fill : {std::string("\x1a"), std::string(1, '\0')}) {
        for (const char* end : {"", "\n", "\r\n", " ", "\t\r\n\n"}) {
            all.push_back(fill + end);
            all.push_back(fill + end + fill);
            all.push_back(end + fill + fill + fill + fill + end);
        }
    }
    all.push_back("\x1a" + std::string(511, '\0'));
    return all;
}

/// The text with the first occurrence of some words replaced.
inline std::string with(std::string text, std::string_view words, std::string_view others)
{
    const std::size_t place = text.find(words);
    EXPECT_NE(place, text.npos) << words;
    return text.replace(place, words.size(), others);
}

} // namespace overturn
