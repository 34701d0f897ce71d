#include "overturn/file/history_and_accuracy_files.hpp"

#include "layout.hpp"
#include "netcdf.hpp"
#include "working_file.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <filesystem>
#include <functional>
#include <numeric>

namespace overturn {

namespace {

using hdf5::write_attribute;
using namespace netcdf;

using SampleQuantity = MemberVariable<HistorySample>;

constexpr SampleQuantity time_of_sample{"time", "time p t", "1", &HistorySample::time,
                                        "from the beginning of the ground motion"};
constexpr SampleQuantity quantities[] = {
    {"angle", "angle theta", "rad", &HistorySample::angle},
    {"velocity", "d theta / d(p t)", "rad", &HistorySample::velocity},
    {"acceleration", "d^2 theta / d(p t)^2", "rad", &HistorySample::acceleration},
    {"q", "q", "rad2", &HistorySample::q,
     "4 sin^2((alpha - |theta|) / 2) - (d theta / d(p t))^2; linear theory: (alpha - |theta|)^2 - "
     "(d theta / d(p t))^2"},
    {"ground", "ground acceleration, over g", "1", &HistorySample::ground},
    {"friction_demand", "friction coefficient needed", "1", &HistorySample::friction_demand,
     "|along| / normal force of the base on the block; infinite where the block would leave the "
     "base"},
};

// Of a block with a friction coefficient.
constexpr SampleQuantity quantities_of_slip[] = {
    {"slide", "position of the base over R", "1", &HistorySample::slide,
     "positive towards the side plus"},
    {"slide_velocity", "d slide / d(p t)", "1", &HistorySample::slide_velocity},
    {"force_along", "force of the base along it, over the weight", "1", &HistorySample::force_along,
     "positive towards the side plus"},
    {"force_normal", "force of the base normal to it, over the weight", "1",
     &HistorySample::force_normal},
};

/// Those of a job.
std::vector<SampleQuantity> quantities_of(const Job& job)
{
    std::vector<SampleQuantity> all(std::begin(quantities), std::end(quantities));
    if (job.problem.grid.may_slip()) {
        all.insert(all.end(), std::begin(quantities_of_slip), std::end(quantities_of_slip));
    }
    return all;
}

/// `when` is appended to the long name of the quantity.
void add_quantity(hid_t file, const Scene& scene, const std::string& name,
                  const SampleQuantity& quantity, const std::vector<HistorySample>& samples,
                  const std::string& when = "")
{
    const bool is_of_events = name.starts_with("events/");
    add_variable(file, {name,
                        {{is_of_events ? "events/event" : "time", std::int64_t(samples.size())}},
                        mapped(samples, quantity.value),
                        scene.worded(quantity.long_name) + when,
                        quantity.units,
                        scene.worded(quantity.comment)});
}

void add_events(hid_t file, const Job& job, const std::vector<HistoryEvent>& events)
{
    const Scene& scene = job.problem.scene;
    const std::vector<HistorySample> before = mapped(events, &HistoryEvent::before);
    const std::vector<HistorySample> after = mapped(events, &HistoryEvent::after);
    const auto code_of = [](const HistoryEvent& event) { return std::uint8_t(event.kind); };
    const StoredDimension dimension{"events/event", std::int64_t(events.size())};
    add_group(file, "events"); // of a different length from the samples
    add_bare_dimension(file, dimension);
    add_quantity(file, scene, "events/time", time_of_sample, after);
    add_variable(file, {.name = "events/kind",
                        .dimensions = {dimension},
                        .values = mapped(events, code_of),
                        .long_name = "kind of the event",
                        .code_names = event_names});
    for (const SampleQuantity& quantity : quantities_of(job)) {
        const std::string name = std::string("events/") + quantity.name;
        add_quantity(file, scene, name + "_before", quantity, before, ", before the event");
        add_quantity(file, scene, name + "_after", quantity, after, ", after the event");
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
    for (const bool is_given : {true, false}) {
        for (const Quantity& quantity : all_quantities()) {
            if ((grid.find(quantity.name) != nullptr) == is_given &&
                quantity.role != Role::motion &&
                (is_given || (quantity.scope.is_stored && coordinates.has(quantity.name)))) {
                add(quantity.name);
            }
        }
    }
    write_attribute(file, "region", std::int64_t(history.region));
    write_attribute(file, "margin", history.margin);
    write_attribute(file, "margin_error", history.error);
    write_attribute(file, "curve_is_certain", std::int64_t(history.is_curve_certain));
    write_attribute(file, "end_of_pulse", history.end_of_pulse);
    write_attribute(file, "time_of_rest", history.time_of_rest);
    write_attribute(file, "time_of_fall", history.time_of_fall);
    write_attribute(file, "shortened", std::int64_t(history.shortened));
}

/// Numbers along a dimension of an accuracy study.
template <class List>
void add_list(hid_t file, const char* name, const char* dimension, const List& list,
              const char* long_name)
{
    add_variable(file, {name,
                        {{dimension, std::int64_t(list.size())}},
                        std::vector<double>(list.begin(), list.end()),
                        long_name,
                        "1"});
}

/// The table with one row per setting.
void add_rows(hid_t file, const std::vector<AccuracyRow>& rows, bool may_slip)
{
    using Row = AccuracyRow;
    const StoredDimension settings{"setting", std::int64_t(rows.size())};
    // A column: a member of each row, or the result of a function of it.
    const auto add = [&](const char* name, const char* long_name, const char* units,
                         const auto& value) {
        const auto number_of = [&](const Row& row) { return double(std::invoke(value, row)); };
        add_variable(file, {name, {settings}, mapped(rows, number_of), long_name, units});
    };
    // Columns along a further dimension.
    const auto add_along = [&](const StoredDimension& dimension, const char* name,
                               const char* long_name, const char* units, auto member) {
        std::vector<double> values;
        for (const Row& row : rows) {
            values.insert(values.end(), (row.*member).begin(), (row.*member).end());
        }
        add_variable(file, {name, {settings, dimension}, values, long_name, units});
    };
    const StoredDimension quantile{"quantile", error_quantiles.size()};
    const StoredDimension region{"region", region_names.size()};
    const StoredDimension distance{"distance", distance_limits.size()};
    add("method", "0 rk45, 1 taylor", "1", [](const Row& row) { return int(row.numerics.method); });
    add("tolerance", "tolerance of the local error", "1",
        [](const Row& row) { return row.numerics.tolerance; });
    add("resolve", "1 if verdicts were resolved", "1",
        [](const Row& row) { return row.numerics.resolve; });
    add("seconds_per_point", "time per point on one core", "s", &Row::seconds_per_point);
    add("steps", "steps tried per point", "1", &Row::steps);
    add("evaluations", "evaluations of the equation, per point", "1", &Row::evaluations);
    add_along(quantile, "angle_error", "error of the angle against 50 digits", "rad", &Row::angle);
    add_along(quantile, "velocity_error", "error of the velocity against 50 digits", "rad",
              &Row::velocity);
    add_along(quantile, "margin_error", "error of the margin against 50 digits", "1", &Row::margin);
    if (may_slip) {
        add_along(quantile, "slide_error", "error of the slide over R against 50 digits", "1",
                  &Row::slide);
    }
    add("wrong_verdicts", "wrong verdicts", "1", &Row::wrong_verdicts);
    add_along(region, "wrong_verdicts_by_region", "wrong verdicts in the region", "1",
              &Row::wrong_verdicts_by_region);
    add_along(distance, "wrong_verdicts_by_distance", "wrong verdicts in the class", "1",
              &Row::wrong_verdicts_by_distance);
    add("undecided", "points without a verdict", "1", &Row::undecided);
    add("bound_exceeded", "share of errors above their bound", "1", &Row::bound_exceeded);
    add("bound_over_error", "median of bound over error", "1", &Row::bound_over_error);
}

void add_study(hid_t file, const Scene& scene, const AccuracySample& sample,
               const std::vector<AccuracyRow>& rows)
{
    write_attribute(file, "points", sample.grid.points());
    write_attribute(file, "points_settled", sample.settled);
    write_attribute(file, "points_in_50_digits", sample.in_digits);
    add_bare_dimension(file, {"setting", std::int64_t(rows.size())});
    add_list(file, "quantile", "quantile", error_quantiles, "share of points with smaller errors");
    std::vector<std::uint8_t> regions(region_names.size());
    std::iota(regions.begin(), regions.end(), std::uint8_t(0));
    add_variable(file, {.name = "region",
                        .dimensions = {{"region", std::int64_t(regions.size())}},
                        .values = regions,
                        .long_name = scene.worded("region at the end of the ground motion"),
                        .code_names = region_names});
    add_list(file, "distance", "distance", distance_limits, "upper limit of |margin| in the class");
    add_rows(file, rows, sample.grid.may_slip());
    add_list(file, "points_by_region", "region", sample.by_region,
             "number of points of the region");
    add_list(file, "points_by_distance", "distance", sample.by_distance,
             "number of points of the class");
}

/// Whether a file of a kind has all groups that overturn writes, and a history no further
/// variables: a data set that was derived from one has its attributes, too.
bool is_as_written(hid_t file, FileKind kind)
{
    const auto has = [&](const char* name) {
        return hdf5::check(H5Lexists(file, name, H5P_DEFAULT)) > 0;
    };
    H5G_info_t root = {};
    hdf5::check(H5Gget_info(file, &root));
    constexpr std::size_t others = 3; // time, events, run
    const std::size_t of_slip = has("mode") ? std::size(quantities_of_slip) + 1 : 0;
    const std::size_t most = std::size(quantities) + of_slip + others;
    return has("run") && (kind != FileKind::history || (has("events") && root.nlinks <= most));
}

} // namespace

void expect_room_for(const std::string& path, FileKind kind)
{
    static_cast<void>(PartFile(path)); // throws if the folder is missing or not writable
    if (!std::filesystem::exists(path)) {
        return;
    }
    if (!std::filesystem::is_regular_file(path)) {
        throw Error(exit_code::output,
                    "cannot write \"{}\": it is not a regular file. Choose another name with -o.",
                    path);
    }
    start_hdf5();
    std::string found;
    bool is_own = false;
    try {
        const hdf5::Handle file = hdf5::open_to_read(path);
        found = hdf5::read_text_attribute(file, "kind");
        is_own = is_as_written(file, kind);
    } catch (const hdf5::Hdf5Error&) {
        is_own = false; // it has no such attribute, or is damaged
    }
    if (found != name_of(kind)) {
        throw Error(exit_code::output,
                    "\"{}\" exists but its kind is not \"{}\". Remove it, or "
                    "choose another name with -o.",
                    path, name_of(kind));
    }
    if (!is_own) {
        throw Error(
            exit_code::output,
            "\"{}\" exists and is not as overturn wrote it. Move it away, or choose another "
            "name with -o.",
            path);
    }
}

void write_history_file(const std::string& path, const Job& job, const History& history)
{
    expect_room_for(path, FileKind::history);
    make_file(path, job, FileKind::history, [&](hid_t file) {
        add_outcome(file, job, history);
        const Scene& scene = job.problem.scene;
        add_quantity(file, scene, time_of_sample.name, time_of_sample, history.samples);
        for (const SampleQuantity& quantity : quantities_of(job)) {
            add_quantity(file, scene, quantity.name, quantity, history.samples);
        }
        if (job.problem.grid.may_slip()) {
            const auto code_of = [](const HistorySample& at) { return std::uint8_t(at.mode); };
            add_variable(file, {.name = "mode",
                                .dimensions = {{"time", std::int64_t(history.samples.size())}},
                                .values = mapped(history.samples, code_of),
                                .long_name = "mode of the motion",
                                .code_names = sliding_mode_names});
        }
        add_events(file, job, history.events);
    });
}

void write_accuracy_file(const std::string& path, const Job& job, const AccuracySample& sample,
                         const std::vector<AccuracyRow>& rows)
{
    expect_room_for(path, FileKind::accuracy);
    make_file(path, job, FileKind::accuracy,
              [&](hid_t file) { add_study(file, job.problem.scene, sample, rows); });
}

} // namespace overturn
