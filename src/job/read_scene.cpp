#include "read_steps.hpp"

#include <fmt/format.h>

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

} // namespace overturn
