#include "overturn/record/text_file.hpp"

#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace overturn {

std::string text_of_file(const std::string& path, const TextFileKind& kind)
{
    const auto refuse_size = [&] {
        throw Error(exit_code::job, "{}: is larger than {} MiB, the maximum size of {}. {}", path,
                    kind.largest >> 20, kind.noun, kind.if_too_large);
    };
    const auto refuse_unreadable = [&](int error) {
        throw Error(exit_code::job, "{}: cannot be read: {}. {}", path,
                    std::generic_category().message(error), kind.wanted);
    };
    std::error_code ignored; // of pipes and missing files; reading reports the latter
    if (const auto size = std::filesystem::file_size(path, ignored);
        !ignored && size > kind.largest) {
        refuse_size();
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (!file) {
        refuse_unreadable(errno);
    }
    std::string text;
    std::array<char, 1 << 16> block;
    while (const std::size_t size = std::fread(block.data(), 1, block.size(), file.get())) {
        text.append(block.data(), size);
        if (text.size() > kind.largest) {
            refuse_size();
        }
    }
    if (std::ferror(file.get()) != 0) {
        refuse_unreadable(errno);
    }
    return text;
}

} // namespace overturn
