#include "comment.hpp"

#include "comment_words.hpp"
#include "stated_unit.hpp"

#include "overturn/text/parse_number.hpp"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace overturn {

namespace {

/// In few spellings, without the marks of a comment and the points of sentences.
std::string text_of_comment(std::string_view line)
{
    line = trimmed(line);
    line.remove_prefix(std::min(line.find_first_not_of(line.substr(0, 1)), line.size()));
    std::string text = in_few_spellings(line);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool precedes_digit = std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0;
        if (text[i] == '.' && !precedes_digit) {
            text[i] = ' ';
        }
    }
    boost::algorithm::replace_all(text, "%", " percent ");
    return text;
}

constexpr std::string_view between_words = " ,;:=()[]{}<>|\"_-#";

/// The words of a comment around one that may be a unit.
struct Place {
    std::string_view text;
    const std::vector<std::string_view>& words; ///< parts of the text
    std::size_t index;                          ///< of the word that may be a unit

    /// A word before or after this one; empty if there is none.
    std::string_view word(int offset = 0) const
    {
        const std::size_t i = index + std::size_t(offset);
        return i < words.size() ? words[i] : "";
    }

    /// The text between such a word and the previous one.
    std::string_view gap_before(int offset = 0) const
    {
        const std::string_view next = word(offset);
        const std::string_view previous = word(offset - 1);
        const auto from = previous.empty() ? text.begin() : previous.end();
        return next.empty() ? next : std::string_view(from, next.begin());
    }

    /// Whether a unit is expected here: as the whole comment, in brackets, after "in", and in the
    /// name of a column, such as acc_x_cm.
    bool is_labelled() const
    {
        const auto begin = words.begin();
        return words.size() == 1 || gap_before().find_first_of("([{<") != std::string_view::npos ||
               is_acceleration(word(-1)) || introduces_unit(word(-1)) ||
               is_one_of(word(-1), {"t", "time"}) ||
               (gap_before() == "_" &&
                std::any_of(begin, begin + std::ptrdiff_t(index), is_acceleration));
    }

    /// Whether the word is a unit that must be the given one, also one that is not known, as in
    /// "units: furlongs".
    bool states_unit() const
    {
        const int label = is_one_of(word(-1), {"are", "in", "is", "of"}) ? -2 : -1;
        const bool follows_units = is_one_of(word(label), {"unit", "units"});
        return is_unit(unit_of_word(word())) || (word() == "scaled" && word(1) == "by") ||
               (is_labelled() && is_length(word())) ||
               (follows_units && !begins_with_number(word()) && !is_acceleration(word()) &&
                !is_one_of(word(), {"are", "in", "is", "of", "s", "t", "time"}));
    }

    /// The words that say of what this is the unit, the nearest first: those before it, back to a
    /// comma or a semicolon, without numbers and words such as "in" and "units".
    std::vector<std::string_view> subject() const
    {
        constexpr int most = 20; // of a long comment
        std::vector<std::string_view> names;
        for (int i = 0; i > -most && !word(i - 1).empty() &&
                        gap_before(i).find_first_of(",;") == std::string_view::npos;
             --i) {
            const std::string_view name = word(i - 1);
            if (!begins_with_number(name) && !introduces_unit(name) &&
                !is_one_of(name, {"is", "are"})) {
                names.push_back(name);
            }
        }
        return names;
    }

    /// Whether the unit is that of another quantity than the samples, as in "Depth (km): 10", "Vs30
    /// [m/s]", "Peak acceleration (gal) 343" and "1.25 V/g".
    bool is_of_other_quantity() const
    {
        if (is_sensitivity(word()) || (word(-1).ends_with('/') && is_sensitivity(word(-1)))) {
            return true;
        }
        return is_unit(unit_of_word(word())) && !is_length_or_velocity(word())
                   ? is_acceleration_of_other()
                   : is_length_of_other();
    }

    /// Whether this word names velocities or displacements that the file may contain.
    bool is_other_motion() const
    {
        return (word().starts_with("velocit") || word().starts_with("displacement")) &&
               !is_key(1) && !is_key(2) && !std::ranges::any_of(subject(), is_of_wave_or_fault);
    }

    /// Whether the unit is that of a value, as in "PGA 0.35 g" and "v = 3 m/s", and not a multiple.
    bool is_value() const
    {
        const int number = begins_with_number(word()) ? 0 : -1;
        const std::string_view before = word(number - 1);
        return has_number() && !introduces_unit(before) &&
               (gap_before(number).find_first_of(":=") != std::string_view::npos ||
                is_one_of(before, {"g", "max", "maximum", "peak", "pga", "vs30"}));
    }

    /// Whether g is defined, as in g = 9.81 and gravity (m/s2): 9.81.
    bool is_defined() const
    {
        const bool is_stated = gap_before(1).find('=') != std::string_view::npos ||
                               (has_size_of_gravity(word(1)) && !gap_before(1).empty()) ||
                               (has_size_of_gravity(word(2)) && unit_named(word(1)).has_value());
        return is_one_of(word(), {"g", "gravity"}) && is_stated && !has_factor() &&
               !is_acceleration(word(-1)) && !introduces_unit(word(-1));
    }

    /// Whether a factor changes the unit, as in 0.01 g, percent of g, and g times 2.
    bool has_factor() const
    {
        const bool is_share = word(-1) == "of" && begins_with_number(word(-2));
        return has_number() || is_share || is_factor(word(word(-1) == "of" ? -2 : -1)) ||
               is_factor(word(1)) || (word(1) == "x" && begins_with_number(word(2)));
    }

    /// Whether a number precedes the unit, or touches it.
    bool has_number() const
    {
        return begins_with_number(word()) ||
               (begins_with_number(word(-1)) && trimmed(gap_before()).empty());
    }

private:
    /// Whether a number before the unit is a factor, as in "in units of 0.01 g".
    bool has_introduced_number() const
    {
        const int number = begins_with_number(word()) ? 0 : -1;
        const std::string_view before = word(number - (word(number - 1) == "of" ? 2 : 1));
        return has_number() && is_one_of(before, {"in", "unit", "units"});
    }

    /// Whether a value of this unit is before or behind it.
    bool has_value() const
    {
        return (has_number() && !has_introduced_number()) ||
               (begins_with_number(word(1)) &&
                gap_before(1).find_first_of(",;") == std::string_view::npos);
    }

    /// Whether the number at this offset is the value of the words before it: "count: 4000".
    bool is_key(int number) const
    {
        return begins_with_number(word(number)) &&
               gap_before(number).find_first_of(":=") != std::string_view::npos;
    }

    /// Whether a unit of acceleration, or one that is not known, is one of a peak or the like.
    bool is_acceleration_of_other() const
    {
        const std::vector<std::string_view> names = subject();
        if (names.empty() || has_introduced_number()) {
            return false;
        }
        if (is_one_of(word(), {"count", "counts"}) && is_key(1)) { // of the samples
            return true;
        }
        const auto any = [&](bool (*is)(std::string_view)) {
            return std::ranges::any_of(names, is);
        };
        return has_value()
                   ? is_one_of(names[0], {"g", "gravity"}) || (any(is_peak) && !any(is_factor)) ||
                         (any(is_of_instrument) && !is_contents(names[0]))
                   : is_peak(names[0]) && !any(is_acceleration);
    }

    /// Whether a unit of length, velocity or time is one of a distance, a wave or the like.
    bool is_length_of_other() const
    {
        const std::vector<std::string_view> names = subject();
        if (names.empty()) {
            return has_number() && !has_introduced_number() && words.size() > 2;
        }
        if (is_velocity_or_displacement(names[0])) {
            return std::ranges::any_of(names, is_of_wave_or_fault) ||
                   (begins_with_number(word(1)) && word(2).empty());
        }
        return has_value() ? !is_contents(names[0])
                           : !is_column(names[0]) && !std::ranges::any_of(names, is_acceleration);
    }
};

} // namespace

bool is_comment(std::string_view line)
{
    const std::string_view text = trimmed(line);
    return text.starts_with('#') || text.starts_with('%');
}

std::optional<std::string_view> value_of(std::string_view comment, std::string_view key)
{
    const std::size_t equals = comment.find('=');
    std::string_view name = trimmed(comment.substr(0, equals));
    name.remove_prefix(std::min(name.find_first_not_of("#%"), name.size()));
    if (equals == comment.npos || trimmed(name) != key) {
        return std::nullopt;
    }
    const std::string_view value = trimmed(comment.substr(equals + 1));
    const bool is_quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
    return is_quoted ? value.substr(1, value.size() - 2) : value;
}

bool next_content(Lines& lines)
{
    return next_line(
        lines, [](std::string_view line) { return !trimmed(line).empty() && !is_comment(line); });
}

void expect_unit(const Lines& comment, AccelerationUnit unit)
{
    const std::string text = text_of_comment(comment.line());
    const std::vector<std::string_view> words = words_of(text, between_words);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const Place place{text, words, i};
        if (place.is_labelled() &&
            is_one_of(place.word(), {"ms", "millis", "us", "micros", "min", "minutes", "hours"}) &&
            !place.is_of_other_quantity()) {
            comment.refuse("the comment {} states times in {}. Give times in seconds.",
                           comment.quoted(), place.word());
        }
        if (!place.states_unit() || place.is_value() || place.is_defined() ||
            place.is_of_other_quantity()) {
            continue;
        }
        const auto stated = unit_named(unit_of_word(place.word()));
        if (!stated || place.has_factor() ||
            units_per_m_per_s2(*stated) != units_per_m_per_s2(unit)) {
            comment.refuse("the comment {} contains {}, but may only contain the given unit, {}, "
                           "without a factor. Correct one of them, or remove the comment.",
                           comment.quoted(), quoted_bytes(place.word()), name_of(unit));
        }
    }
}

void expect_no_other_motion(const Lines& comment)
{
    const std::string text = text_of_comment(comment.line());
    const std::vector<std::string_view> words = words_of(text, between_words);
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (Place{text, words, i}.is_other_motion()) {
            comment.refuse("{} does not contain accelerations. Give the file with the "
                           "accelerations, or remove the comment.",
                           comment.quoted());
        }
    }
}

void expect_time_step(const Lines& comment, double time_step)
{
    const std::string text = text_of_comment(comment.line());
    const std::vector<std::string_view> words = words_of(text, " =:,;()[]{}_#\"");
    const auto has = [&](std::initializer_list<std::string_view> names) {
        return std::ranges::any_of(words, [&](std::string_view word) {
            const std::size_t end = std::min(word.find_first_not_of("0123456789.+-"), word.size());
            return is_one_of(word.substr(end), names); // "hz" of 100hz
        });
    };
    const auto begins = [&](std::string_view name) {
        return std::ranges::any_of(words,
                                   [&](std::string_view word) { return word.starts_with(name); });
    };
    const bool samples = begins("sampl");
    const bool has_step =
        has({"dt", "timestep", "delta", "deltat"}) ||
        ((samples || begins("time")) && has({"step", "interval", "increment", "spacing"})) ||
        (samples && has({"period"})) || (has({"interval"}) && has({"s", "ms"}));
    const bool has_rate =
        has({"sps", "fs", "samples/s"}) ||
        (samples && (has({"hz", "rate", "frequency", "freq"}) || (has({"samples"}) && has({"s"}))));
    const double unit = has({"ms"}) || begins("milli") ? 1000 : 1; // of the step [1/s]
    const auto agrees = [&](double step) {
        constexpr double rounding = 1e-3; // of a printed step, such as 0.0078
        return std::abs(step - time_step) <= rounding * time_step;
    };
    bool is_stated = false;
    for (const std::string_view word : words) {
        const double value = parse_number(word).value;
        if (value > 0 && ((has_step && agrees(value / unit)) || (has_rate && agrees(1 / value)))) {
            return;
        }
        is_stated = is_stated || (value > 0 && (has_step || has_rate));
    }
    if (is_stated) {
        comment.refuse("the comment {} does not state the time step that was given, time_step = {} "
                       "s. Correct one of them, or remove the comment.",
                       comment.quoted(), time_step);
    }
}

} // namespace overturn
