#include "read_steps.hpp"

#include "overturn/mechanics/pulse_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace overturn {

namespace {

PulseShape read_shape(const Entry& scene, PulseKind pulse)
{
    PulseShape shape;
    for (const auto& [name, number] : shape_numbers) {
        const auto entry = find(scene, name);
        const auto value = entry ? std::optional(number_of(*entry)) : std::nullopt;
        const std::string refusal = refusal_of(pulse, number, value);
        if (!refusal.empty()) {
            refuse(entry ? *entry : Entry{scene.node, fmt::format("{}.{}", scene.key, name)},
                   refusal);
        }
        shape.*number = value.value_or(shape.*number);
    }
    return shape;
}

} // namespace

Scene read_scene(const Entry& job)
{
    require(job, "scene", "Add [scene] with a pulse or a record.");
    const Entry entry = table_of(job, "scene");
    Scene scene;
    scene.theory = choice_of(entry, "theory", theory_names, scene.theory);
    scene.gravity = quantity_of(entry, "gravity", scene.gravity);
    const bool is_recorded = find(entry, "record").has_value();
    for (const std::string_view key : scene_keys_of(is_recorded ? Under::pulse : Under::record)) {
        if (const auto other = find(entry, key)) {
            refuse(*other, is_recorded
                               ? " cannot be combined with scene.record. Remove one of them."
                               : " has no meaning without scene.record. Remove it.");
        }
    }
    if (is_recorded) {
        return scene;
    }
    const Entry pulse =
        require(entry, "pulse",
                fmt::format("Give one of {}; or record, the path of a recorded ground motion.",
                            fmt::join(pulse_names, ", ")));
    scene.pulse = choice_of<PulseKind>(pulse, pulse_names);
    scene.shape = read_shape(entry, scene.pulse);
    return scene;
}

double cut_by_window(const Scene& scene)
{
    const PulseMotion<double> motion = pulse_motion<double>(scene.pulse, scene.shape);
    return has_window(scene.pulse) ? std::abs(motion.values(std::array{motion.end})[0]) : 0;
}

Numerics read_numerics(const Entry& job, bool is_recorded)
{
    const Entry entry = table_of(job, "numerics");
    Numerics numerics;
    numerics.method =
        choice_of(entry, "method", method_names, is_recorded ? Method::taylor : numerics.method);
    if (is_recorded && numerics.method != Method::taylor) {
        refuse(*find(entry, "method"),
               " = \"{}\" is for pulses only. Under a record, use \"taylor\", the default.",
               name_of(numerics.method));
    }
    numerics.resolve = boolean_of(entry, "resolve", numerics.resolve);
    numerics.tolerance = quantity_of(
        entry, "tolerance", numerics.resolve ? tolerance_to_resolve_from : numerics.tolerance);
    numerics.fill = boolean_of(entry, "fill", numerics.fill);
    numerics.audit = quantity_of(entry, "audit", numerics.audit);
    if (const auto audit = find(entry, "audit"); audit && !numerics.fill) {
        refuse(*audit, " needs fill = true: without filling, every point is integrated.");
    }
    return numerics;
}

void expect_fillable(const Entry& entry, const Problem& problem)
{
    const std::string reason = problem.numerics.fill ? reason_not_to_fill(problem) : "";
    if (!reason.empty()) {
        refuse(*find(*find(entry, "numerics"), "fill"),
               " = true is not possible: {}. Remove it to integrate every point.", reason);
    }
}

void expect_known_errors(const Entry& job, const Problem& problem)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const bool asked =
        numerics.resolve || std::find(fields.begin(), fields.end(), Field::error) != fields.end();
    if (asked && !knows_errors(numerics)) {
        refuse(*find(*find(job, "numerics"), "tolerance"),
               " = {} is too loose for {}: above {} the steps of \"rk45\" are too long for "
               "reliable error bounds. Lower it, or use method = \"taylor\".",
               numerics.tolerance, numerics.resolve ? "resolve" : "the field \"error\"",
               largest_rk45_tolerance_with_error);
    }
}

std::vector<Field> read_fields(const Entry& job)
{
    const auto entry = find(table_of(job, "output"), "fields");
    if (!entry) {
        return {Field::region};
    }
    const std::size_t size = array_size(
        *entry, "an array of strings, such as [\"region\"]",
        fmt::format("Give at least one of {}.", fmt::join(spectrum_field_names(), ", ")));
    std::vector<Field> fields;
    for (std::size_t i = 0; i < size; ++i) {
        const auto field = choice_of<Field>(element(*entry, i), spectrum_field_names());
        if (std::ranges::count(fields, field) > 0) {
            refuse(element(*entry, i), " = \"{}\" is listed twice. List each field once.",
                   name_of(field));
        }
        fields.push_back(field);
    }
    return fields;
}

} // namespace overturn
