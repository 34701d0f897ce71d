#include "file_text.hpp"

#include "overturn/job/job.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace overturn {

namespace {

// Lists of millions of values fit; something that is no job at all does not fill the memory.
constexpr std::size_t largest_file = std::size_t(64) << 20;

[[noreturn]] void refuse_file(const std::string& path, int error)
{
    throw JobError(fmt::format("{}: cannot be read: {}. Give the path of a job file.", path,
                               std::generic_category().message(error)));
}

} // namespace

std::string file_text(const std::string& path)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (!file) {
        refuse_file(path, errno);
    }
    std::string text;
    std::array<char, 1 << 16> block;
    while (const std::size_t size = std::fread(block.data(), 1, block.size(), file.get())) {
        text.append(block.data(), size);
        if (text.size() > largest_file) {
            throw JobError(
                fmt::format("{}: is larger than {} MiB, the most that a job file can be. Give "
                            "long axes as first, last and count.",
                            path, largest_file >> 20));
        }
    }
    if (std::ferror(file.get()) != 0) {
        refuse_file(path, errno);
    }
    return text;
}

} // namespace overturn
