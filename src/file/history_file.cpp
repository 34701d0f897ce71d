#include "overturn/file/history_file.hpp"

#include "layout.hpp"
#include "whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

namespace overturn {

namespace {

using hdf5::Handle;
using hdf5::write_attribute;
using namespace netcdf;

constexpr const char* kind = layout::history_kind;

/// What is told of a sample.
struct Quantity {
    const char* name;
    const char* long_name;
    const char* units;
    double HistorySample::*value;
};

constexpr Quantity quantities[] = {
    {"angle", "theta", "rad", &HistorySample::angle},
    {"velocity", "theta' = d theta / d tau, tau = p t", "rad", &HistorySample::velocity},
    {"acceleration", "theta'' = d^2 theta / d tau^2", "rad", &HistorySample::acceleration},
    {"q",
     "4 sin^2((alpha - |theta|) / 2) - theta'^2; linear theory: (alpha - |theta|)^2 - theta'^2",
     "rad2", &HistorySample::q},
    {"ground", "acceleration of the ground over g", "1", &HistorySample::ground},
};

/// Variables along one dimension.
class Along {
public:
    Along(hid_t file, const char* dimension, std::size_t length)
        : file_(file), dimension_(dimension)
    {
        add_bare_dimension(file, dimension, std::int64_t(length));
    }

    void add(const std::string& name, const std::vector<double>& values, const char* long_name,
             const char* units) const
    {
        add_numbers(file_, name.c_str(), {values.size()}, values, long_name, units);
        attach(name);
    }

    void attach(const std::string& name) const
    {
        const Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
        attach_dimensions(file_, dataset, std::array{dimension_});
    }

private:
    hid_t file_;
    const char* dimension_;
};

template <class Rows, class Value>
std::vector<double> column(const Rows& rows, const Value& value)
{
    std::vector<double> values;
    for (const auto& row : rows) {
        values.push_back(value(row));
    }
    return values;
}

void add_samples(hid_t file, const std::vector<HistorySample>& samples)
{
    const Along along(file, "sample", samples.size());
    along.add("time", column(samples, [](const auto& sample) { return sample.time; }),
              "tau = p t since the beginning of the pulse", "1");
    for (const Quantity& quantity : quantities) {
        along.add(quantity.name,
                  column(samples, [&](const auto& sample) { return sample.*quantity.value; }),
                  quantity.long_name, quantity.units);
    }
}

void add_event_kinds(hid_t file, const std::vector<HistoryEvent>& events)
{
    std::vector<std::uint8_t> codes;
    for (const HistoryEvent& event : events) {
        codes.push_back(std::uint8_t(event.kind));
    }
    const Handle kinds =
        create_dataset(file, "event_kind", H5T_STD_U8LE, {codes.size()}, dataset_creation());
    hdf5::check(H5Dwrite(kinds, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, codes.data()));
    std::vector<std::uint8_t> all;
    for (std::size_t i = 0; i < event_names.size(); ++i) {
        all.push_back(std::uint8_t(i));
    }
    write_attribute(kinds, "long_name", "what happens");
    write_attribute(kinds, "flag_values", all);
    write_attribute(kinds, "flag_meanings", fmt::format("{}", fmt::join(event_names, " ")));
}

void add_events(hid_t file, const std::vector<HistoryEvent>& events)
{
    const Along along(file, "event", events.size());
    along.add("event_time", column(events, [](const auto& event) { return event.after.time; }),
              "tau = p t since the beginning of the pulse", "1");
    add_event_kinds(file, events);
    along.attach("event_kind");
    for (const Quantity& quantity : quantities) {
        const std::string name = quantity.name;
        along.add("event_" + name + "_before",
                  column(events, [&](const auto& event) { return event.before.*quantity.value; }),
                  (std::string(quantity.long_name) + ", just before the event").c_str(),
                  quantity.units);
        along.add("event_" + name + "_after",
                  column(events, [&](const auto& event) { return event.after.*quantity.value; }),
                  (std::string(quantity.long_name) + ", just after the event").c_str(),
                  quantity.units);
    }
}

/// The point, and what became of it.
void add_outcome(hid_t file, const Job& job, const History& history)
{
    write_attribute(file, "slenderness", job.plane.slenderness.first());
    write_attribute(file, "restitution", job.plane.restitution_ratio(0, 0));
    write_attribute(file, "amplitude", job.plane.amplitude.first());
    write_attribute(file, "frequency", job.plane.frequency.first());
    write_attribute(file, "region", std::int64_t(history.region));
    write_attribute(file, "margin", history.margin);
    write_attribute(file, "margin_error", history.error);
    write_attribute(file, "end_of_pulse", history.end_of_pulse);
    write_attribute(file, "time_of_rest", history.time_of_rest);
    write_attribute(file, "time_of_fall", history.time_of_fall);
    write_attribute(file, "shortened", std::int64_t(history.shortened));
}

} // namespace

void expect_room_for_history_file(const std::string& path)
{
    expect_room_for(path, kind);
}

void write_history_file(const std::string& path, const Job& job, const History& history)
{
    write_whole_file(path, kind, job, [&](hid_t file) {
        add_outcome(file, job, history);
        add_samples(file, history.samples);
        add_events(file, history.events);
    });
}

} // namespace overturn
