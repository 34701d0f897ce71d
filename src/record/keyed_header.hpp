// A header of lines that begin with keys, such as `Dir.   E-W` or `NDATA: 19128`, in any order. It
// ends before the first line that begins with a number.
#pragma once

#include "lines.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

class KeyedHeader {
public:
    /// Takes the lines of the header.
    explicit KeyedHeader(Lines& lines);

    /// A line that begins with the key, and what follows the key.
    struct Entry {
        Lines lines; ///< at this line
        std::string_view value;
    };

    /// The line that begins with this key, ignoring case; nullopt if there is none. Refuses several
    /// lines.
    std::optional<Entry> find(std::string_view key) const;

    /// The same. Refuses a header without this key.
    Entry required(std::string_view key) const;

    /// The values of the keys that the header has, separated by commas.
    std::string values_of(std::initializer_list<std::string_view> keys) const;

    std::vector<std::string> kept() const { return kept_lines(before_, last_.number()); }

private:
    Lines before_;
    Lines last_; ///< at the last line of the header
};

} // namespace overturn
