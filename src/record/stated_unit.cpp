#include "stated_unit.hpp"

#include "lines.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace overturn {

namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

/// Whether a word is in a list of words with blanks between them.
bool is_in(std::string_view list, std::string_view word)
{
    while (!list.empty() && !word.empty()) {
        const std::string_view first = list.substr(0, list.find(' '));
        if (first == word) {
            return true;
        }
        list.remove_prefix(std::min(first.size() + 1, list.size()));
    }
    return false;
}

constexpr bool is_letter(char character)
{
    return 'a' <= character && character <= 'z';
}

bool is_number_like(std::string_view word)
{
    const auto is_digit = [&](std::size_t i) {
        return i < word.size() && '0' <= word[i] && word[i] <= '9';
    };
    return is_digit(0) || (word.starts_with('.') && is_digit(1));
}

/// In lower case, with superscripts of UTF-8 and Latin-1 as digits and minus signs, and without the
/// dots of products.
std::string simplified(std::string_view word)
{
    constexpr Replacement letters[] = {{"\u00b2", "2"}, {"\xb2", "2"},   {"\u00b3", "3"},
                                       {"\u207b", "-"}, {"\u2212", "-"}, {"\u00b7", ""},
                                       {"\u22c5", ""}};
    std::string text = lower(word);
    for (const auto& [letter, replacement] : letters) {
        for (std::size_t at = 0; (at = text.find(letter, at)) != text.npos;) {
            text.replace(at, letter.size(), replacement);
        }
    }
    return text;
}

/// A unit or a part of one in a normal form: "sec**2" becomes "s2".
std::string normal_form(std::string_view word)
{
    constexpr Replacement synonyms[] = {{"per", "/"},
                                        {"sec secs second seconds", "s"},
                                        {"squared square sq", "2"},
                                        {"gs gravity gravities", "g"},
                                        {"gals", "gal"},
                                        {"meter meters metre metres", "m"},
                                        {"centimeter centimeters centimetre centimetres", "cm"},
                                        {"millimeters millimetres", "mm"}};
    std::string result;
    std::string letters;
    const auto finish = [&] {
        for (const auto& [spellings, normal] : synonyms) {
            letters = is_in(spellings, letters) ? normal : letters;
        }
        result += std::exchange(letters, "");
    };
    for (const char letter : word) {
        if (is_letter(letter)) {
            letters += letter;
        } else if (letter != '\'') { // as in g's
            finish();
            result += std::string_view("^*._()").find(letter) == std::string_view::npos
                          ? std::string(1, letter)
                          : "";
        }
    }
    finish();
    return result;
}

/// The unit of a normal form, such as "cm/s/s"; nullopt if it is none.
std::optional<AccelerationUnit> unit_of(std::string_view normal)
{
    if (normal == "g") {
        return AccelerationUnit::g;
    }
    if (normal == "gal") {
        return AccelerationUnit::cm_per_s2;
    }
    const std::size_t length = std::min(normal.find_first_of("/sp"), normal.size());
    if (!is_in("/s/s /s2 /ss s-2 s2 ps2", normal.substr(length))) {
        return std::nullopt;
    }
    const std::string_view metre = normal.substr(0, length);
    return metre == "mm"   ? std::optional(AccelerationUnit::mm_per_s2)
           : metre == "cm" ? std::optional(AccelerationUnit::cm_per_s2)
           : metre == "m"  ? std::optional(AccelerationUnit::m_per_s2)
                           : std::nullopt;
}

constexpr std::string_view times = "ms msec milliseconds us min minutes hours";

/// Whether a word begins like a unit: with the name of a length, of an acceleration, of a time, of
/// a system of units or of raw data, alone or before something other than a letter.
bool resembles_unit(std::string_view word)
{
    const auto end = std::find_if_not(word.begin(), word.end(), is_letter);
    const std::string_view name(word.begin(), end);
    const bool is_short = is_in("m in", name); // also an initial, and a preposition
    return (is_short && end != word.end()) || is_in(times, name) ||
           is_in("g gal mgal mg ug mm cm dm km ft feet foot inch inches cms cmss mss mps cmps mmps "
                 "mms si cgs mks metric count counts volt volts",
                 normal_form(name));
}

/// Whether a word can only be a unit, wherever it is: a length over a second, as in CM/SEC, a force
/// over a mass, or a system of units.
bool is_always_unit(std::string_view word)
{
    const std::string normal = normal_form(word);
    const std::size_t end = std::min(normal.find("/s"), normal.size());
    return is_in("n/kg si mks cgs mgal", word) || normal == "cmss" ||
           (is_in("mm cm dm km m ft in inches", normal.substr(0, end)) && end < normal.size() &&
            !is_letter(normal[std::min(end + 2, normal.size())]));
}

/// What follows a factor at the beginning of a word: "g" in milli-g and in 0.01g; nullopt: it does
/// not begin with a factor.
std::optional<std::string_view> after_factor(std::string_view word)
{
    std::size_t end = is_number_like(word) ? word.find_first_not_of("0123456789.+-*/^") : 0;
    for (const std::string_view name :
         {"%", "percent", "milli", "micro", "tenth", "tenths", "hundredths", "thousandths"}) {
        end = word.starts_with(name) ? name.size() : end;
    }
    if (end == 0) {
        return std::nullopt;
    }
    word.remove_prefix(std::min(end, word.size()));
    return word.starts_with('-') ? word.substr(1) : word;
}

bool is_acceleration(std::string_view word)
{
    return is_in("a acc accel accn acceleration accelerations", word);
}

/// Whether a word is g, also with the name of an acceleration or a component, as in accg and EW_g.
bool contains_g(std::string_view word)
{
    if (is_in("g's gs gn g0", word) ||
        (word.ends_with('g') && is_acceleration(word.substr(0, word.size() - 1)))) {
        return true;
    }
    for (std::size_t begin = 0, end = 0; end != word.npos; begin = end + 1) {
        end = word.find_first_of("_-.", begin);
        if (word.substr(begin, end - begin) == "g") {
            return true;
        }
    }
    return false;
}

/// Where a unit begins in the name of a column, such as acc_x_cm_s2, a/g or time_ms; npos if it has
/// none.
std::size_t unit_of_column(std::string_view name)
{
    bool is_named = false;
    for (std::size_t begin = 0, end = 0; end != name.npos; begin = end + 1) {
        const std::string_view rest = name.substr(begin);
        if (is_named && (resembles_unit(rest) || resembles_unit(after_factor(rest).value_or("")))) {
            return begin;
        }
        end = name.find_first_of("_/-.", begin);
        const std::string_view part = name.substr(begin, end - begin);
        is_named = is_named || is_acceleration(part) || part == "t" || part == "time";
    }
    return name.npos;
}

/// A word of a line, and the punctuation between it and the previous word. A word that follows
/// without any continues a phrase.
struct Word {
    std::string_view spelling; ///< in the line
    std::string text;          ///< simplified
    std::string before;
};

constexpr std::string_view blanks = " \t";
constexpr std::string_view punctuation = ",;:=()[]{}<>\"|";

/// The end of the word that begins here. Brackets within a unit, as in cm/(s*s), belong to it.
std::size_t end_of_word(std::string_view line, std::size_t begin)
{
    int open = 0;
    for (std::size_t end = begin; end < line.size(); ++end) {
        const char letter = line[end];
        if (letter == '(' && end > begin && line[end - 1] == '/') {
            ++open;
        } else if (letter == ')' && open > 0) {
            --open;
        } else if (blanks.find(letter) != blanks.npos ||
                   punctuation.find(letter) != punctuation.npos) {
            return end;
        }
    }
    return line.size();
}

/// The unit in the name of a column is a word as if it were in brackets.
std::vector<Word> words_of(std::string_view line)
{
    std::vector<Word> words;
    std::string before;
    for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
        end = end_of_word(line, begin);
        if (end == begin) {
            before += blanks.find(line[begin]) == blanks.npos ? line.substr(begin, 1) : "";
            ++end;
            continue;
        }
        std::string_view word = line.substr(begin, end - begin);
        const std::size_t size = word.find_last_not_of(".-") + 1;
        const std::string_view marks = word.substr(size); // of a sentence
        word = word.substr(0, size);
        std::string text = simplified(word);
        if (text.empty()) {
            before += marks;
        } else if (const std::size_t unit = unit_of_column(text); unit != text.npos) {
            words.push_back({word.substr(0, unit - 1), text.substr(0, unit - 1), before});
            words.push_back({word.substr(unit), text.substr(unit), "["});
            before = fmt::format(",{}", marks); // ends the phrase
        } else {
            words.push_back({word, std::move(text), std::exchange(before, std::string(marks))});
        }
    }
    return words;
}

/// Reads the units of one line.
class UnitReader {
public:
    UnitReader(std::string_view line, UnitPlaces places) : words_(words_of(line)), places_(places)
    {}

    std::vector<StatedUnit> read()
    {
        std::vector<StatedUnit> units;
        while (at_ < words_.size()) {
            if (skip_units_of() || (places_ != UnitPlaces::after_units && is_unit()) ||
                (places_ == UnitPlaces::comment && is_any_g())) {
                units.push_back(take());
            } else {
                ++at_;
            }
        }
        return units;
    }

private:
    const std::string& word(std::size_t i) const { return words_[i].text; }

    /// Whether a phrase goes on with word i, or with one of a list.
    bool continues(std::size_t i) const { return i < words_.size() && words_[i].before.empty(); }
    bool continues(std::size_t i, std::string_view list) const
    {
        return continues(i) && is_in(list, word(i));
    }

    /// Skips "units of" and the like; false if no word follows that must be a unit.
    bool skip_units_of()
    {
        if (!is_in("unit units", word(at_))) {
            return false;
        }
        std::size_t next = at_ + 1;
        while (next < words_.size() && is_in("of are is in the", word(next))) {
            ++next;
        }
        if (next == words_.size()) { // the end of "in SI units"
            return false;
        }
        const std::string& before = words_[next].before;
        const bool is_clear = word(at_) == "units" || next > at_ + 1 || before.starts_with(':') ||
                              before.starts_with('='); // not a block unit
        if (!is_clear || before.find_first_not_of(":=([{<\"") != before.npos) {
            return false;
        }
        at_ = next;
        return true;
    }

    /// Whether the current word is where a unit is expected: after a bracket, "in", "divided by" or
    /// "acceleration", or as the whole line.
    bool is_expected() const
    {
        const std::string& before = words_[at_].before;
        if (before.find_first_of(":=([{<") != before.npos) {
            return true;
        }
        if (places_ == UnitPlaces::comment && at_ == 0 && (words_.size() == 1 || is_multiple())) {
            return true; // the whole line
        }
        if (at_ == 0 || !(before.empty() || before == ",")) {
            return false;
        }
        const std::string& previous = word(at_ - 1);
        if (is_acceleration(previous)) {
            return before == "," || previous != "a";
        }
        return before.empty() &&
               (previous == "in" || (previous == "by" && at_ > 1 &&
                                     is_in("divided normalised normalized", word(at_ - 2))));
    }

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
        for (std::size_t end = i; end < i + most_words && (end == i || continues(end)); ++end) {
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
        const bool is_share = is_in("fraction fractions multiples parts terms units", word(at_)) &&
                              continues(at_ + 1, "of") && continues(at_ + 2);
        const auto found = match(is_share ? at_ + 2 : at_);
        if (!found || found->end == words_.size()) {
            return found;
        }
        const std::string& next = word(found->end);
        const bool is_number_next =
            found->end + 1 < words_.size() &&
            std::isdigit(static_cast<unsigned char>(word(found->end + 1).front()));
        const bool is_changed = // also behind a comma or a bracket
            is_in("divided factor multiplied multiply scale scaled times", next) ||
            (next == "x" && is_number_next) ||
            (continues(found->end) &&
             (is_in("per times x squared", next) || next.find_first_of("/*^") == 0));
        return is_changed ? std::nullopt : found;
    }

    /// Whether word i, with a slash after it, begins like a unit.
    bool begins_unit(std::size_t i) const
    {
        const bool is_divided =
            continues(i + 1, "per") || (continues(i + 1) && word(i + 1).starts_with('/'));
        return resembles_unit(word(i) + (is_divided ? "/" : ""));
    }

    /// Whether a factor and a unit are next, as in PERCENT OF G or, after "in", 0.01 G. Elsewhere a
    /// number and a unit are a value, such as the peak.
    bool is_multiple() const
    {
        const std::string& factor = word(at_);
        const auto rest = after_factor(factor);
        const bool is_power = factor.find_first_of("^*") != factor.npos; // 10^-3
        if (!rest || (is_number_like(factor) && !words_[at_].before.empty() && !is_power)) {
            return false;
        }
        const std::size_t next = at_ + (continues(at_ + 1, "of x *") ? 2 : 1);
        return rest->empty() ? continues(next) && begins_unit(next) : resembles_unit(*rest);
    }

    /// Whether a value follows the current word, as in g = 9.81.
    bool is_defined() const
    {
        return at_ + 1 < words_.size() && words_[at_ + 1].before.starts_with('=');
    }

    /// Whether the current word is g as a unit, for all that a comment shows.
    bool is_any_g() const
    {
        if (!contains_g(word(at_)) || is_defined()) {
            return false;
        }
        const bool is_initial =
            words_[at_].spelling == "G" && at_ + 1 < words_.size() && words_[at_ + 1].before == ".";
        const bool is_name =
            at_ > 0 && continues(at_) &&
            (is_number_like(word(at_ - 1)) || // a value
             is_in("component comp channel station site building bldg class type", word(at_ - 1)));
        return !is_initial && !is_name;
    }

    /// Whether a unit begins with the current word: one that is expected, a multiple, or what is
    /// nothing else wherever it is, cm/s/s but not G, and not part of a value.
    bool is_unit() const
    {
        if (places_ == UnitPlaces::comment && word(at_) == "g" && is_defined()) {
            return false;
        }
        if (places_ == UnitPlaces::comment && word(at_) == "m" &&
            words_[at_].before.ends_with('[')) { // elsewhere, an initial
            return true;
        }
        const bool is_named_factor = !is_number_like(word(at_)) && after_factor(word(at_));
        if ((is_expected() || is_named_factor) &&
            (match_of_phrase() || begins_unit(at_) || is_multiple())) {
            return true;
        }
        if (continues(at_) && at_ > 0 && is_number_like(word(at_ - 1))) {
            return false;
        }
        const auto found = match(at_);
        return (found && found->unit != AccelerationUnit::g) || is_always_unit(word(at_)) ||
               (word(at_) == "scaled" && continues(at_ + 1, "by"));
    }

    /// Takes a unit, or the rest of the phrase as one that is not understood.
    StatedUnit take()
    {
        const std::size_t begin = at_;
        auto found = match_of_phrase();
        if (!found && places_ == UnitPlaces::comment && word(begin) != "g" && is_any_g()) {
            found = Match{AccelerationUnit::g, begin + 1};
        }
        at_ = found ? found->end : at_ + 1;
        while (!found && continues(at_)) {
            ++at_;
        }
        const char* const first = words_[begin].spelling.data();
        const std::string_view last = words_[at_ - 1].spelling;
        return {std::string(first, last.data() + last.size()),
                found ? std::optional(found->unit) : std::nullopt,
                at_ == begin + 1 && is_in(times, word(begin))};
    }

    std::vector<Word> words_;
    UnitPlaces places_;
    std::size_t at_ = 0;
};

} // namespace

std::vector<StatedUnit> stated_units(std::string_view line, UnitPlaces places)
{
    return UnitReader(line, places).read();
}

std::string how_to_state(std::string_view option)
{
    return fmt::format(
        "scene.{0} in a job, --set scene.{0}=... on the command line, or {0}=... in Python",
        option);
}

} // namespace overturn
