#include "overturn/file/text_outputs.hpp"

#include "working_file.hpp"

#include "overturn/text/error.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace overturn {

namespace {

/// A kind of text file.
struct TextOutput {
    std::string_view name; ///< in sentences
    bool (*is_own)(std::string_view beginning);
    std::string_view option; ///< that chooses the path
};

constexpr TextOutput answers{
    "a table of answers",
    [](std::string_view beginning) {
        return beginning.substr(0, beginning.find('\n')).find(column_of_answers) != beginning.npos;
    },
    "--csv"};

constexpr TextOutput sidecar{
    "the sidecar file of this run",
    [](std::string_view beginning) { return beginning.starts_with(sidecar_beginning); }, "-o"};

void expect_place(const std::string& path, const TextOutput& kind)
{
    const PartFile place(path);
    std::error_code none;
    if (!std::filesystem::exists(path, none)) {
        return;
    }
    std::string beginning(1 << 16, '\0');
    std::streamsize size = 0;
    if (std::filesystem::is_regular_file(path)) { // opening a pipe would wait for its other end
        std::ifstream stream(path, std::ios::binary);
        size = stream.read(beginning.data(), std::streamsize(beginning.size())).gcount();
    }
    if (!kind.is_own(std::string_view(beginning).substr(0, std::size_t(size)))) {
        throw Error(exit_code::output,
                    "\"{}\" exists but is not {}. Move it away, or choose another name with {}.",
                    path, kind.name, kind.option);
    }
}

/// The message of the error ends with `consequence`.
void write(const std::string& path, const TextOutput& kind, std::string_view text,
           const std::string& consequence, Syncing syncing)
{
    expect_place(path, kind); // a file may have appeared during the computation
    PartFile part(path);
    errno = 0;
    std::ofstream stream(part.path(), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) {
        throw Error(exit_code::output, "cannot write \"{}\", {}: {}.{}", path, kind.name,
                    system_reason(errno), consequence);
    }
    part.move_into_place(syncing);
}

} // namespace

void expect_place_for_answers(const std::string& path)
{
    expect_place(path, answers);
}

void write_answers(const std::string& path, std::string_view text)
{
    write(path, answers, text, "", Syncing::yes);
}

void expect_place_for_sidecar(const std::string& result_path)
{
    expect_place(result_path + ".json", sidecar);
}

void write_sidecar(const std::string& result_path, std::string_view text, Syncing syncing)
{
    write(result_path + ".json", sidecar, text,
          fmt::format(" The computed tiles are in \"{0}\" nevertheless: overturn info {0} says "
                      "whether some are missing.",
                      result_path),
          syncing);
}

} // namespace overturn
