#include "overturn/file/answer_table.hpp"

#include "working_file.hpp"

#include "overturn/text/error.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace overturn {

void expect_place_for_answers(const std::string& path)
{
    const PartFile place(path);
    std::error_code none;
    if (!std::filesystem::exists(path, none)) {
        return;
    }
    std::string head;
    if (std::filesystem::is_regular_file(path)) { // opening a pipe would wait for its other end
        std::ifstream stream(path, std::ios::binary);
        std::getline(stream, head);
    }
    if (head.find(column_of_answers) == std::string::npos) {
        throw Error(exit_code::output,
                    "\"{}\" exists but is not a table of answers. Move it away, or choose another "
                    "name.",
                    path);
    }
}

void write_answers(const std::string& path, std::string_view text)
{
    expect_place_for_answers(path); // a file may have appeared during the computation
    PartFile part(path);
    errno = 0;
    std::ofstream stream(part.path(), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) {
        throw Error(exit_code::output, "cannot write \"{}\": {}.", path, system_reason(errno));
    }
    part.move_into_place();
}

} // namespace overturn
