#include "toml_text.hpp"

#include "overturn/job/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace overturn {

namespace {

/// The list of values in TOML, each formatted by text_of.
template <class Values, class TextOf>
std::string list_text(const Values& values, const TextOf& text_of)
{
    std::vector<std::string> texts;
    std::transform(values.begin(), values.end(), std::back_inserter(texts), text_of);
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string definition_text(const Axis& axis)
{
    if (const auto* list = std::get_if<AxisList>(&axis.definition())) {
        return "values = " + list_text(*list, float_text);
    }
    const auto& range = std::get<AxisRange>(axis.definition());
    return fmt::format("first = {}, last = {}, count = {}, spacing = \"{}\"",
                       float_text(range.first), float_text(range.last), range.count,
                       name_of(range.spacing));
}

/// One line, so that two jobs with different records differ in the line that names the record.
std::string motion_text(const Motion& motion)
{
    const IntensityMeasures& measures = motion.measures;
    std::string text =
        fmt::format("{{ file = {}, component = {}, vertical = {}, samples = {}, time_step = {}, "
                    "pga = {}, pgv = {}, arias_intensity = {}, significant_duration = {}, ",
                    in_quotes(motion.file), in_quotes(motion.component), in_quotes(motion.vertical),
                    motion.samples, float_text(motion.time_step), float_text(measures.pga),
                    float_text(measures.pgv), float_text(measures.arias_intensity),
                    float_text(measures.significant_duration));
    if (std::isfinite(motion.largest_scale)) {
        text += fmt::format("largest_scale = {}, ", float_text(motion.largest_scale));
    }
    if (motion.name != motion.file) {
        text += fmt::format("name = {}, ", in_quotes(motion.name));
    }
    return text + fmt::format("checksum = {} }}", in_quotes(motion.checksum));
}

std::string scene_text(const Job& job)
{
    const Scene& scene = job.scene;
    std::string text = "[scene]\n";
    if (scene.is_recorded()) {
        text += "record = [\n";
        for (const Motion& motion : job.motions) {
            text += fmt::format("    {},\n", motion_text(motion));
        }
        text += "]\n";
    } else {
        text += fmt::format("pulse = \"{}\"\n", name_of(scene.pulse));
    }
    text += fmt::format("theory = \"{}\"\n", name_of(scene.theory));
    if (scene.is_recorded() || job.blocks || job.plane.size || scene.gravity != Scene().gravity) {
        text += fmt::format("gravity = {}\n", float_text(scene.gravity));
    }
    for (const auto& [name, number] : shape_numbers) {
        if (!scene.is_recorded() && has_number(scene.pulse, number)) {
            text += fmt::format("{} = {}\n", name, float_text(scene.shape.*number));
        }
    }
    return text;
}

std::string blocks_text(const BlockTable& blocks, const BlockList& list)
{
    return fmt::format("[blocks]\ntable = {}\nrows = {}\ncolumns = {}\nown_motions = {}\n"
                       "checksum = {}\n",
                       in_quotes(blocks.file), list.size, list_text(blocks.columns, in_quotes),
                       list.has_own_motions, in_quotes(blocks.checksum));
}

/// The axes that are not replaced by a list of blocks.
std::string axes_text(const Plane& plane)
{
    if (plane.list->has_own_motions) {
        return "";
    }
    std::string text = fmt::format("\n[plane]\n{} = {{ {} }}\n", name_of(plane.amplitude_is),
                                   definition_text(plane.amplitude));
    if (plane.motions == 0) {
        text += fmt::format("{} = {{ {} }}\n", name_of(plane.frequency_is),
                            definition_text(plane.frequency));
    }
    return text;
}

std::string plane_text(const Plane& plane)
{
    std::string text = "[plane]\n";
    if (plane.motions == 0 || !plane.block) {
        text += fmt::format("{} = {{ {} }}\n", name_of(plane.frequency_is),
                            definition_text(plane.frequency));
    }
    text += fmt::format("{} = {{ {} }}\nrestitution = {{ {}, of = \"{}\" }}\n",
                        name_of(plane.amplitude_is), definition_text(plane.amplitude),
                        definition_text(plane.restitution), name_of(plane.restitution_of));
    if (plane.block) {
        text +=
            fmt::format("\n[block]\nhalf_width = {}\nhalf_height = {}\n",
                        float_text(plane.block->half_width), float_text(plane.block->half_height));
    } else {
        text += fmt::format("slenderness = {{ {} }}\n", definition_text(plane.slenderness));
        if (plane.size) {
            text += fmt::format("size = {}\n", float_text(*plane.size));
        }
    }
    return text;
}

} // namespace

std::string resolved_text(const Job& job)
{
    std::string text =
        fmt::format("title = {}\n\n{}\n{}", in_quotes(job.title), scene_text(job),
                    job.blocks ? blocks_text(*job.blocks, *job.plane.list) + axes_text(job.plane)
                               : plane_text(job.plane));
    if (job.product == Product::spectrum) { // a boundary ignores both
        std::vector<Field> fields = job.fields;
        std::erase(fields, Field::evaluated);
        text +=
            fmt::format("\n[numerics]\nmethod = \"{}\"\ntolerance = {}\n{}{}\n"
                        "[output]\nfields = {}\n",
                        name_of(job.numerics.method), float_text(job.numerics.tolerance),
                        job.numerics.resolve ? "resolve = true\n" : "",
                        job.numerics.fill ? fmt::format("fill = true\naudit = {}\n",
                                                        float_text(job.numerics.audit))
                                          : "",
                        list_text(fields, [](Field field) { return in_quotes(name_of(field)); }));
    }
    return text;
}

std::string in_quotes(std::string_view text)
{
    std::string result = "\"";
    for (const char letter : text) {
        const auto code = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\') {
            result += '\\';
            result += letter;
        } else if (code < 0x20 || code == 0x7f) {
            result += fmt::format("\\u{:04X}", code);
        } else {
            result += letter;
        }
    }
    return result + '"';
}

std::string float_text(double value)
{
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string shortened(std::string_view text, std::size_t longest)
{
    if (text.size() <= longest) {
        return std::string(text);
    }
    // Do not split a UTF-8 character, whose continuation bytes are 10xxxxxx.
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) {
        --end;
    }
    return std::string(text.substr(0, end)) + "...";
}

std::string on_one_line(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](unsigned char letter) { return letter < 0x20; }, ' ');
    return text;
}

} // namespace overturn
