#include "file_pattern.hpp"

#include "overturn/text/utf8.hpp"

#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <system_error>

namespace overturn {

namespace {

namespace fs = std::filesystem;

/// The text as a pattern that matches only itself.
std::string literally(std::string_view text)
{
    std::string pattern;
    for (const char letter : text) {
        pattern += std::string_view("*?[\\").find(letter) != std::string_view::npos ? "\\" : "";
        pattern += letter;
    }
    return pattern;
}

/// The text with its first folders literally, as long as they exist under these names in the
/// folder: `d \[1]/*.AT2` of `d [1]/*.AT2`.
std::string with_literal_folders(std::string_view text, const fs::path& folder)
{
    std::size_t literal = 0; // length of the folders that exist, with a slash behind each
    std::error_code not_found;
    for (std::size_t end = text.find('/'); end != text.npos; end = text.find('/', literal)) {
        if (!fs::is_directory(folder / text.substr(0, end + 1), not_found)) {
            break;
        }
        literal = end + 1;
    }
    return literally(text.substr(0, literal)) + std::string(text.substr(literal));
}

/// The length of the wildcard with which a pattern begins: *, ?, or a set such as [0-9]; 0 if it
/// begins with another character.
std::size_t wildcard_length(std::string_view pattern)
{
    if (pattern.starts_with('*') || pattern.starts_with('?')) {
        return 1;
    }
    if (!pattern.starts_with('[')) {
        return 0;
    }
    std::size_t end = pattern.starts_with("[!") || pattern.starts_with("[^") ? 2 : 1;
    end += pattern.substr(end).starts_with(']') ? 1 : 0; // one of the characters
    while (end < pattern.size() && pattern[end] != ']') {
        const bool is_class = pattern.substr(end).starts_with("[:"); // such as [:alpha:]
        const std::size_t last = is_class ? pattern.find(":]", end) : pattern.npos;
        end = last == pattern.npos ? end + 1 : last + 2;
    }
    return end < pattern.size() ? end + 1 : 0;
}

/// Of a path that the pattern matches, each as short as possible.
Parts parts_of(std::string_view pattern, std::string_view path)
{
    const auto matches = [](std::string_view one, std::string_view text) {
        return fnmatch(std::string(one).c_str(), std::string(text).c_str(), FNM_PATHNAME) == 0;
    };
    Parts parts;
    while (!pattern.empty()) {
        const std::size_t wildcard = wildcard_length(pattern);
        if (wildcard == 0) {
            pattern.remove_prefix(
                std::min<std::size_t>(pattern[0] == '\\' ? 2 : 1, pattern.size()));
            path.remove_prefix(std::min<std::size_t>(1, path.size()));
            continue;
        }
        const std::string_view rest = pattern.substr(wildcard);
        std::size_t length = 0;
        while (length < path.size() &&
               !(matches(pattern.substr(0, wildcard), path.substr(0, length)) &&
                 matches(rest, path.substr(length)))) {
            ++length;
        }
        parts.emplace_back(path.substr(0, length));
        pattern = rest;
        path.remove_prefix(length);
    }
    return parts;
}

/// In any order; relative to the folder, unless the pattern is absolute.
std::vector<Match> files_that_match(const std::string& pattern, const fs::path& folder)
{
    const bool is_absolute = fs::path(pattern).is_absolute();
    const std::string absolute =
        is_absolute ? pattern : literally((folder / "").string()) + pattern;
    glob_t found{};
    std::vector<Match> files;
    glob(absolute.c_str(), GLOB_NOSORT, nullptr, &found);
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
        const fs::path path(found.gl_pathv[i]);
        files.push_back({(is_absolute ? path : path.lexically_relative(folder)).string(),
                         parts_of(absolute, path.string())});
    }
    globfree(&found);
    return files;
}

} // namespace

bool is_pattern(const std::string& text, const fs::path& folder)
{
    std::error_code not_found;
    return text.find_first_of("*?[") != text.npos && !fs::exists(folder / text, not_found);
}

std::vector<Match> files_of(const Entry& entry, const fs::path& folder)
{
    const std::string text = string_of(entry);
    if (text.empty() || text.find('\0') != text.npos) {
        refuse(entry, " is not a file name. Give the path of a record, relative to the job file.");
    }
    if (!is_pattern(text, folder)) {
        return {{text, {}}};
    }
    std::vector<Match> files = files_that_match(with_literal_folders(text, folder), folder);
    if (files.empty()) {
        files = files_that_match(text, folder);
    }
    if (files.empty()) {
        refuse(entry,
               " = {} matches no file. It is relative to the job file, and a pattern: write [*], "
               "[?] and [[] for *, ? and [ themselves.",
               in_quotes(text));
    }
    std::ranges::sort(files, {}, &Match::file);
    const auto other = std::ranges::find_if_not(files, is_utf8, &Match::file);
    if (other != files.end()) {
        refuse(entry, " = {} matches the file {}, whose name is not UTF-8. Rename it.",
               in_quotes(text), as_utf8(other->file));
    }
    return files;
}

} // namespace overturn
