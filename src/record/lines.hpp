// The lines of a file, one after another, and the refusal of a line.
#pragma once

#include "overturn/text/error.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace overturn {

/// A cursor over the lines of a text. A copy looks ahead. The text and the name must outlive it.
class Lines {
public:
    Lines(std::string_view text, const std::string& name) : rest_(text), name_(&name) {}

    /// Proceeds to the next line; false if there is none.
    bool next();

    /// The current line without its end, which is LF after any number of CR.
    std::string_view line() const { return line_; }

    /// The same in quotes and without blanks around it, for messages.
    std::string quoted() const { return quoted_bytes(trimmed(line_)); }

    /// Counted from 1; 0 before the first line.
    std::size_t number() const { return number_; }

    /// The file and the current line, as in "a.txt:3".
    std::string place() const { return fmt::format("{}:{}", *name_, number_); }

    /// Throws an Error with the file and the current line. The reason is formatted as by
    /// fmt::format().
    template <class... Arguments>
    [[noreturn]] void refuse(fmt::format_string<Arguments...> reason,
                             Arguments&&... arguments) const
    {
        throw Error(exit_code::job, "{}: {}", place(),
                    fmt::format(reason, std::forward<Arguments>(arguments)...));
    }

    /// The same for the file as a whole.
    template <class... Arguments>
    [[noreturn]] void refuse_file(fmt::format_string<Arguments...> reason,
                                  Arguments&&... arguments) const
    {
        throw Error(exit_code::job, "{}: {}", *name_,
                    fmt::format(reason, std::forward<Arguments>(arguments)...));
    }

private:
    std::string_view rest_;
    std::string_view line_;
    std::size_t number_ = 0;
    const std::string* name_;
};

/// A cursor that is `count` lines ahead. Refuses a file that ends earlier, within its header.
Lines ahead_by(Lines lines, std::size_t count);

/// Proceeds to the next line that is wanted; false if there is none.
template <class IsWanted>
bool next_line(Lines& lines, const IsWanted& is_wanted)
{
    while (lines.next()) {
        if (is_wanted(lines.line())) {
            return true;
        }
    }
    return false;
}

/// The same for a line that is not blank.
bool next_text(Lines& lines);

/// The same for a line that contains the words, ignoring case.
bool next_with(Lines& lines, std::string_view words);

/// Whether only blank lines follow.
bool is_at_end(Lines lines);

/// The next lines, up to line `last`, of those that are kept. Refuses more than 1 MiB, so that no
/// file can fill the memory with short lines.
std::vector<std::string> kept_lines(
    Lines lines, std::size_t last,
    bool (*is_kept)(std::string_view) = [](std::string_view) { return true; });

/// The text up to the first blank, without blanks before it.
std::string_view first_word(std::string_view text);

/// Whether the text contains the words, ignoring case.
bool contains(std::string_view text, std::string_view words);

/// The place after the first occurrence of the words, ignoring case; npos if there is none.
std::size_t place_after(std::string_view text, std::string_view words);

/// The words between separators.
std::vector<std::string_view> words_of(std::string_view text, std::string_view separators);

} // namespace overturn
