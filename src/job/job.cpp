#include "overturn/job/job.hpp"

#include "read_steps.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"

#include <filesystem>

namespace overturn {

namespace {

// Sufficient for lists of millions of values; a file that is not a job cannot fill the memory.
constexpr TextFileKind job_file{"a job file", std::size_t(64) << 20, "Give the path of a job file.",
                                "Give long axes as first, last and count."};

PulseShape read_shape(const Entry& scene, PulseKind pulse)
{
    PulseShape shape;
    for (const auto& [name, number] : shape_numbers) {
        const auto entry = find(scene, name);
        const auto value = entry ? std::optional(number_of(*entry)) : std::nullopt;
        if (const std::string refusal = refusal_of(pulse, number, value); !refusal.empty()) {
            refuse(entry.value_or(Entry{scene.node, fmt::format("{}.{}", scene.key, name)}), "{}",
                   refusal);
        }
        shape.*number = value.value_or(shape.*number);
    }
    return shape;
}

/// Reads the pulse of [scene], without the table of its shape.
Motion read_pulse(const Entry& scene)
{
    const Entry pulse =
        require(scene, "pulse",
                fmt::format("Give one of {}; or record, the path of a recorded ground motion.",
                            fmt::join(pulse_names, ", ")));
    const std::size_t number = index_of_name(pulse, pulse_names);
    const auto shape = find(scene, "shape");
    if (number < pulses.size()) {
        if (shape) {
            refuse(*shape, "{}", refusal_of_key(pulse_names[number], TabulatedPulse::name));
        }
        return Pulse{PulseKind(number), read_shape(scene, PulseKind(number))};
    }
    require(scene, "shape",
            "Give the path of a table of two columns, time over the period and value; or a list of "
            "[time, value].");
    for (const auto& [name, of_others] : shape_numbers) {
        if (const auto entry = find(scene, name)) {
            refuse(*entry, "{}", refusal_of_key(TabulatedPulse::name, pulses_with(of_others)));
        }
    }
    return TabulatedPulse();
}

/// Reads [scene], without its records and tables.
Scene read_scene(const Entry& job)
{
    require(job, "scene", "Add [scene] with a pulse or a record.");
    const Entry entry = table_of(job, "scene");
    Scene scene;
    scene.theory = choice_of(entry, "theory", scene.theory);
    scene.gravity = quantity_of(entry, "gravity", scene.gravity);
    const bool is_recorded = find(entry, "record").has_value();
    const MotionTraits& motion = is_recorded ? Suite::traits : Pulse::traits;
    for (const std::string_view key : keys_of("scene", motion.under_others)) {
        if (const auto other = find(entry, key)) {
            refuse(*other, "{} Remove {}.",
                   is_recorded ? " cannot be combined with scene.record."
                               : " has no meaning without scene.record.",
                   is_recorded ? "one of them" : "it");
        }
    }
    if (is_recorded) {
        scene.motion = Suite();
    } else {
        scene.motion = read_pulse(entry);
    }
    return scene;
}

/// Reads [numerics].
Numerics read_numerics(const Entry& job, const MotionTraits& motion)
{
    const Entry entry = table_of(job, "numerics");
    Numerics numerics;
    numerics.method = choice_of(entry, "method", motion.method);
    if (numerics.method != motion.method && !motion.has_other_methods) {
        refuse(*find(entry, "method"),
               " = \"{}\" is for pulses only, and not for a table. Use \"taylor\", the default.",
               name_of(numerics.method));
    }
    numerics.resolve = boolean_of(entry, "resolve", numerics.resolve);
    numerics.tolerance = quantity_of(
        entry, "tolerance", numerics.resolve ? tolerance_to_resolve_from : numerics.tolerance);
    return numerics;
}

/// Reads the product from [numerics].
Product read_product(const Entry& job)
{
    const Entry entry = table_of(job, "numerics");
    FilledSpectrum filled;
    filled.audit = quantity_of(entry, "audit", filled.audit);
    if (boolean_of(entry, "fill", false)) {
        return filled;
    }
    if (const auto audit = find(entry, "audit")) {
        refuse(*audit, " needs fill = true: without filling, every point is integrated.");
    }
    return Spectrum();
}

/// Reads the quantity of [boundary]; nullptr: the strength.
const Quantity* read_along(const Entry& job)
{
    const auto entry = find(table_of(job, "boundary"), "along");
    if (!entry) {
        return nullptr;
    }
    const std::vector<std::string_view> names = scanned_quantities();
    const Quantity& along = quantity(names[index_of_name(*entry, names)]);
    return along.role == Role::strength ? nullptr : &along;
}

/// Reads output.fields.
std::vector<Field> read_field_names(const Entry& output)
{
    const auto entry = find(output, "fields");
    if (!entry) {
        return default_fields;
    }
    const std::vector<Field> known = spectrum_fields();
    const std::vector<std::string_view> names = mapped(known, &Field::name);
    const std::size_t size =
        array_size(*entry, "an array of strings, such as [\"region\"]",
                   fmt::format("Give at least one of {}.", fmt::join(names, ", ")));
    std::vector<Field> fields;
    for (std::size_t i = 0; i < size; ++i) {
        const Field field = known[index_of_name(element(*entry, i), names)];
        if (is_one_of(field, fields)) {
            refuse(element(*entry, i), " = \"{}\" is listed twice. List each field once.",
                   name_of(field));
        }
        fields.push_back(field);
    }
    return fields;
}

/// Reads [output].
std::vector<Field> read_fields(const Entry& job)
{
    const Entry entry = table_of(job, "output");
    std::vector<Field> fields = read_field_names(entry);
    const Precision precision = choice_of(entry, "precision", Precision::double_precision);
    for (Field& field : fields) {
        if (traits_of(field).type == FieldType::float64) {
            field.precision = precision;
        }
    }
    return fields;
}

/// How to fill without the fields that cannot be filled; empty if that is not enough.
std::string advice_on_filled_fields(Problem problem)
{
    std::erase_if(problem.fields,
                  [](Field field) { return traits_of(field).of != FieldOf::filled_point; });
    if (problem.fields.empty()) {
        problem.fields = {Field::region};
    }
    return reason_not_to_fill(problem).empty()
               ? fmt::format(", or --set 'output.fields=[\"{}\"]' to fill",
                             fmt::join(mapped(problem.fields, &Field::name), "\", \""))
               : "";
}

/// Refuses numerics and fields that are not possible for the scene and the points: error bounds at
/// a loose tolerance, forces of the contact in the linear theory, filling.
void expect_computable(const Entry& job, const Problem& problem)
{
    const Numerics& numerics = problem.numerics;
    const auto key = [&](std::string_view table, std::string_view name) {
        return *find(*find(job, table), name);
    };
    if ((numerics.resolve || is_one_of(Field::error, problem.fields)) && !knows_errors(numerics)) {
        refuse(key("numerics", "tolerance"),
               " = {} is too loose for {}: above {} the steps of \"rk45\" are too long for "
               "reliable error bounds. Lower it, or use method = \"taylor\".",
               numerics.tolerance, numerics.resolve ? "resolve" : "the field \"error\"",
               largest_rk45_tolerance_with_error);
    }
    for (const Field field : problem.fields) {
        if (const std::string reason =
                reason_not_to_compute(field, problem.scene, problem.grid.may_slip());
            !reason.empty()) {
            refuse(key("output", "fields"), " contains \"{}\", but {}. Remove it, or change that.",
                   name_of(field), reason);
        }
    }
    const std::string reason = problem.product.audit() ? reason_not_to_fill(problem) : "";
    if (!reason.empty()) {
        refuse(key("numerics", "fill"),
               " = true is not possible: {}. Use --set numerics.fill=false to integrate every "
               "point{}.",
               reason, advice_on_filled_fields(problem));
    }
}

/// Largest total size of the fields [bytes], with a margin to what can be addressed.
constexpr long double most_bytes = 0x1p62L;

/// Why the result of a problem is too large, as a text that follows its name; empty if it is not.
/// Computed in floating point, which cannot overflow here.
std::string excess_of(const Problem& problem)
{
    long double values = 1;
    for (const std::int64_t count : stored_shape(problem)) {
        values *= static_cast<long double>(count);
    }
    long double bytes = 0;
    for (const Field field : problem.fields) {
        bytes += values * static_cast<long double>(bytes_per_point(field));
    }
    return bytes <= most_bytes
               ? ""
               : fmt::format(" has {:.4g} {} and would take {:.4g} bytes, but at most {:.4g} are "
                             "allowed. Lower the counts.",
                             problem.product.boundaries() != nullptr
                                 ? values / double(problem.scene.motion_traits().most_flips)
                                 : values,
                             items_of(problem).name, bytes, most_bytes);
}

/// Refuses a quantity with values between its first and its last one that describe no block.
void expect_range(const Problem& problem, const Column& scanned)
{
    constexpr std::int64_t values = 17; // what follows from a shape is smooth
    const Axis range(AxisRange{scanned.values.first(), scanned.values.last(), values});
    std::vector<Given> given;
    const auto add = [&](const Column& column, GivenAs as) {
        given.push_back({column.quantity, std::string(column.quantity->name),
                         &column == &scanned ? range : column.values, as});
    };
    for (const Column& number : problem.grid.numbers) {
        add(number, GivenAs::number);
    }
    for (const Dimension& dimension : problem.grid.dimensions) {
        add(dimension.columns.front(), GivenAs::axis);
    }
    try {
        grid_of(problem.scene, std::move(given));
    } catch (const GivenError& error) {
        throw Error(exit_code::job, "plane.{}{}", error.quantity(), error.what());
    }
}

} // namespace

Job read_job(const std::string& path, const std::vector<std::string>& overrides)
{
    return read_job_text(text_of_file(path, job_file), path, overrides);
}

Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides)
{
    if (text.starts_with("\x89HDF\r\n")) {
        throw Error(exit_code::job,
                    "{0}: this is a result file, not a job file. Give the job file; to resume its "
                    "run, also -o {0}.",
                    name);
    }
    Job job;
    job.given = std::move(text);
    job.overrides = overrides;
    toml::table table =
        parse_toml(job.given, name, "Fix it here or just before; strings need \"quotes\".");
    for (const std::string& argument : overrides) {
        apply_override(table, argument);
    }
    const Entry entry{&table, ""};
    expect_table(entry, keys_of(""));
    if (const auto title = find(entry, "title")) {
        job.title = string_of(*title);
        if (job.title.find('\0') != std::string::npos) {
            refuse(*title,
                   " has a NUL character, which ends strings in other programs. Remove it.");
        }
    }
    const std::string folder = std::filesystem::path(name).parent_path().string();
    Problem& problem = job.problem;
    problem.scene = read_scene(entry);
    const Entry scene = *find(entry, "scene");
    if (auto* suite = std::get_if<Suite>(&problem.scene.motion)) {
        job.motions = read_motions(scene, folder, problem.scene.gravity);
        suite->records = mapped(job.motions, &RecordedMotion::record);
    }
    if (auto* pulse = std::get_if<TabulatedPulse>(&problem.scene.motion)) {
        job.shape = read_shape_table(scene, folder);
        pulse->shape = job.shape->shape;
    }
    problem.scene.motion_of = read_motion_of(scene, job.motions);
    problem.numerics = read_numerics(entry, problem.scene.motion_traits());
    problem.product = read_product(entry);
    job.along = read_along(entry);
    problem.fields = read_fields(entry);
    read_points(entry, folder, job);
    expect_computable(entry, problem);
    if (problem.product.audit()) {
        problem.fields.push_back(Field::evaluated);
    }
    if (const std::string excess = excess_of(problem); !excess.empty()) {
        refuse(find(entry, "plane").value_or(entry), "{}", excess);
    }
    job.resolved = resolved_text(job);
    return job;
}

Job boundary_of(Job job)
{
    Problem& problem = job.problem;
    if (job.blocks) {
        throw Error(exit_code::job,
                    "blocks.table = {}: a boundary is computed over a plane, not for a list of "
                    "blocks. Use `overturn run`, with many values of pga or scale.",
                    in_quotes(job.blocks->file));
    }
    if (problem.product.audit()) {
        throw Error(
            exit_code::job,
            "numerics.fill = true is for spectra; a boundary is found without filling. Use --set "
            "numerics.fill=false.");
    }
    const Boundaries boundaries{job.along};
    const Column* scanned = job.along != nullptr ? problem.grid.find(job.along->name)
                                                 : problem.grid.axis_or_number(Role::strength);
    if (scanned == nullptr) {
        throw Error(exit_code::job,
                    "boundary.along = \"{0}\", but {0} is not among the coordinates of the job. "
                    "Give two or more values of it.",
                    job.along->name);
    }
    if (scanned->values.size() == 1) {
        throw Error(exit_code::job,
                    "plane.{} has one value, {}, but flips are found between the first and the "
                    "last. Give two or more values.",
                    scanned->quantity->name, scanned->values.first());
    }
    if (job.along != nullptr) {
        expect_range(problem, *scanned);
    }
    problem.product = boundaries;
    problem.fields = boundary_fields(problem.scene, problem.grid, boundaries);
    job.resolved = resolved_text(job);
    // With fewer values than flips, the boundary is larger than the spectrum.
    if (const std::string excess = excess_of(problem); !excess.empty()) {
        throw Error(exit_code::job, "plane{}", excess);
    }
    return job;
}

} // namespace overturn
