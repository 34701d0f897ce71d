#include "stated_unit.hpp"

#include "unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace overturn {

namespace {

bool is_one_of(std::string_view word, std::span<const std::string_view> words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// A word of a line, and the punctuation between it and the previous word. A word that follows
/// without any continues a phrase.
struct Word {
    std::string spelling;
    std::string text; ///< simplified
    std::string before;
};

bool is_acceleration(std::string_view word)
{
    constexpr std::array<std::string_view, 6> names{"a",    "acc",          "accel",
                                                    "accn", "acceleration", "accelerations"};
    return is_one_of(word, names);
}

/// Where a unit begins in the name of a column, such as acc_x_cm_s2, a/g or time_ms; npos if it has
/// none.
std::size_t unit_of_column(std::string_view name)
{
    bool is_named = false;
    for (std::size_t begin = 0, end = 0; end != name.npos; begin = end + 1) {
        const std::string_view rest = name.substr(begin);
        if (is_named && !rest.empty() &&
            (resembles_unit(rest) || resembles_unit(after_factor(rest).value_or("")))) {
            return begin;
        }
        end = name.find_first_of("_/-.", begin);
        const std::string_view part = name.substr(begin, end - begin);
        is_named = is_named || is_acceleration(part) || part == "t" || part == "time";
    }
    return name.npos;
}

/// Brackets within a unit, as in cm/(s*s), belong to the word. The unit in the name of a column is
/// a word as if it were in brackets.
std::vector<Word> words_of(std::string_view line)
{
    constexpr std::string_view punctuation = ",;:=()[]{}<>\"|";
    std::vector<Word> words;
    Word word;
    int open = 0;
    const auto finish = [&] {
        const std::size_t end = word.spelling.find_last_not_of(".-") + 1; // of a sentence
        const std::string marks = word.spelling.substr(end);
        word.spelling.resize(end);
        if (word.spelling.empty()) {
            word.before += marks;
        } else {
            word.text = simplified(word.spelling);
            if (const std::size_t unit = unit_of_column(word.text); unit != std::string::npos) {
                words.push_back({word.spelling.substr(0, unit - 1), word.text.substr(0, unit - 1),
                                 word.before});
                word = {word.spelling.substr(unit), word.text.substr(unit), "["};
                words.push_back(std::exchange(word, Word{{}, {}, "," + marks})); // ends the phrase
            } else {
                words.push_back(std::exchange(word, Word{{}, {}, marks}));
            }
        }
    };
    for (const char letter : line) {
        if (letter == '(' && word.spelling.ends_with('/')) {
            ++open;
        } else if (letter == ')' && open > 0) {
            --open;
        } else if (letter == ' ' || letter == '\t') {
            finish();
        } else if (punctuation.find(letter) != punctuation.npos) {
            finish();
            word.before += letter;
        } else {
            word.spelling += letter;
        }
    }
    finish();
    return words;
}

/// Reads the units of one line.
class UnitReader {
public:
    explicit UnitReader(std::string_view line) : words_(words_of(line)) {}

    std::vector<StatedUnit> read(UnitPlaces places)
    {
        while (at_ < words_.size()) {
            if (is_after_units()) {
                take_any();
            } else if (places == UnitPlaces::after_units) {
                ++at_;
            } else if (is_expected() || is_named_factor()) {
                take_if_unit();
            } else {
                take_if_nothing_else();
            }
        }
        return std::move(units_);
    }

private:
    const std::string& word(std::size_t i) const { return words_[i].text; }

    /// Whether a phrase goes on with word i.
    bool continues(std::size_t i) const { return i < words_.size() && words_[i].before.empty(); }

    /// Skips "units of" and the like; whether a word follows that must be a unit.
    bool is_after_units()
    {
        if (word(at_) != "units" && word(at_) != "unit") {
            return false;
        }
        std::size_t next = at_ + 1;
        bool is_clear = word(at_) == "units" || (next < words_.size() && !continues(next) &&
                                                 words_[next].before.find_first_of(":=") == 0);
        constexpr std::array<std::string_view, 5> fillers{"of", "are", "is", "in", "the"};
        while (next < words_.size() && is_one_of(word(next), fillers)) {
            is_clear = true;
            ++next;
        }
        constexpr std::string_view introductions = ":=([{<\"";
        const bool follows = next < words_.size() && words_[next].before.find_first_not_of(
                                                         introductions) == std::string::npos;
        if (!is_clear || !follows) { // a block unit, or the end of "in SI units"
            return false;
        }
        at_ = next;
        return true;
    }

    /// Whether the current word is where a unit is expected: after a bracket, "in", "divided by" or
    /// "acceleration".
    bool is_expected() const
    {
        if (words_[at_].before.find_first_of(":=([{<") != std::string::npos) {
            return true;
        }
        if (at_ == 0) {
            return false;
        }
        constexpr std::array<std::string_view, 3> divided{"divided", "normalised", "normalized"};
        const std::string& previous = word(at_ - 1);
        const bool is_quotient = previous == "by" && at_ > 1 && is_one_of(word(at_ - 2), divided);
        return continues(at_) ? previous == "in" || is_quotient ||
                                    (is_acceleration(previous) && previous != "a")
                              : is_acceleration(previous) && words_[at_].before == ",";
    }

    /// Whether the current word is a factor such as % or begins with one, as MILLI-G does.
    bool is_named_factor() const { return !is_number_like(word(at_)) && after_factor(word(at_)); }

    struct Match {
        AccelerationUnit unit;
        std::size_t end; ///< the word after it
    };

    /// The unit of as many words as possible, beginning with word i.
    std::optional<Match> match(std::size_t i) const
    {
        constexpr std::size_t most_words = 6; // cm per sec per sec
        std::optional<Match> found;
        std::string normal;
        for (std::size_t end = i; end < words_.size() && end < i + most_words; ++end) {
            if (end > i && !continues(end)) {
                break;
            }
            const std::string part = normal_form(word(end));
            if (part.empty()) { // a factor follows
                break;
            }
            normal += part;
            if (const auto unit = unit_of(normal)) {
                found = Match{*unit, end + 1};
            }
        }
        return found;
    }

    /// The unit after words such as "fractions of"; nullopt also if a factor changes it.
    std::optional<Match> match_of_phrase() const
    {
        constexpr std::array<std::string_view, 6> whole{"fraction", "fractions", "multiples",
                                                        "parts",    "terms",     "units"};
        const bool is_share = is_one_of(word(at_), whole) && continues(at_ + 1) &&
                              word(at_ + 1) == "of" && continues(at_ + 2);
        const auto found = match(is_share ? at_ + 2 : at_);
        const bool is_changed = found && continues(found->end) && is_operator(word(found->end));
        return is_changed ? std::nullopt : found;
    }

    /// Whether word i, with a slash after it, begins like a unit.
    bool resembles_unit(std::size_t i) const
    {
        const bool is_divided = continues(i + 1) && (word(i + 1)[0] == '/' || word(i + 1) == "per");
        return overturn::resembles_unit(word(i) + (is_divided ? "/" : ""));
    }

    /// Whether a factor and a unit are next, as in PERCENT OF G or, after "in", 0.01 G. Elsewhere a
    /// number and a unit are a value, such as the peak.
    bool is_multiple() const
    {
        const auto rest = after_factor(word(at_));
        const bool is_power = word(at_).find_first_of("^*") != std::string::npos; // 10^-3
        if (!rest || (is_number_like(word(at_)) && !words_[at_].before.empty() && !is_power)) {
            return false;
        }
        constexpr std::array<std::string_view, 3> joints{"of", "x", "*"};
        const bool is_joint = continues(at_ + 1) && is_one_of(word(at_ + 1), joints);
        const std::size_t next = at_ + (is_joint ? 2 : 1);
        return rest->empty() ? continues(next) && resembles_unit(next)
                             : overturn::resembles_unit(*rest);
    }

    /// Adds the words up to `end` as a unit.
    void take(std::size_t end, const std::optional<AccelerationUnit>& unit)
    {
        std::string text = words_[at_++].spelling;
        while (at_ < end) {
            text += ' ' + words_[at_++].spelling;
        }
        units_.push_back({std::move(text), unit});
    }

    /// Adds the rest of the phrase as a unit, which may not be understood.
    void take_any()
    {
        if (const auto found = match_of_phrase()) {
            take(found->end, found->unit);
            return;
        }
        std::size_t end = at_ + 1;
        while (continues(end)) {
            ++end;
        }
        take(end, std::nullopt);
    }

    void take_if_unit()
    {
        if (match_of_phrase() || resembles_unit(at_) || is_multiple()) {
            take_any();
        } else {
            take_if_nothing_else();
        }
    }

    /// Takes a unit that is nothing else wherever it is: cm/s/s, but not G.
    void take_if_nothing_else()
    {
        if (continues(at_) && at_ > 0 && is_number_like(word(at_ - 1))) { // a value
            ++at_;
            return;
        }
        const auto found = match(at_);
        const bool is_unit = found && found->unit != AccelerationUnit::g;
        const bool is_scaled = word(at_) == "scaled" && continues(at_ + 1) && word(at_ + 1) == "by";
        if (is_unit || is_scaled || is_length_over_time(word(at_)) || is_always_unit(word(at_))) {
            take_any();
        } else {
            ++at_;
        }
    }

    std::vector<Word> words_;
    std::size_t at_ = 0;
    std::vector<StatedUnit> units_;
};

} // namespace

std::vector<StatedUnit> stated_units(std::string_view line, UnitPlaces places)
{
    return UnitReader(line).read(places);
}

std::string how_to_state(std::string_view option)
{
    return fmt::format("scene.{0} in a job, --set scene.{0}=... on the command line, or {0}=... in "
                       "Python",
                       option);
}

} // namespace overturn
