// Instead of record/text_file.cpp and job/file_pattern.cpp: files that the page passed, by name.
#include "files_in_memory.hpp"

#include "job/file_pattern.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/error.hpp"

#include <map>

namespace overturn {

namespace {

std::map<std::string, std::string, std::less<>>& files()
{
    static std::map<std::string, std::string, std::less<>> all;
    return all;
}

} // namespace

void add_file(std::string name, std::string content)
{
    files().insert_or_assign(std::move(name), std::move(content));
}

std::string text_of_file(const std::string& path, const TextFileKind& kind)
{
    const auto found = files().find(path);
    if (found == files().end()) {
        throw Error(exit_code::job, "{}: is not one of the files that were given. {}", path,
                    kind.wanted);
    }
    if (found->second.size() > kind.largest) {
        throw Error(exit_code::job, "{}: is larger than {} MiB, the maximum size of {}. {}", path,
                    kind.largest >> 20, kind.noun, kind.if_too_large);
    }
    return found->second;
}

std::string canonical_path(const std::string& path)
{
    return path;
}

bool is_pattern(const std::string& /*text*/, const std::filesystem::path& /*folder*/)
{
    return false;
}

std::vector<Match> files_of(const Entry& entry, const std::filesystem::path& /*folder*/)
{
    return {{string_of(entry), {}}};
}

} // namespace overturn
