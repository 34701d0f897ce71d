#include "lines.hpp"

namespace overturn {

bool Lines::next()
{
    if (rest_.empty()) {
        return false;
    }
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
    while (line_.ends_with('\r')) {
        line_.remove_suffix(1);
    }
    ++number_;
    return true;
}

Lines ahead_by(Lines lines, std::size_t count)
{
    while (count > 0 && lines.next()) {
        --count;
    }
    return lines;
}

bool next_text(Lines& lines)
{
    while (lines.next()) {
        if (!trimmed(lines.line()).empty()) {
            return true;
        }
    }
    return false;
}

bool is_at_end(Lines lines)
{
    return !next_text(lines);
}

void Header::add(const Lines& lines)
{
    constexpr std::size_t most = std::size_t(1) << 20; // [bytes], with line ends
    size_ += lines.line().size() + 1;
    if (size_ > most) {
        lines.refuse("header and comments are larger than {} KiB, the maximum. Remove comments.",
                     most >> 10);
    }
    kept_.emplace_back(lines.line());
}

void Header::take(Lines& lines, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (!lines.next()) {
            if (count == 1) {
                lines.refuse("the file ends within the header. Give the complete file.");
            }
            lines.refuse(
                "the file ends after {} of the {} lines of the header. Give the complete file.", i,
                count);
        }
        add(lines);
    }
}

void Header::take_text(Lines& lines)
{
    do {
        take(lines, 1);
    } while (trimmed(lines.line()).empty());
}

bool Header::take_through(Lines& lines, std::string_view words)
{
    while (lines.next()) {
        add(lines);
        if (contains(lines.line(), words)) {
            return true;
        }
    }
    return false;
}

std::string_view first_word(std::string_view text)
{
    return trimmed(text).substr(0, trimmed(text).find_first_of(" \t"));
}

std::string lower(std::string_view text)
{
    std::string result(text);
    for (char& letter : result) {
        letter = 'A' <= letter && letter <= 'Z' ? char(letter - 'A' + 'a') : letter;
    }
    return result;
}

bool contains(std::string_view text, std::string_view words)
{
    return place_after(text, words) != text.npos;
}

std::size_t place_after(std::string_view text, std::string_view words)
{
    const std::size_t place = lower(text).find(lower(words));
    return place == text.npos ? place : place + words.size();
}

} // namespace overturn
