// What commands print: lines, rows of a name and a text, warnings and errors, and numbers in
// readable units.
#pragma once

#include "overturn/text/error.hpp"
#include "overturn/text/motion_words.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// Prints a line and flushes it, so that it appears in a log at once, before the progress of a run.
/// Errors are ignored: a run continues if the reader of its log ends.
inline void print_line(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

inline void print_row(std::string_view name, std::string_view text)
{
    fmt::print("{:<12} {}\n", name, text);
}

/// The row of a coordinate; `unit` is appended to the values.
inline void print_axis(std::string_view name, std::int64_t size, double first, double last,
                       std::string_view unit)
{
    const bool is_share = name == "restitution_of_maximum"; // too long for the column of names
    print_row(is_share ? "restitution" : name,
              fmt::format("{}{}{}",
                          size == 1 ? fmt::to_string(first)
                                    : fmt::format("{} values from {} to {}", size, first, last),
                          unit, is_share ? ", of the maximum" : ""));
}

/// Three digits and a prefix: "640", "1.20 k", "3.00 M", "1.00 G".
std::string human_count(double count);

/// "310 ms", "1.25 s", "12 s", "2 min 05 s", "3 h 07 min", "2 d 04 h"; seconds [s] >= 0.
std::string human_duration(double seconds);

/// "640 bytes", "12.0 kB", "3.60 GB": powers of 1000.
std::string human_bytes(double bytes);

/// Prints a row on the motion of a floor; nothing about that of the ground.
void print_motion_of(std::string_view name, MotionOf motion_of);

/// Prints each as `overturn: warning: text.` to stderr.
void print_warnings(const std::vector<std::string>& warnings);

/// The exit code of an Error, otherwise exit_code::internal.
int exit_code_of(const std::exception& error);

/// The message of an exception, safe to print on a terminal.
std::string message_of(const std::exception& error);

/// Prints `overturn: message` to stderr and returns the exit code.
int print_error(const std::exception& error);

/// `when` is appended to "stopped by a signal".
Error stopped_by_signal(const std::string& when);

} // namespace overturn
