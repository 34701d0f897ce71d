#include "cosmos_values.hpp"

#include "fortran_format.hpp"
#include "numbers.hpp"

namespace overturn {

std::vector<double> take_announced(Lines& lines, std::string_view name)
{
    const std::size_t count = count_of(lines, first_word(lines.line()), "the number of values");
    const auto columns = columns_of_format(lines.line());
    if (!columns) {
        lines.refuse(
            "the line states no format of the values, such as Format=(8F10.5). Give the file "
            "as it was published.");
    }
    return take_columns(lines, *columns, {count, name, lines.number()});
}

CosmosValues::CosmosValues(Lines& lines, Header& header, std::string_view name) : lines_(lines)
{
    const std::size_t begin = lines.number() + 1;
    if (!header.take_through(lines, name)) {
        lines.refuse("no line such as 100 {} values follow after line {}. Give the complete file.",
                     name, begin);
    }
    lines_ = lines;
    Lines ahead = lines;
    values_ = take_announced(ahead, name);
    header.take(lines, ahead.number() - lines.number());
}

std::optional<double> CosmosValues::operator[](std::size_t number) const
{
    const double value = number <= values_.size() ? values_[number - 1] : -1;
    return value < 0 ? std::nullopt : std::optional(value);
}

} // namespace overturn
