#include "numbers.hpp"

#include "overturn/record/read_record.hpp"
#include "overturn/text/parse_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string>
#include <system_error>

namespace overturn {

namespace {

struct Parsed {
    double value;
    std::errc error; ///< none, invalid_argument or result_out_of_range
};

Parsed parse(std::string_view word)
{
    std::string text(word);
    std::ranges::replace(text, 'd', 'e');
    std::ranges::replace(text, 'D', 'E');
    const ParsedNumber number = parse_number(text);
    return {number.value, is_whole(number, text) ? number.error : std::errc::invalid_argument};
}

/// The length of the first number of a text: up to a blank, or to a sign that does not belong to an
/// exponent.
std::size_t length_of_number(std::string_view text)
{
    for (std::size_t end = 1; end < text.size(); ++end) {
        const bool is_exponent = std::string_view("eEdD").find(text[end - 1]) != text.npos;
        if (std::string_view(is_exponent ? " \t" : " \t+-").find(text[end]) != text.npos) {
            return end;
        }
    }
    return text.size();
}

/// The number of digits between the point and the exponent.
std::size_t decimals_of(std::string_view number)
{
    const std::size_t exponent = std::min(number.find_first_of("eEdD"), number.size());
    const std::size_t point = number.find('.');
    return point < exponent ? exponent - point - 1 : 0;
}

/// Whether the number in a column continues in the next one: a digit or a point follows it, and it
/// does not have all its decimals.
bool is_cut(std::string_view line, const Columns& columns, std::size_t index)
{
    const std::size_t end = (index + 1) * columns.width;
    if (!columns.decimals || end >= line.size() ||
        std::string_view("0123456789.").find(line[end]) == line.npos ||
        std::string_view(" \t").find(line[end - 1]) != line.npos) {
        return false;
    }
    return decimals_of(column_of(line, columns.width, index)) != *columns.decimals;
}

} // namespace

bool is_number(std::string_view word)
{
    return parse(word).error != std::errc::invalid_argument;
}

bool is_mark_of_unknown(double number)
{
    constexpr std::array marks{-999.0, -9999.0, -99999.0, -999999.0, -12345.0, -32768.0};
    constexpr double nearly_largest_of_single_precision = 1.69e38;
    return is_one_of(number, marks) ||
           std::isgreaterequal(std::abs(number), nearly_largest_of_single_precision);
}

double rounding_of(std::string_view number)
{
    const std::size_t exponent = std::min(number.find_first_of("eEdD"), number.size());
    const Parsed power = parse(number.substr(std::min(exponent + 1, number.size())));
    return 0.5 * std::pow(10, (power.error == std::errc() ? power.value : 0) -
                                  double(decimals_of(number)));
}

namespace {

/// Refuses a number that a format needs but that the file marks as unknown.
void expect_known(const Lines& lines, std::string_view word, std::string_view what)
{
    const auto [value, error] = parse(word);
    if (error == std::errc() && is_mark_of_unknown(value)) {
        lines.refuse("{} is {}, which stands for an unknown number. Give a file that states it.",
                     what, quoted_bytes(word));
    }
}

} // namespace

double number_of(const Lines& lines, std::string_view word)
{
    const auto [value, error] = parse(word);
    if (error == std::errc::invalid_argument) {
        lines.refuse("{} is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01.",
                     quoted_bytes(word));
    }
    if (error == std::errc::result_out_of_range) {
        lines.refuse("{} is outside the range of double precision. Correct it.",
                     quoted_bytes(word));
    }
    if (!std::isfinite(value)) {
        lines.refuse("{} is not finite. Give a record without gaps.", quoted_bytes(word));
    }
    return value;
}

std::size_t count_of(const Lines& lines, std::string_view word, std::string_view what,
                     std::size_t least)
{
    expect_known(lines, word, what);
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc() || end != word.data() + word.size() || count < least ||
        count > most_samples) {
        lines.refuse(
            "{} is {}, but must be an integer from {} to {}. Correct it, or give another record.",
            what, quoted_bytes(word), least, most_samples);
    }
    return count;
}

double time_step_of(const Lines& lines, std::string_view word)
{
    expect_known(lines, word, "the time step");
    const double step = number_of(lines, word);
    if (!(step > 0)) {
        lines.refuse("the time step is {} s, but must be above 0. Correct it.", step);
    }
    return step;
}

double sampling_rate_of(const Lines& lines, std::string_view word)
{
    expect_known(lines, word, "the number of samples per second");
    const double rate = number_of(lines, word);
    if (!(rate > 0 && std::isfinite(1 / rate))) {
        lines.refuse("the number of samples per second is {}, but must be above 0, and its inverse "
                     "finite. Correct it.",
                     quoted_bytes(word));
    }
    return rate;
}

std::vector<double> take_free_numbers(Lines& lines, const Announcement& announced)
{
    std::vector<double> values;
    while (lines.next()) {
        for (std::string_view rest = trimmed(lines.line()); !rest.empty();) {
            const std::string_view word = rest.substr(0, length_of_number(rest));
            if (values.size() == announced.count) {
                lines.refuse("{} follows the last of the {} {} that {} announces in line {}. "
                             "Correct {} or remove the rest.",
                             quoted_bytes(word), announced.count,
                             noun_of(announced.count, "samples"), announced.name, announced.line,
                             announced.name);
            }
            values.push_back(number_of(lines, word));
            rest = trimmed(rest.substr(word.size()));
        }
    }
    if (values.size() < announced.count) {
        lines.refuse("the file ends after {} {}, but {} announces {} in line {}. Give the "
                     "complete file.",
                     values.size(), noun_of(values.size(), "samples"), announced.name,
                     announced.count, announced.line);
    }
    return values;
}

std::string_view column_of(std::string_view line, std::size_t width, std::size_t index)
{
    return trimmed(line.substr(std::min(index * width, line.size()), width));
}

namespace {

/// Takes the announced columns, `take(lines, word)` for each.
template <class Take>
void take_each_column(Lines& lines, const Columns& columns, const Announcement& announced,
                      const Take& take)
{
    std::size_t taken = 0;
    while (taken < announced.count) {
        if (!lines.next()) {
            lines.refuse("the file ends after {} of the {} values of {} that line {} announces. "
                         "Give the complete file.",
                         taken, announced.count, announced.name, announced.line);
        }
        if (trimmed(lines.line()).empty()) {
            continue;
        }
        const std::string_view line =
            lines.line().substr(0, lines.line().find_last_not_of(" \t") + 1);
        const std::size_t found = (line.size() + columns.width - 1) / columns.width;
        const std::size_t expected = std::min(columns.per_line, announced.count - taken);
        if (found != expected) {
            lines.refuse(
                "the line has {} {} of {} characters, but must have {}: line {} announces {} "
                "values of {}, {} per line. Give the file as it was published.",
                found, noun_of(found, "columns"), columns.width, expected, announced.line,
                announced.count, announced.name, columns.per_line);
        }
        for (std::size_t i = 0; i < found; ++i) {
            if (is_cut(line, columns, i)) {
                lines.refuse("column {} of {} characters ends within a number: {}. Give the file "
                             "as it was published.",
                             i + 1, columns.width, quoted_bytes(column_of(line, columns.width, i)));
            }
            take(lines, column_of(line, columns.width, i));
        }
        taken += found;
    }
}

} // namespace

std::vector<Printed> take_printed(Lines& lines, const Columns& columns,
                                  const Announcement& announced)
{
    constexpr std::size_t most_kept = 1000;
    std::vector<Printed> numbers;
    take_each_column(lines, columns, announced, [&](const Lines& line, std::string_view word) {
        number_of(line, word);
        if (numbers.size() < most_kept) {
            numbers.push_back({line, word});
        }
    });
    return numbers;
}

std::vector<double> take_columns(Lines& lines, const Columns& columns,
                                 const Announcement& announced)
{
    std::vector<double> values;
    take_each_column(lines, columns, announced, [&](const Lines& line, std::string_view word) {
        values.push_back(number_of(line, word));
    });
    return values;
}

std::vector<double> acceleration_of_counts(const Lines& lines, std::vector<double> samples,
                                           double acceleration, double counts)
{
    // The sum of integers of up to 30 bits is exact.
    const double mean =
        std::accumulate(samples.begin(), samples.end(), 0.0) / double(samples.size());
    for (double& sample : samples) {
        sample = (sample - mean) * acceleration / counts;
        if (!std::isfinite(sample)) {
            lines.refuse("with {} per {} counts, the accelerations exceed the range of double "
                         "precision. Correct it.",
                         acceleration, counts);
        }
    }
    return samples;
}

} // namespace overturn
