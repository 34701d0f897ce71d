// The module overturn._core: the functions of the program's libraries that the Python package
// calls. Shapes and optional arguments are handled in tools/overturn/evaluation.py and records.py.
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/problem/plausibility.hpp"
#include "overturn/problem/pulse_table.hpp"
#include "overturn/record/read_record.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/nearest_name.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace py = pybind11;

namespace overturn {

namespace {

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> vector_of(const Values& values)
{
    return {values.data(), values.data() + values.size()};
}

template <class Enumeration>
Enumeration choice_of(const char* argument, const std::string& name)
{
    const auto found = enumerator_named<Enumeration>(name);
    if (!found) {
        throw std::invalid_argument(fmt::format("{} = \"{}\" is not one of {}.{}", argument, name,
                                                fmt::join(names_of<Enumeration>, ", "),
                                                suggestion(name, names_of<Enumeration>)));
    }
    return *found;
}

double allowed(const char* name, double value)
{
    const Quantity& rule = quantity(name);
    if (!rule.allows(value)) {
        throw std::invalid_argument(name + rule.refusal_of(value));
    }
    return value;
}

/// numbers: those of its shape that are given, by name.
Pulse pulse_named(const std::string& kind, const std::map<std::string, double>& numbers)
{
    Pulse pulse{choice_of<PulseKind>("pulse", kind)};
    for (const auto& [name, number] : shape_numbers) {
        const auto given = numbers.find(std::string(name));
        const auto value = given == numbers.end() ? std::nullopt : std::optional(given->second);
        const std::string refusal = refusal_of(pulse.kind, number, value);
        if (!refusal.empty()) {
            throw std::invalid_argument(std::string(name) + refusal);
        }
        pulse.shape.*number = value.value_or(pulse.shape.*number);
    }
    return pulse;
}

/// times: over the period. Throws GivenError.
TabulatedPulse pulse_of_rows(const Values& times, const Values& values)
{
    return pulse_of_table(vector_of(times), vector_of(values)).pulse;
}

/// horizontal, second and upwards: accelerations over g, finite, the latter two of the same number
/// or empty.
Suite record_of(const Values& horizontal, const Values& second, const Values& upwards,
                double time_step)
{
    return {
        {std::make_shared<const Accelerogram>(vector_of(horizontal), vector_of(upwards),
                                              allowed("time_step", time_step), vector_of(second))}};
}

/// motion_of: what moves, the ground or a floor.
Scene scene_of(const Motion& motion, const std::string& theory, double gravity,
               const std::string& motion_of)
{
    return {motion, choice_of<Theory>("theory", theory), allowed("gravity", gravity),
            choice_of<MotionOf>("motion_of", motion_of)};
}

/// tolerance: the default of job files if it is not given.
Numerics numerics_of(const Scene& scene, const std::string& method, std::optional<double> tolerance,
                     bool resolve)
{
    Numerics numerics;
    numerics.method = choice_of<Method>("method", method);
    numerics.resolve = resolve;
    if (tolerance || resolve) {
        numerics.tolerance = allowed("tolerance", tolerance.value_or(tolerance_to_resolve_from));
    }
    if (const MotionTraits& motion = scene.motion_traits();
        numerics.method != motion.method && !motion.has_other_methods) {
        throw std::invalid_argument(fmt::format("method = \"{}\" is for pulses only, and not for a "
                                                "table. Use \"taylor\", the default.",
                                                method));
    }
    if (resolve && !knows_errors(numerics)) {
        throw std::invalid_argument(
            fmt::format("tolerance = {} is too loose for resolve = True with \"rk45\". Use at most "
                        "{}, or the method \"taylor\".",
                        numerics.tolerance, largest_rk45_tolerance_with_error));
    }
    return numerics;
}

/// Lets Python handle signals, at most ten times a second. Throws py::error_already_set, such as
/// KeyboardInterrupt.
DropRequested signal_check()
{
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds interval{100};
    return [next = Clock::now() + interval]() mutable {
        if (const auto now = Clock::now(); now >= next) {
            next = now + interval;
            const py::gil_scoped_acquire locked;
            if (PyErr_CheckSignals() != 0) {
                throw py::error_already_set();
            }
        }
        return false;
    };
}

/// Named columns of equal length: quantities of the blocks and their motions.
using Columns = std::map<std::string, Values>;

/// The grid of the blocks. Throws GivenError.
Grid grid_of_columns(const Scene& scene, const Columns& columns)
{
    std::vector<Given> given;
    for (const auto& [name, values] : columns) {
        const Quantity& quantity = overturn::quantity(name);
        const std::vector<double> rows = vector_of(values);
        for (std::size_t row = 0; row < rows.size(); ++row) {
            if (!quantity.allows(rows[row])) {
                throw GivenError(std::int64_t(row), name, quantity.refusal_of(rows[row]));
            }
        }
        given.push_back({&quantity, name, Axis(rows), GivenAs::column});
    }
    if (const std::string_view choice = scene.motion_traits().choice; !choice.empty()) {
        given.push_back({&quantity(choice), "record", Axis(AxisList{1}), GivenAs::number});
    }
    return grid_of(scene, std::move(given));
}

/// The fields of these names, which must be possible for the scene and the numerics.
std::vector<Field> fields_named(const std::vector<std::string>& names, const Scene& scene,
                                const Numerics& numerics, bool has_friction)
{
    const std::vector<Field> known = spectrum_fields();
    return mapped(names, [&](const std::string& name) {
        const auto found = std::ranges::find(known, name, &Field::name);
        if (found == known.end()) {
            const std::vector<std::string_view> known_names = mapped(known, &Field::name);
            throw std::invalid_argument(
                fmt::format("fields contains \"{}\", which is not one of {}.{}", name,
                            fmt::join(known_names, ", "), suggestion(name, known_names)));
        }
        if (const std::string reason = reason_not_to_compute(*found, scene, has_friction);
            !reason.empty()) {
            throw std::invalid_argument(
                fmt::format("fields contains \"{}\", but {}.", name, reason));
        }
        if (*found == Field::error && !knows_errors(numerics)) {
            throw std::invalid_argument(fmt::format(
                "tolerance = {} is too loose for the field \"error\" with \"rk45\". Use at "
                "most {}, or the method \"taylor\".",
                numerics.tolerance, largest_rk45_tolerance_with_error));
        }
        return *found;
    });
}

/// The fields of every block by name, and what looks like a mistake in the units as "warning".
/// Computed with the widest kernel and in the tiles of `overturn run`, so that the bits are those
/// of a list job. Columns without rows are not checked.
py::dict evaluate(const Scene& scene, const Numerics& numerics, const Columns& columns,
                  const std::vector<std::string>& names)
{
    const py::ssize_t size = columns.empty() ? 0 : columns.begin()->second.size();
    const std::vector<Field> fields =
        fields_named(names, scene, numerics, columns.contains("friction"));
    std::vector<py::array> arrays = mapped(fields, [&](Field field) {
        return std::visit(
            [&](auto value) -> py::array { return py::array_t<decltype(value)>(size); },
            fill_value(field));
    });
    std::string warning;
    if (size > 0) {
        const py::gil_scoped_release released;
        const Kernel kernel = widest_kernel();
        const DropRequested handle_signals = signal_check();
        const Problem problem{scene, grid_of_columns(scene, columns), numerics, Spectrum(), fields};
        const Tiling tiling = tiling_of(problem);
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            const Tile tile = tiling[number];
            const TileFields computed = compute_tile(problem, tile, kernel, handle_signals);
            for (std::size_t i = 0; i < fields.size(); ++i) {
                std::visit(
                    [&]<class Value>(const std::vector<Value>& values) {
                        std::ranges::copy(values, static_cast<Value*>(arrays[i].mutable_data()) +
                                                      tile.begin[0]);
                    },
                    computed.values[i]);
            }
        }
        warning = implausible_values(scene, problem.grid);
    }
    py::dict outcome;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        outcome[py::str(names[i])] = arrays[i];
    }
    outcome["warning"] = warning;
    return outcome;
}

/// A component of a file: a dictionary of the members of Record in tools/overturn/records.py, and
/// the remarks on it.
py::dict component_of(const std::string& path, const ComponentChoice& choice,
                      std::optional<double> time_step, const std::optional<std::string>& units,
                      double gravity)
{
    RecordOptions options;
    options.time_step = time_step;
    if (units) {
        options.unit = choice_of<AccelerationUnit>("units", *units);
    }
    allowed("gravity", gravity);
    const RecordFile file = [&] {
        const py::gil_scoped_release released;
        return read_record(path, options);
    }();
    const ChosenComponent chosen = chosen_component(file, choice, path);
    if (chosen.component == nullptr) {
        throw std::invalid_argument(fmt::format(
            "component = {} {}",
            std::visit([](const auto& given) { return fmt::format("{}", given); }, choice),
            chosen.refusal));
    }
    using namespace py::literals;
    const RecordComponent& component = *chosen.component;
    const std::vector<double> values = over_gravity(component, gravity);
    py::list header; // in any encoding
    for (const std::string& line : component.header) {
        header.append(py::reinterpret_steal<py::str>(
            PyUnicode_DecodeUTF8(line.data(), py::ssize_t(line.size()), "replace")));
    }
    return py::dict("name"_a = component.name,
                    "acceleration"_a =
                        py::array_t<double>(py::ssize_t(values.size()), values.data()),
                    "time_step"_a = component.time_step, "format"_a = file.format,
                    "is_uncorrected"_a = component.is_uncorrected, "header"_a = header,
                    "motion_of"_a = name_of(component.motion_of.value_or(MotionOf::ground)),
                    "ground_pga"_a = component.ground_pga, "remarks"_a = component.remarks);
}

/// The regions of this kind by name.
py::dict regions(bool (*is_of_kind)(Region))
{
    py::dict codes;
    for (int code = 0; code < 256; ++code) {
        const auto region = Region(code);
        if (is_of_kind(region)) {
            codes[py::str(std::string(name_of(region)))] = code;
        }
    }
    return codes;
}

/// The fields of a spectrum by name.
py::dict all_spectrum_fields()
{
    using namespace py::literals;
    py::dict rows;
    for (const Field field : spectrum_fields()) {
        const FieldTraits& row = traits_of(field);
        rows[py::str(row.name)] =
            py::dict("type"_a = name_of(row.type), "long_name"_a = row.long_name,
                     "units"_a = row.units, "comment"_a = row.comment);
    }
    return rows;
}

/// The quantities that may differ from point to point, by name; `motion`: under which.
py::dict all_coordinates()
{
    using namespace py::literals;
    py::dict rows;
    for (const Quantity& row : all_quantities()) {
        if (row.is_coordinate() && row.role != Role::motion) {
            rows[py::str(row.name)] =
                py::dict("long_name"_a = row.long_name, "units"_a = row.printed_units(),
                         "allowed"_a = row.interval.text, "same_as"_a = row.scope.same_as,
                         "default"_a = row.scope.standard, "role"_a = name_of(row.role),
                         "motion"_a = row.scope.motion == Under::pulse    ? "pulse"
                                      : row.scope.motion == Under::record ? "record"
                                                                          : "any");
        }
    }
    return rows;
}

PYBIND11_MODULE(_core, module)
{
    const py::class_<Pulse> pulse(module, "Pulse");
    const py::class_<TabulatedPulse> tabulated_pulse(module, "TabulatedPulse");
    const py::class_<Suite> suite(module, "Suite");
    const py::class_<Scene> scene(module, "Scene");
    const py::class_<Numerics> numerics(module, "Numerics");
    module.def("pulse", &pulse_named);
    module.def("pulse_of_rows", &pulse_of_rows);
    module.def("record", &record_of);
    module.def("scene", &scene_of);
    module.def("numerics", &numerics_of);
    module.def("evaluate", &evaluate);
    module.def("component_of", &component_of);
    module.attr("__version__") = OVERTURN_VERSION;
    // Earlier versions of pybind11 exchange wrong values with NumPy 2, without an error.
    module.attr("supports_numpy_2") = PYBIND11_VERSION_HEX >= 0x020C0000;
    module.attr("fields") = all_spectrum_fields();
    module.attr("coordinates") = all_coordinates();
    module.attr("safe_regions") = regions(&is_safe);
    module.attr("unsafe_regions") = regions(&is_unsafe);

    // GivenError(row, quantity, message)
    static py::exception<GivenError> given_error(module, "GivenError", PyExc_ValueError);
    static py::exception<Error> record_error(module, "RecordError", PyExc_ValueError);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(std::move(thrown));
        } catch (const GivenError& error) {
            const py::tuple arguments =
                py::make_tuple(error.row(), error.quantity(), std::string(error.what()));
            PyErr_SetObject(given_error.ptr(), arguments.ptr());
        } catch (const Error& error) {
            const bool is_of_record = error.code() == exit_code::job; // otherwise of the processor
            PyErr_SetString(is_of_record ? record_error.ptr() : PyExc_RuntimeError, error.what());
        }
    });
}

} // namespace

} // namespace overturn
