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
    for (std::size_t i = 0; i < count; ++i) {
        if (!lines.next()) {
            lines.refuse("the file ends within the header. Give the complete file.");
        }
    }
    return lines;
}

bool next_text(Lines& lines)
{
    return next_line(lines, [](std::string_view line) { return !trimmed(line).empty(); });
}

bool next_with(Lines& lines, std::string_view words)
{
    return next_line(lines, [&](std::string_view line) { return contains(line, words); });
}

bool is_at_end(Lines lines)
{
    return !next_text(lines);
}

std::vector<std::string> kept_lines(Lines lines, std::size_t last,
                                    bool (*is_kept)(std::string_view))
{
    constexpr std::size_t most = std::size_t(1) << 20; // [bytes], with line ends
    std::vector<std::string> kept;
    std::size_t size = 0;
    while (lines.number() < last && lines.next()) {
        if (!is_kept(lines.line())) {
            continue;
        }
        size += lines.line().size() + 1;
        if (size > most) {
            lines.refuse(
                "header and comments are larger than {} KiB, the maximum. Remove comments.",
                most >> 10);
        }
        kept.emplace_back(lines.line());
    }
    return kept;
}

std::string_view first_word(std::string_view text)
{
    return trimmed(text).substr(0, trimmed(text).find_first_of(" \t"));
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

std::vector<std::string_view> words_of(std::string_view text, std::string_view separators)
{
    std::vector<std::string_view> words;
    for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != text.npos;) {
        words.push_back(text.substr(begin, text.find_first_of(separators, begin) - begin));
        begin += words.back().size();
    }
    return words;
}

} // namespace overturn
