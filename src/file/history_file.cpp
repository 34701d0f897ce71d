#include "whole_file.hpp"

#include "overturn/problem/coordinates.hpp"

#include <string>
#include <string_view>

namespace overturn {

namespace {

using hdf5::write_attribute;
using namespace netcdf;

/// A quantity that is stored for each sample.
struct SampleQuantity {
    const char* name;
    const char* long_name;
    const char* units;
    double HistorySample::*value;
    const char* comment = "";
};

constexpr SampleQuantity time_of_sample{"time", "time p t", "1", &HistorySample::time,
                                        "from the beginning of the ground motion"};
constexpr SampleQuantity quantities[] = {
    {"angle", "angle theta", "rad", &HistorySample::angle},
    {"velocity", "d theta / d(p t)", "rad", &HistorySample::velocity},
    {"acceleration", "d^2 theta / d(p t)^2", "rad", &HistorySample::acceleration},
    {"q", "q", "rad2", &HistorySample::q,
     "4 sin^2((alpha - |theta|) / 2) - (d theta / d(p t))^2; linear theory: (alpha - |theta|)^2 - "
     "(d "
     "theta / d(p t))^2"},
    {"ground", "ground acceleration, over g", "1", &HistorySample::ground},
};

/// `when` is appended to the long name of the quantity.
void add_quantity(hid_t file, const char* dimension, const std::string& name,
                  const SampleQuantity& quantity, const std::vector<HistorySample>& samples,
                  const std::string& when = "")
{
    std::vector<double> values;
    for (const HistorySample& sample : samples) {
        values.push_back(sample.*quantity.value);
    }
    add_variable(file, {name,
                        {dimension},
                        {values.size()},
                        values,
                        quantity.long_name + when,
                        quantity.units,
                        quantity.comment});
}

void add_samples(hid_t file, const std::vector<HistorySample>& samples)
{
    add_quantity(file, "time", time_of_sample.name, time_of_sample, samples);
    for (const SampleQuantity& quantity : quantities) {
        add_quantity(file, "time", quantity.name, quantity, samples);
    }
}

void add_events(hid_t file, const std::vector<HistoryEvent>& events)
{
    std::vector<HistorySample> before;
    std::vector<HistorySample> after;
    std::vector<std::uint8_t> kinds;
    for (const HistoryEvent& event : events) {
        before.push_back(event.before);
        after.push_back(event.after);
        kinds.push_back(std::uint8_t(event.kind));
    }
    const char* const dimension = "events/event";
    add_group(file, "events"); // of a different length from the samples
    add_bare_dimension(file, dimension, std::int64_t(events.size()));
    add_quantity(file, dimension, "events/time", time_of_sample, after);
    add_codes(file, "events/kind", dimension, kinds, "kind of the event", event_names);
    for (const SampleQuantity& quantity : quantities) {
        const std::string name = std::string("events/") + quantity.name;
        add_quantity(file, dimension, name + "_before", quantity, before, ", before the event");
        add_quantity(file, dimension, name + "_after", quantity, after, ", after the event");
    }
}

/// The point and its outcome.
void add_outcome(hid_t file, const Job& job, const History& history)
{
    const Scene& scene = job.problem.scene;
    const Grid& grid = job.problem.grid;
    const Coordinates coordinates(scene, grid);
    const auto add = [&](std::string_view name) {
        write_attribute(file, std::string(name).c_str(), coordinates.of(name).first());
    };
    for (const Quantity& quantity : all_quantities()) {
        if (grid.find(quantity.name) != nullptr && quantity.role != Role::motion) {
            add(quantity.name);
        }
    }
    for (const std::string_view name : derived_coordinates) {
        if (grid.find(name) == nullptr && coordinates.has(name)) {
            add(name);
        }
    }
    write_attribute(file, "region", std::int64_t(history.region));
    write_attribute(file, "margin", history.margin);
    write_attribute(file, "margin_error", history.error);
    write_attribute(file, "end_of_pulse", history.end_of_pulse);
    write_attribute(file, "time_of_rest", history.time_of_rest);
    write_attribute(file, "time_of_fall", history.time_of_fall);
    write_attribute(file, "shortened", std::int64_t(history.shortened));
}

} // namespace

void write_history_file(const std::string& path, const Job& job, const History& history)
{
    write_whole_file(path, FileKind::history, job, [&](hid_t file) {
        add_outcome(file, job, history);
        add_samples(file, history.samples);
        add_events(file, history.events);
    });
}

} // namespace overturn
