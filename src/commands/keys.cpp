#include "commands.hpp"

#include "overturn/job/schema.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/nearest_name.hpp"

#include <fmt/format.h>

namespace overturn {

namespace {

/// A row of a table in Markdown.
void print_as_row(const Key& key)
{
    fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", key.dotted(), key.type, key.units,
               key.allowed, key.standard, key.meaning);
}

void print_as_text(const Key& key)
{
    const auto part = [](std::string_view before, const std::string& text) {
        return text.empty() ? "" : fmt::format("{}{}", before, text);
    };
    fmt::print("{}\n    {}\n    {}{}{}{}\n", key.dotted(), key.meaning, key.type,
               part(" ", key.units), part(": ", key.allowed), part("; default: ", key.standard));
}

} // namespace

int keys(const KeysOptions& options)
{
    bool is_known = false;
    std::vector<std::string> names;
    for (const Key& key : all_keys()) {
        if (key.type == table_type) {
            continue;
        }
        const std::string dotted = key.dotted();
        const bool is_repeated = key.table == "block"; // as in `plane`
        if (is_one_of(options.name, {key.table, std::string_view(dotted)}) ||
            (!is_repeated && is_one_of(options.name, {std::string_view(), key.name}))) {
            (options.as_markdown ? print_as_row : print_as_text)(key);
            is_known = true;
        }
        names.insert(names.end(), {dotted, std::string(key.name)});
    }
    if (!is_known) {
        const std::vector<std::string_view> known(names.begin(), names.end());
        throw Error(exit_code::usage, "unknown key \"{}\".{} overturn keys lists all.",
                    options.name, suggestion(options.name, known));
    }
    return exit_code::complete;
}

} // namespace overturn
