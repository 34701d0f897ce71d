#include "hostile_input.hpp"

#include "overturn/record/read_record.hpp"
#include "overturn/text/error.hpp"
#include "support/scratch_folder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace overturn {

namespace {

/// Removes a line that begins with the key, and returns its rest; nullopt if there is none.
std::optional<std::string_view> take_line(std::string_view& bytes, std::string_view key)
{
    if (!bytes.starts_with(key)) {
        return std::nullopt;
    }
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    return line.substr(key.size());
}

RecordOptions take_options(std::string_view& bytes)
{
    RecordOptions options;
    if (const auto name = take_line(bytes, "unit ")) {
        options.unit = enumerator_named<AccelerationUnit>(*name).value_or(AccelerationUnit::g);
    }
    if (const auto text = take_line(bytes, "time_step ")) {
        double step = 0;
        std::from_chars(text->data(), text->data() + text->size(), step);
        options.time_step = step;
    }
    return options;
}

void use_component(const RecordComponent& component)
{
    const auto is_finite = [](double a) { return std::isfinite(a); };
    const auto is_line = [](const std::string& line) { return line.find('\n') == line.npos; };
    demand(!component.acceleration.empty() && component.acceleration.size() <= most_samples,
           "a component has no samples, or too many");
    demand(std::all_of(component.acceleration.begin(), component.acceleration.end(), is_finite),
           "a sample is not finite");
    demand(component.time_step > 0 && is_finite(component.time_step), "a time step is not above 0");
    demand(std::all_of(component.header.begin(), component.header.end(), is_line),
           "a line of a header has a line end");
}

} // namespace

Response use_as_record(std::string_view bytes, const std::string& path)
{
    const RecordOptions options = take_options(bytes);
    write_bytes(path, std::string(bytes));
    try {
        const RecordFile file = read_record(path, options);
        demand(!file.components.empty(), "a record has no components");
        std::for_each(file.components.begin(), file.components.end(), use_component);
        return Response::accepted;
    } catch (const Error& error) {
        const std::string message = error.what();
        demand(message.starts_with(path + ":"), "a refusal does not name the file: " + message);
        demand(message.ends_with('.') && message.find('\n') == message.npos,
               "a refusal is not one sentence after another: " + message);
        return Response::refused;
    }
}

} // namespace overturn
