#include "read_steps.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"

namespace overturn {

namespace {

/// The list of values in TOML, each formatted by text_of.
template <class Values, class TextOf>
std::string list_text(const Values& values, const TextOf& text_of)
{
    return fmt::format("[{}]", fmt::join(mapped(values, text_of), ", "));
}

std::string axis_text(const Axis& axis)
{
    if (const auto* list = std::get_if<AxisList>(&axis.definition())) {
        return fmt::format("{{ values = {} }}", list_text(*list, float_text));
    }
    const auto& range = std::get<AxisRange>(axis.definition());
    return fmt::format("{{ first = {}, last = {}, count = {}, spacing = \"{}\" }}",
                       float_text(range.first), float_text(range.last), range.count,
                       name_of(range.spacing));
}

/// One line, so that two jobs with different records differ in the line that names the record.
std::string motion_text(const RecordedMotion& motion)
{
    const IntensityMeasures& measures = motion.measures;
    return fmt::format(
        "{{ file = {}, component = {}, {}vertical = {}, samples = {}, time_step = {}, pga = {}, "
        "pgv = {}, arias_intensity = {}, significant_duration = {}, {}checksum = {} }}",
        in_quotes(motion.file), in_quotes(motion.component),
        motion.second.empty() ? ""
                              : fmt::format("second_component = {}, ", in_quotes(motion.second)),
        in_quotes(motion.vertical), motion.record->samples(),
        float_text(motion.record->time_step()), float_text(measures.pga), float_text(measures.pgv),
        float_text(measures.arias_intensity), float_text(measures.significant_duration),
        motion.ground_pga ? fmt::format("ground_pga = {}, ", float_text(*motion.ground_pga)) : "",
        in_quotes(motion.checksum));
}

std::string shape_text(const ShapeTable& table)
{
    return fmt::format(
        "shape = {{ file = {}, rows = {}, periods = {}, peak = {}, checksum = {} }}\n",
        in_quotes(table.file), table.shape->samples(), float_text(table.periods),
        float_text(table.peak), in_quotes(table.checksum));
}

std::string scene_text(const Job& job)
{
    const Scene& scene = job.problem.scene;
    std::string text = "[scene]\n";
    const auto pulse = scene.named_pulse();
    if (pulse) {
        text += fmt::format("pulse = \"{}\"\n", pulse->name);
        text += job.shape ? shape_text(*job.shape) : "";
    } else {
        const std::vector<std::string> motions = mapped(job.motions, motion_text);
        const bool is_suite = job.problem.grid.dimension_of(Role::motion).has_value();
        text += is_suite ? fmt::format("record = [\n    {},\n]\n", fmt::join(motions, ",\n    "))
                         : fmt::format("record = {}\n", motions.front());
    }
    if (scene.motion_of != Scene().motion_of) {
        text += fmt::format("motion_of = \"{}\"\n", name_of(scene.motion_of));
    }
    text += fmt::format("theory = \"{}\"\n", name_of(scene.theory));
    if (scene.gravity != Scene().gravity ||
        Coordinates(scene, job.problem.grid).has("frequency_parameter")) {
        text += fmt::format("gravity = {}\n", float_text(scene.gravity));
    }
    if (pulse) {
        for (const auto& [name, value] : pulse->numbers) {
            text += fmt::format("{} = {}\n", name, float_text(value));
        }
    }
    return text;
}

std::string blocks_text(const BlockTable& blocks)
{
    return fmt::format("\n[blocks]\ntable = {}\nrows = {}\ncolumns = {}\nchecksum = {}\n",
                       in_quotes(blocks.file), blocks.table.rows(),
                       list_text(blocks.table.columns,
                                 [](const TableColumn& column) { return in_quotes(column.name); }),
                       in_quotes(blocks.checksum));
}

std::string plane_text(const Grid& grid)
{
    std::string text;
    for (const Column* column : grid.outside_table()) {
        const std::string_view name = column->quantity->name;
        text += fmt::format("{} = {}\n", name,
                            grid.dimension_of(name) ? axis_text(column->values)
                                                    : float_text(column->values.first()));
    }
    return text.empty() ? "" : "\n[plane]\n" + text;
}

} // namespace

std::string resolved_text(const Job& job)
{
    const Problem& problem = job.problem;
    std::string text =
        fmt::format("title = {}\n\n{}{}{}", in_quotes(job.title), scene_text(job),
                    job.blocks ? blocks_text(*job.blocks) : "", plane_text(problem.grid));
    if (const Boundaries* boundaries = problem.product.boundaries();
        boundaries != nullptr && boundaries->along != nullptr) {
        text += fmt::format("\n[boundary]\nalong = {}\n", in_quotes(boundaries->along->name));
    }
    if (problem.product.has_settings()) { // a boundary ignores both
        std::vector<Field> fields = problem.fields;
        std::erase(fields, Field::evaluated);
        const Numerics& numerics = problem.numerics;
        const auto audit = problem.product.audit();
        text += fmt::format(
            "\n[numerics]\nmethod = \"{}\"\ntolerance = {}\n{}{}\n[output]\nfields = {}\n{}",
            name_of(numerics.method), float_text(numerics.tolerance),
            numerics.resolve ? "resolve = true\n" : "",
            audit ? fmt::format("fill = true\naudit = {}\n", float_text(*audit)) : "",
            list_text(fields, [](Field field) { return in_quotes(name_of(field)); }),
            is_one_of(Precision::single_precision, mapped(fields, &Field::precision))
                ? fmt::format("precision = {}\n", in_quotes(name_of(Precision::single_precision)))
                : "");
    }
    return text;
}

} // namespace overturn
