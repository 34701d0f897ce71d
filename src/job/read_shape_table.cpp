#include "read_steps.hpp"

#include "overturn/problem/pulse_table.hpp"
#include "overturn/record/text_file.hpp"
#include "overturn/text/utf8.hpp"

#include <filesystem>

namespace overturn {

namespace {

constexpr TextFileKind shape_file{"a table", std::size_t(64) << 20,
                                  "Give the path of a table, relative to the job file.",
                                  "Give fewer rows."};

const std::vector<std::string_view> names{"time", "value"};

/// Throws Error for a value that is not a number, or not allowed.
ScaledTable pulse_in_file(const std::string& file, const std::string& path)
{
    const Table table = read_table_of(names, text_of_file(path, shape_file), file);
    const auto place_of_row = [&](std::int64_t row, std::string_view column) {
        return row < 0 ? std::string()
                       : fmt::format(":{}:{}: {}", table.lines[std::size_t(row)],
                                     column == names[0] ? 1 : 2, column);
    };
    for (const TableColumn& column : table.columns) {
        if (column.first_text >= 0) {
            throw Error(exit_code::job, "{}{} = {} is not a number.", file,
                        place_of_row(column.first_text, column.name),
                        in_quotes(shortened(column.texts[std::size_t(column.first_text)], 40)));
        }
    }
    try {
        return pulse_of_table(table.columns[0].numbers, table.columns[1].numbers);
    } catch (const GivenError& error) {
        throw Error(exit_code::job, "{}{}{}", file, place_of_row(error.row(), error.quantity()),
                    error.what());
    }
}

ScaledTable pulse_in_job(const Entry& list)
{
    const auto size_of = [](const Entry& entry) {
        return array_size(entry, "the path of a table, or an array of [time, value]",
                          "Give [time, value], time over the period.");
    };
    std::vector<double> times, values;
    for (std::size_t i = 0; i < size_of(list); ++i) {
        const Entry row = element(list, i);
        if (const std::size_t size = size_of(row); size != 2) {
            refuse(row, " has length {}. Give [time, value], time over the period.", size);
        }
        times.push_back(number_of(element(row, 0)));
        values.push_back(number_of(element(row, 1)));
    }
    try {
        return pulse_of_table(times, values);
    } catch (const GivenError& error) {
        const Entry wrong = error.row() < 0 ? list
                                            : element(element(list, std::size_t(error.row())),
                                                      error.quantity() == names[1]);
        refuse(wrong, "{}", error.what());
    }
}

} // namespace

ShapeTable read_shape_table(const Entry& scene, const std::string& folder)
{
    const Entry entry = *find(scene, "shape");
    const std::string file = entry.node->is_array() ? "" : string_of(entry);
    const ScaledTable table =
        entry.node->is_array()
            ? pulse_in_job(entry)
            : pulse_in_file(file, (std::filesystem::path(folder) / file).string());
    const Record& shape = table.pulse.shape;
    return {file, table.peak, table.periods, checksum_of({&shape->phases(), &shape->horizontal()}),
            shape};
}

} // namespace overturn
