#include "overturn/file/answer_table.hpp"

#include "working_file.hpp"

namespace overturn {

namespace {

constexpr OwnText table{.kind = "a table of answers",
                        .is_own =
                            [](std::string_view beginning) {
                                const std::string_view names =
                                    beginning.substr(0, beginning.find('\n'));
                                return names.find(column_of_answers) != names.npos;
                            },
                        .option = "--csv"};

} // namespace

void expect_place_for_answers(const std::string& path)
{
    expect_place_for_text(path, table);
}

void write_answers(const std::string& path, std::string_view text)
{
    write_text(path, table, text);
}

} // namespace overturn
