#include "overturn/job/schema.hpp"

#include "overturn/problem/product.hpp"
#include "overturn/record/read_record.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overturn {

namespace {

template <class Names>
std::string words(const Names& names)
{
    return fmt::format("\"{}\"", fmt::join(names, "\", \""));
}

std::string number_text(double value)
{
    return fmt::format("{:g}", value);
}

constexpr Under always = Under::any_motion;
constexpr Under pulse = Under::pulse;
constexpr Under record = Under::record;

/// Keys other than coordinates, whose ranges are those of the quantities of the same name.
std::vector<Key> keys_with_one_value()
{
    const auto needed_for = [](ShapeNumber number) {
        return "required for " + pulses_with(number);
    };
    const Numerics numerics;
    // clang-format off
    return {
        {"", "title", always, "string", "\"\"", "shown by info and in pictures"},
        {"", "scene", always, table_type, "required", "the ground motion and the theory"},
        {"", "plane", always, table_type, "", "the coordinates of the points"},
        {"", "block", always, table_type, "", "those that describe the block, as in plane"},
        {"", "blocks", always, table_type, "", "a table of blocks"},
        {"", "numerics", always, table_type, "", "how the points are integrated"},
        {"", "output", always, table_type, "", "what is stored"},
        {"", "boundary", always, table_type, "", "what overturn boundary searches"},
        {"scene", "pulse", pulse, "string", "required without a record",
         "the ground motion", words(pulse_names)},
        {"scene", "shape", pulse, "string or list", "required for table",
         "path of a table of times over the period and values, relative to the job file, or a list "
         "of [time, value]"},
        {"scene", "window", pulse, "number", number_text(PulseShape().window),
         "half width in pulse periods; only for " + pulses_with(&PulseShape::window)},
        {"scene", "cycles", pulse, "number", needed_for(&PulseShape::cycles),
         "duration in pulse periods; refused with other pulses"},
        {"scene", "gamma", pulse, "number", needed_for(&PulseShape::gamma),
         "duration in pulse periods; refused with other pulses"},
        {"scene", "nu", pulse, "number", needed_for(&PulseShape::nu),
         "phase of the oscillation in the middle of the pulse; refused with other pulses"},
        {"scene", "record", record, "string or list", "",
         "paths of records instead of a pulse, relative to the job file, or patterns"},
        {"scene", "units", record, "string", "that of the file",
         "unit of accelerations in text files", words(names_of<AccelerationUnit>)},
        {"scene", "component", record, "string, integer or list", "1",
         "component of each record, by name or number"},
        {"scene", "second_component", record, "string, integer or list", "none",
         "second horizontal component, the path of its file, or a pattern of files that pair with "
         "the records"},
        {"scene", "vertical", record, "string, integer or list", "none",
         "vertical component, the path of its file, or a pattern of files that pair with the "
         "records"},
        {"scene", "time_step", record, "number", "that of the file",
         "time between two samples of a text file of one column"},
        {"scene", "theory", always, "string", in_quotes(name_of(Scene().theory)),
         "equation of motion of the block", words(names_of<Theory>)},
        {"scene", "gravity", always, "number", number_text(Scene().gravity),
         "g, for blocks given in metres and records that are not in g"},
        {"scene", "motion_of", always, "string",
         "that of the record; " + in_quotes(name_of(Scene().motion_of)),
         "whose motion it is: pga is the peak acceleration of the ground, or of the floor",
         words(names_of<MotionOf>)},
        {"blocks", "table", always, "string", "",
         "path of a table of comma-separated values, whose columns are coordinates"},
        {"numerics", "method", always, "string",
         fmt::format("\"{}\"; under a record or a table \"{}\", the only choice",
                     name_of(numerics.method),
                     name_of(Method::taylor)),
         "Dormand-Prince 5(4), or Taylor series of order 14 (at a tolerance above 2e-7) or 20; "
         "under a record, of order 8", words(names_of<Method>)},
        {"numerics", "tolerance", always, "number",
         fmt::format("{:g}; {:g} with resolve", numerics.tolerance, tolerance_to_resolve_from),
         fmt::format("local error per step, relative to the size of the motion, or to alpha if "
                     "that is smaller; under a record, larger values have the effect of 1e-10; at "
                     "most {:g} for rk45 with resolve or the field error",
                     largest_rk45_tolerance_with_error)},
        {"numerics", "resolve", always, "boolean", fmt::to_string(numerics.resolve),
         "settle verdicts in doubt with more digits"},
        {"numerics", "fill", always, "boolean", "false",
         "integrate only the points near the boundaries of regions"},
        {"numerics", "audit", always, "number", number_text(FilledSpectrum().audit) + "; requires fill",
         "share of the filled points that are integrated as well"},
        {"output", "fields", always, "list",
         fmt::format("[{}]", words(mapped(default_fields, &Field::name))),
         "what is stored; other fields are not computed",
         words(mapped(spectrum_fields(), &Field::name))},
        {"output", "precision", always, "string", in_quotes(name_of(Precision::double_precision)),
         "of the fields that are floating-point numbers: 4 or 8 bytes per value; coordinates and "
         "flips are always double", words(names_of<Precision>)},
        {"boundary", "along", always, "string", "the strength",
         "the quantity along which overturn boundary searches for flips; other commands ignore it",
         words(scanned_quantities())}};
    // clang-format on
}

Key key_of(std::string_view table, const Quantity& quantity)
{
    const Quantity::Scope& scope = quantity.scope;
    std::string meaning(quantity.long_name);
    meaning += scope.same_as.empty() ? "" : fmt::format(", in place of {}", scope.same_as);
    meaning += scope.motion == pulse    ? "; under a pulse"
               : scope.motion == record ? "; under a record"
                                        : "";
    return {table,
            quantity.name,
            scope.motion,
            "number or axis",
            std::string(scope.standard),
            fmt::format("{}. {}", meaning, quantity.reason)};
}

} // namespace

std::string Key::dotted() const
{
    return table.empty() ? std::string(name) : fmt::format("{}.{}", table, name);
}

const std::vector<Key>& all_keys()
{
    static const std::vector<Key> keys = [] {
        std::vector<Key> all = keys_with_one_value();
        for (const std::string_view table : coordinate_tables) {
            for (const Quantity& quantity : all_quantities()) {
                if (quantity.is_coordinate() && quantity.role != Role::motion &&
                    (table == "plane" || quantity.role == Role::block)) {
                    all.push_back(key_of(table, quantity));
                }
            }
        }
        for (Key& key : all) {
            if (const Quantity* rule = find_quantity(key.name)) {
                key.allowed = rule->interval.text;
                key.units = rule->printed_units();
            }
        }
        return all;
    }();
    return keys;
}

std::vector<std::string_view> keys_of(std::string_view table, std::optional<Under> motion)
{
    std::vector<std::string_view> names;
    for (const Key& key : all_keys()) {
        if (key.table == table && (!motion || key.motion == *motion)) {
            names.push_back(key.name);
        }
    }
    return names;
}

std::vector<std::string_view> scanned_quantities()
{
    std::vector<std::string_view> names;
    for (const Quantity& quantity : all_quantities()) {
        if (quantity.role == Role::strength || quantity.role == Role::block ||
            quantity.role == Role::loss) {
            names.push_back(quantity.name);
        }
    }
    return names;
}

std::vector<std::string> override_keys()
{
    std::vector<std::string> all;
    for (const Key& key : all_keys()) {
        if (key.type == table_type) {
            continue;
        }
        all.push_back(key.dotted());
        if (is_one_of(key.table, coordinate_tables)) {
            for (const std::string_view part : axis_keys) {
                all.push_back(fmt::format("{}.{}", key.dotted(), part));
            }
            if (key.name == "restitution") {
                all.push_back(key.dotted() + ".of");
            }
        }
    }
    return all;
}

} // namespace overturn
