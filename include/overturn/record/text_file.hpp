// Reads a whole file of text.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace overturn {

/// A kind of file, for messages.
struct TextFileKind {
    std::string_view noun;         ///< such as "a job file"
    std::size_t largest;           ///< larger files are refused [bytes]
    std::string_view wanted;       ///< advice if it cannot be read
    std::string_view if_too_large; ///< advice
};

/// The content of the file. Throws Error(message), which begins with the path.
template <class Error>
std::string text_of_file(const std::string& path, const TextFileKind& kind)
{
    const auto refuse_size = [&] {
        throw Error(fmt::format("{}: is larger than {} MiB, the maximum size of {}. {}", path,
                                kind.largest >> 20, kind.noun, kind.if_too_large));
    };
    const auto refuse_unreadable = [&](int error) {
        throw Error(fmt::format("{}: cannot be read: {}. {}", path,
                                std::generic_category().message(error), kind.wanted));
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
