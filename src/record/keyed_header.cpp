#include "keyed_header.hpp"

#include "numbers.hpp"

namespace overturn {

KeyedHeader::KeyedHeader(Lines& lines) : before_(lines), last_(lines)
{
    for (Lines ahead = lines; ahead.next() && !is_number(first_word(ahead.line()));) {
        last_ = ahead;
    }
    lines = last_;
}

std::optional<KeyedHeader::Entry> KeyedHeader::find(std::string_view key) const
{
    std::optional<Entry> found;
    for (Lines lines = before_; lines.number() < last_.number() && lines.next();) {
        const std::string_view line = trimmed(lines.line());
        if (!lower(line.substr(0, key.size())).starts_with(lower(key))) {
            continue;
        }
        if (found) {
            lines.refuse("the header states {} for the second time; the first is line {}. Remove "
                         "one of them.",
                         quoted_bytes(key), found->lines.number());
        }
        found = Entry{lines, trimmed(line.substr(key.size()))};
    }
    return found;
}

KeyedHeader::Entry KeyedHeader::required(std::string_view key) const
{
    const auto found = find(key);
    if (!found) {
        last_.refuse("the header, which ends with this line, has no line that begins with {}. Give "
                     "the file as it was published.",
                     quoted_bytes(key));
    }
    return *found;
}

std::string KeyedHeader::values_of(std::initializer_list<std::string_view> keys) const
{
    std::string values;
    for (const std::string_view key : keys) {
        const auto entry = find(key);
        if (entry && !entry->value.empty()) {
            values += (values.empty() ? "" : ", ") + std::string(entry->value);
        }
    }
    return values;
}

} // namespace overturn
