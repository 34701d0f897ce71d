#include "toml_reading.hpp"

#include "overturn/job/job.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/nearest_name.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

// Sufficient to recognise a value, short enough for one line.
constexpr std::size_t longest_quotation = 60;

std::string joined(Names names)
{
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string dotted(const std::string& table, std::string_view name)
{
    return table.empty() ? std::string(name) : fmt::format("{}.{}", table, name);
}

/// The type and value of a node, for messages.
std::string description_of(const toml::node& node)
{
    if (const auto* text = node.as_string()) {
        return "the string " + in_quotes(shortened(text->get(), longest_quotation));
    }
    if (const auto* number = node.as_integer()) {
        return fmt::format("the integer {}", number->get());
    }
    if (const auto* number = node.as_floating_point()) {
        return "the number " + float_text(number->get());
    }
    if (const auto* boolean = node.as_boolean()) {
        return boolean->get() ? "the boolean true" : "the boolean false";
    }
    return node.is_array() ? "an array" : node.is_table() ? "a table" : "a date or time";
}

[[noreturn]] void refuse_type(const Entry& entry, std::string_view wanted)
{
    refuse(entry, " is {}, but must be {}.", description_of(*entry.node), wanted);
}

template <class Value>
const Value& value_of(const Entry& entry, std::string_view wanted)
{
    const toml::value<Value>* value = entry.node->as<Value>();
    if (value == nullptr) {
        refuse_type(entry, wanted);
    }
    return value->get();
}

/// The end of the TOML string that begins at `begin`: with one quote or three, and with escapes if
/// the quotes are double. A newline in a string of one quote is an error, after which the result
/// does not matter.
std::size_t end_of_string(std::string_view text, std::size_t begin)
{
    const char quote = text[begin];
    const std::string_view three = quote == '"' ? R"(""")" : "'''";
    const bool is_long = text.substr(begin).starts_with(three);
    std::size_t end = begin + (is_long ? 3 : 1);
    while (end < text.size() &&
           (is_long ? !text.substr(end).starts_with(three) : text[end] != quote)) {
        end += quote == '"' && text[end] == '\\' ? 2 : 1;
    }
    end += is_long ? 3 : 1;
    // Up to two quotes before the closing three belong to the string.
    for (int i = 0; is_long && i < 2 && end < text.size() && text[end] == quote; ++i) {
        ++end;
    }
    return end;
}

} // namespace

std::size_t find_deep_key(std::string_view text)
{
    constexpr std::string_view between_keys = "\n,=[]{}";
    std::size_t parts = 1;
    std::size_t i = 0;
    while (i < text.size()) {
        const char letter = text[i];
        if (letter == '"' || letter == '\'') {
            i = end_of_string(text, i);
            continue;
        }
        if (letter == '#') {
            i = text.find('\n', i);
            continue;
        }
        if (letter == '.' && ++parts > most_key_parts) {
            return i;
        }
        if (between_keys.find(letter) != text.npos) {
            parts = 1;
        }
        ++i;
    }
    return text.npos;
}

toml::table parse_toml(const std::string& text, const std::string& path, std::string_view advice)
{
    if (const std::size_t deep = find_deep_key(text); deep != text.npos) {
        const std::string_view before = std::string_view(text).substr(0, deep);
        const toml::source_position position{
            toml::source_index(std::ranges::count(before, '\n') + 1),
            toml::source_index(deep - (before.rfind('\n') + 1) + 1)};
        throw Error(exit_code::job,
                    "{}: a key has more than {} parts, but keys of a job have at most three, such "
                    "as plane.frequency.count. Shorten the key.",
                    place_of({position, position, std::make_shared<const std::string>(path)}),
                    most_key_parts);
    }
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        throw Error(exit_code::job, "{}: this is not TOML: {}. {}", place_of(error.source()),
                    on_one_line(std::string(error.description())), advice);
    }
}

std::string place_of(const toml::source_region& source)
{
    const std::string& path = *source.path;
    if (path.starts_with(override_prefix) || path == command_line) {
        return path;
    }
    return fmt::format("{}:{}:{}", path, source.begin.line, source.begin.column);
}

bool is_override(const toml::node& node)
{
    const auto& path = node.source().path;
    return path != nullptr && path->starts_with(override_prefix);
}

void expect_table(const Entry& entry, Names allowed, std::string_view or_else)
{
    const toml::table* table = entry.node->as_table();
    if (table == nullptr) {
        refuse_type(entry, fmt::format("{}a table with the keys {}", or_else, joined(allowed)));
    }
    for (const auto& [key, value] : *table) {
        if (!is_one_of(key.str(), allowed)) {
            const std::string unknown = shortened(dotted(entry.key, key.str()), longest_quotation);
            throw Error(exit_code::job, "{}: unknown key {}.{} Allowed here: {}.",
                        place_of(key.source()), in_quotes(unknown),
                        suggestion(key.str(), allowed, entry.key.empty() ? "" : entry.key + "."),
                        joined(allowed));
        }
    }
}

std::optional<Entry> find(const Entry& table, std::string_view name)
{
    const toml::node* node = table.node->as_table()->get(name);
    return node == nullptr ? std::nullopt : std::optional(Entry{node, dotted(table.key, name)});
}

Entry require(const Entry& table, std::string_view name, std::string_view advice)
{
    std::optional<Entry> entry = find(table, name);
    if (!entry) {
        refuse({table.node, dotted(table.key, name)}, " is missing. {}", advice);
    }
    return *std::move(entry);
}

Entry table_of(const Entry& job, std::string_view name)
{
    static const toml::table empty;
    const Entry entry = find(job, name).value_or(Entry{&empty, std::string(name)});
    expect_table(entry, keys_of(name));
    return entry;
}

std::size_t array_size(const Entry& entry, std::string_view wanted, std::string_view advice)
{
    const toml::array* array = entry.node->as_array();
    if (array == nullptr) {
        refuse_type(entry, wanted);
    }
    if (array->empty()) {
        refuse(entry, " is empty. {}", advice);
    }
    return array->size();
}

Entry element(const Entry& array, std::size_t i)
{
    return {array.node->as_array()->get(i), fmt::format("{}[{}]", array.key, i)};
}

std::string string_of(const Entry& entry)
{
    return value_of<std::string>(entry, "a string in quotes");
}

std::int64_t integer_of(const Entry& entry)
{
    return value_of<std::int64_t>(entry, "an integer, such as 100");
}

bool boolean_of(const Entry& table, std::string_view name, bool otherwise)
{
    const auto entry = find(table, name);
    return entry ? value_of<bool>(*entry, "true or false") : otherwise;
}

double number_of(const Entry& entry)
{
    if (const auto* integer = entry.node->as_integer()) {
        return double(integer->get());
    }
    const auto number = value_of<double>(entry, "a number, such as 0.5");
    if (!std::isfinite(number)) {
        refuse(entry, " = {} is not finite. Give a number.", number);
    }
    return number + 0.0;
}

double quantity_of(const Entry& entry, const Quantity& rule)
{
    const double value = number_of(entry);
    if (!rule.allows(value)) {
        refuse(entry, "{}", rule.refusal_of(value));
    }
    return value;
}

double quantity_of(const Entry& table, std::string_view name, double otherwise)
{
    const auto entry = find(table, name);
    return entry ? quantity_of(*entry, quantity(name)) : otherwise;
}

std::size_t index_of_name(const Entry& entry, Names names)
{
    const std::string name = string_of(entry);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        refuse(entry, " = {} is unknown.{} Allowed: {}.",
               in_quotes(shortened(name, longest_quotation)), suggestion(name, names),
               joined(names));
    }
    return std::size_t(found - names.begin());
}

std::string float_text(double value)
{
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

} // namespace overturn
