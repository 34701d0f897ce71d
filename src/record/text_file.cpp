#include "overturn/record/text_file.hpp"

#include "overturn/text/error.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace overturn {

std::string text_of_file(const std::string& path, const TextFileKind& kind)
{
    const auto expect_size = [&](std::uintmax_t size) {
        if (size > kind.largest) {
            throw Error(exit_code::job, "{}: is larger than {} MiB, the maximum size of {}. {}",
                        path, kind.largest >> 20, kind.noun, kind.if_too_large);
        }
    };
    const auto expect = [&](bool is_readable) {
        if (!is_readable) {
            throw Error(exit_code::job, "{}: cannot be read: {}. {}", path,
                        std::generic_category().message(errno), kind.wanted);
        }
    };
    std::error_code unknown; // of pipes and missing files; reading reports the latter
    const std::uintmax_t announced = std::filesystem::file_size(path, unknown);
    expect_size(unknown ? 0 : announced);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    expect(file != nullptr);
    std::string text;
    std::array<char, 1 << 16> block;
    while (std::feof(file.get()) == 0 && std::ferror(file.get()) == 0) {
        const std::size_t size = std::fread(block.data(), 1, block.size(), file.get());
        expect_size(text.append(block.data(), size).size());
    }
    expect(std::ferror(file.get()) == 0);
    return text;
}

std::string canonical_path(const std::string& path)
{
    return std::filesystem::weakly_canonical(path).string();
}

} // namespace overturn
