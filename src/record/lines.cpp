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
            lines.refuse(
                "the file ends after {} of the {} lines of the header. Give the complete file.", i,
                count);
        }
        add(lines);
    }
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
