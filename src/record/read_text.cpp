#include "comment.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace overturn {

namespace {

// Thirty years: a larger value cannot be a time in a record, and might overflow.
constexpr double largest_time = 1e9; // [s]

/// The number in [low, high] with the fewest decimal digits; of several, the one nearest to `near`.
double simplest_decimal(double low, double high, double near)
{
    // 10^22 is the largest power of ten that is exact, so that the quotient is correctly rounded.
    constexpr int most_decimals = 22;
    constexpr double most = 0x1p53; // larger numbers are all integers
    double scale = 1;
    for (int decimals = 0; decimals <= most_decimals && near * scale < most; ++decimals) {
        const double first = std::max(1.0, std::ceil(low * scale));
        const double last = std::floor(high * scale);
        if (first <= last) {
            return std::clamp(std::round(near * scale), first, last) / scale;
        }
        scale *= 10;
    }
    return near;
}

/// Collects printed times t_i, i = 0, 1, ..., that must be evenly spaced: with h_i half a unit of
/// the last printed digit of t_i, each must satisfy
///
///     |t_i - (t_0 + i step)| <= h_i
///
/// for one step. Each time bounds the step on both sides; the intersection of these ranges is kept.
/// Times of few digits satisfy this even if one is missing, with a step that is too long: t_i in
/// hundredths, without 0.50 s, also have the step 0.01001 s. A gap is refused for this reason.
class EvenTimes {
public:
    /// Refuses a word of the current line that is not a number, and a time that is not after the
    /// previous one or is not evenly spaced with the previous ones.
    void add(const Lines& lines, std::string_view word)
    {
        const double time = number_of(lines, word);
        if (std::abs(time) > largest_time) {
            lines.refuse(
                "the time {} s is outside {} to {} s. The first of two columns must be the "
                "time in seconds.",
                word, -largest_time, largest_time);
        }
        if (size_ == 0) {
            first_ = time;
        } else if (!(time > last_)) {
            lines.refuse("the time {} s is not after the previous time, {} s. Give ascending times "
                         "with enough digits, or one column and time_step.",
                         word, last_);
        } else {
            // Rounding: of both times, of their difference, of its sum with the half unit.
            const double half_unit = std::min(rounding_of(word), largest_time / 2) +
                                     rounding * (std::abs(time) + std::abs(first_));
            keep_longest(lines, time, half_unit);
            const double least = std::max(least_, (time - first_ - half_unit) / double(size_));
            const double most = std::min(most_, (time - first_ + half_unit) / double(size_));
            if (!(least <= most)) {
                refuse_uneven(lines, word, time, half_unit);
            }
            least_ = least;
            most_ = most;
        }
        last_ = time;
        ++size_;
    }

    /// The step with the fewest decimal digits; of several, the one nearest to the mean step [s].
    /// Requires two times.
    double step() const
    {
        return simplest_decimal(least_, most_, (last_ - first_) / double(size_ - 1));
    }

    /// Refuses times of which one step is twice all others or more, to within the last digit, if
    /// the times before it agree with a missing sample. Rounding makes no such step: printed steps
    /// of even times differ by one unit of the last digit at most, as 3 and 2, unless they are of 1
    /// and 2 units. Then it makes one among n only if the step is between 1 + 1/2n and 1 + 3/2n
    /// units, as 0.01001 s printed in hundredths.
    void expect_no_gap() const
    {
        const double tolerance = 2 * rounding * (std::abs(first_) + std::abs(last_));
        if (may_be_gap_ && second_longest_ > 0 && longest_ > 1.5 * second_longest_ + tolerance &&
            longest_ + unit_of_longest_ + tolerance >= 2 * second_longest_) {
            after_longest_->refuse(
                "the time is {:.9g} s after the previous one, but all other steps are at most "
                "{:.9g} s: a sample is missing. Give the complete record; if none is missing, give "
                "times with more digits.",
                longest_, second_longest_);
        }
    }

    double start() const { return first_; } ///< [s]
    std::size_t size() const { return size_; }

private:
    /// Whether the times up to now have a step of which there are so many up to this time.
    bool agree_with(double count, double time, double half_unit) const
    {
        return count * least_ - half_unit <= time - first_ &&
               time - first_ <= count * most_ + half_unit;
    }

    /// Of the step to this time, in the current line.
    void keep_longest(const Lines& lines, double time, double half_unit)
    {
        const double step = time - last_;
        if (step > longest_) {
            second_longest_ = std::exchange(longest_, step);
            unit_of_longest_ = 2 * half_unit;
            may_be_gap_ = agree_with(double(size_ + 1), time, half_unit);
            after_longest_ = lines;
        } else {
            second_longest_ = std::max(second_longest_, step);
        }
    }

    /// Refuses a time that has another step than those before it.
    [[noreturn]] void refuse_uneven(const Lines& lines, std::string_view word, double time,
                                    double half_unit) const
    {
        const double missing = std::round((time - first_) / step()) - double(size_);
        const bool is_gap = missing >= 1 && agree_with(double(size_) + missing, time, half_unit);
        if (after_longest_->number() != lines.number()) {
            expect_no_gap(); // at an earlier time
        }
        lines.refuse("the time is {} s, but must be {:.9g} s to within half a unit of its last "
                     "digit: times must be evenly spaced, and those before have the step {:.9g} s. "
                     "{}",
                     word, first_ + double(size_) * step(), step(),
                     is_gap ? fmt::format("{} {} missing. Give the complete record.", missing,
                                          missing == 1 ? "sample is" : "samples are")
                            : "Resample the record, or give one column and time_step.");
    }

    static constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

    double first_ = 0;                                      ///< [s]
    double last_ = 0;                                       ///< [s]
    double least_ = 0;                                      ///< lower bound of the step [s]
    double most_ = std::numeric_limits<double>::infinity(); ///< upper bound of the step [s]
    double longest_ = 0;                                    ///< step between two times [s]
    double second_longest_ = 0;                             ///< [s]
    double unit_of_longest_ = 0;                            ///< of its last digit [s]
    bool may_be_gap_ = false; ///< whether those before the longest agree with a missing sample
    std::optional<Lines> after_longest_; ///< at the second of its times
    std::size_t size_ = 0;
};

/// Columns are separated by blanks, or by a comma with or without blanks.
std::vector<std::string_view> columns_of(std::string_view line)
{
    std::vector<std::string_view> columns;
    std::string_view rest = trimmed(line);
    for (bool more = !rest.empty(); more;) {
        columns.push_back(rest.substr(0, rest.find_first_of(" \t,")));
        rest = trimmed(rest.substr(columns.back().size()));
        more = !rest.empty();
        if (rest.starts_with(',')) {
            rest = trimmed(rest.substr(1)); // another column follows, even if it is empty
        }
    }
    return columns;
}

void expect_one_or_two_columns(const Lines& lines, std::size_t found)
{
    if (found > 2) {
        lines.refuse("the line has {} columns. Give one column of accelerations, or two of times "
                     "and accelerations; the decimal mark is a point.",
                     found);
    }
}

/// The first row decides how many columns there are, and thus whether the times are known.
void expect_columns(const Lines& lines, std::size_t found, std::size_t expected,
                    const std::optional<double>& time_step)
{
    expect_one_or_two_columns(lines, found);
    if (found != expected) {
        lines.refuse("the line has {} {}, but the previous lines have {}. Correct it.", found,
                     noun_of(found, "columns"), expected);
    }
    if (found == 1 && !time_step) {
        lines.refuse("the file has one column, so the time step is not known. Give two columns "
                     "with time in seconds first, or the time step in seconds: {}.",
                     how_to_state("time_step"));
    }
    if (found == 2 && time_step) {
        lines.refuse("time_step = {} was given, but the file has two columns, which state the "
                     "times. Remove time_step.",
                     *time_step);
    }
}

/// Refuses a comma between digits, as in 1,5, of a file without any decimal point.
void expect_no_decimal_comma(const Lines& lines)
{
    const std::string_view line = lines.line();
    const auto is_digit = [&](std::size_t i) { return '0' <= line[i] && line[i] <= '9'; };
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        if (line[i] == ',' && is_digit(i - 1) && is_digit(i + 1)) {
            lines.refuse("{} may be a number with a decimal comma, because the file has no decimal "
                         "point. Write numbers with a point, and separate columns by blanks.",
                         quoted_bytes(trimmed(line)));
        }
    }
}

/// Refuses a column that begins with the number of its samples, with or without the time step.
void expect_no_count(const Lines& lines, const std::vector<double>& column)
{
    for (const std::size_t before : {1, 2}) {
        if (column.size() > before + 1 && column.front() == double(column.size() - before)) {
            lines.refuse_file("the first value, {}, is the number of the values that follow, and "
                              "not an acceleration. Remove it, or begin its line with #.",
                              column.front());
        }
    }
}

/// Reads a comment such as `motion_of = floor`; false if it is another one.
bool read_statement(const Lines& comment, RecordComponent& component)
{
    if (const auto value = value_of(comment.line(), "motion_of")) {
        component.motion_of = enumerator_named<MotionOf>(*value);
        if (!component.motion_of) {
            comment.refuse("motion_of = {} is not one of {}. Correct the comment, or remove it.",
                           *value, fmt::join(names_of<MotionOf>, ", "));
        }
        return true;
    }
    if (const auto value = value_of(comment.line(), "ground_pga")) {
        component.ground_pga = number_of(comment, *value);
        if (!(*component.ground_pga > 0)) {
            comment.refuse("ground_pga = {} is outside (0, inf). It is the peak acceleration of "
                           "the ground over g. Correct the comment, or remove it.",
                           *value);
        }
        return true;
    }
    return false;
}

/// The unit of a comment such as `units = g`, before the samples.
std::optional<AccelerationUnit> stated_unit(Lines lines)
{
    while (lines.next() && is_comment(lines.line())) {
        if (const auto value = value_of(lines.line(), "units")) {
            return unit_named(*value);
        }
    }
    return std::nullopt;
}

} // namespace

RecordFile read_text(Lines lines, const RecordOptions& options)
{
    Lines ahead = lines;
    const bool has_points = next_line(ahead, [](std::string_view line) {
        return !is_comment(line) && line.find('.') != line.npos;
    });
    ahead = lines;
    if (has_points && next_content(ahead)) { // before a unit is asked for, which would not help
        expect_one_or_two_columns(ahead, columns_of(ahead.line()).size());
    }
    const std::optional<AccelerationUnit> unit = options.unit ? options.unit : stated_unit(lines);
    if (!unit) {
        lines.refuse_file(
            "the file does not state the unit of the accelerations. Give one of {}: {}.",
            fmt::join(names_of<AccelerationUnit>, ", "), how_to_state("units"));
    }
    ahead = lines;
    const bool speaks_of_accelerations = next_line(
        ahead, [](std::string_view line) { return is_comment(line) && contains(line, "acc"); });
    RecordComponent component;
    component.unit = *unit;
    component.header = kept_lines(lines, std::string_view::npos, is_comment);
    EvenTimes times;
    std::size_t columns = 0;
    while (lines.next()) {
        if (is_comment(lines.line())) {
            if (read_statement(lines, component)) {
                continue;
            }
            expect_unit(lines, *unit);
            if (!speaks_of_accelerations) {
                expect_no_other_motion(lines);
            }
            if (options.time_step) { // the file has one column
                expect_time_step(lines, *options.time_step);
            }
            continue;
        }
        if (!has_points) {
            expect_no_decimal_comma(lines);
        }
        const std::vector<std::string_view> row = columns_of(lines.line());
        if (row.empty()) {
            continue;
        }
        columns = columns == 0 ? row.size() : columns;
        expect_columns(lines, row.size(), columns, options.time_step);
        if (component.acceleration.size() == most_samples) {
            lines.refuse("the file has more than {} samples, the maximum. Give a shorter record.",
                         most_samples);
        }
        if (columns == 2) {
            times.add(lines, row.front());
        }
        component.acceleration.push_back(number_of(lines, row.back()));
    }
    if (columns == 2 && times.size() == 1) {
        lines.refuse("the file has one sample, but the time step can be determined only from two "
                     "or more. Give the complete file.");
    }
    if (columns == 1) {
        expect_no_count(lines, component.acceleration);
        component.time_step = *options.time_step;
    } else {
        times.expect_no_gap();
        component.time_step = times.step();
        component.start = times.start();
    }
    return {.format = "text", .components = {std::move(component)}, .has_given_unit = true};
}

} // namespace overturn
