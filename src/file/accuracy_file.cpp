#include "overturn/file/accuracy_file.hpp"

#include "layout.hpp"
#include "whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>

namespace overturn {

namespace {

using hdf5::Handle;
using hdf5::write_attribute;
using namespace netcdf;

constexpr const char* kind = layout::accuracy_kind;
constexpr char setting[] = "setting";

Handle open(hid_t file, const char* name)
{
    return Handle(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
}

/// A table with one row per setting.
class Table {
public:
    Table(hid_t file, const std::vector<AccuracyRow>& rows) : file_(file), rows_(rows) {}

    template <class Value>
    void add(const char* name, const char* long_name, const char* units, const Value& value) const
    {
        std::vector<double> values;
        for (const AccuracyRow& row : rows_) {
            values.push_back(double(value(row)));
        }
        add_numbers(file_, name, {rows_.size()}, values, long_name, units);
        attach_dimensions(file_, open(file_, name), std::array{setting});
    }

    template <class Values>
    void add(const char* name, const char* dimension, const char* long_name, const char* units,
             const Values& values_of) const
    {
        std::vector<double> values;
        std::size_t columns = 0;
        for (const AccuracyRow& row : rows_) {
            columns = values_of(row).size();
            values.insert(values.end(), values_of(row).begin(), values_of(row).end());
        }
        add_numbers(file_, name, {rows_.size(), columns}, values, long_name, units);
        attach_dimensions(file_, open(file_, name), std::array{setting, dimension});
    }

private:
    hid_t file_;
    const std::vector<AccuracyRow>& rows_;
};

template <class Values>
void add_coordinate(hid_t file, const char* name, const Values& values, const char* long_name)
{
    add_numbers(file, name, {values.size()}, std::vector<double>(values.begin(), values.end()),
                long_name, "1");
    make_dimension(file, name);
}

template <class Counts>
void add_counts(hid_t file, const char* name, const char* dimension, const Counts& counts,
                const char* long_name)
{
    add_numbers(file, name, {counts.size()}, std::vector<double>(counts.begin(), counts.end()),
                long_name, "1");
    attach_dimensions(file, open(file, name), std::array{dimension});
}

void add_regions(hid_t file)
{
    std::vector<std::uint8_t> codes(decided_regions);
    std::iota(codes.begin(), codes.end(), std::uint8_t(0));
    const Handle regions =
        create_dataset(file, "region", H5T_STD_U8LE, {codes.size()}, dataset_creation());
    hdf5::check(H5Dwrite(regions, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, codes.data()));
    write_attribute(regions, "long_name", "region of the block's state at the end of the pulse");
    write_attribute(regions, "flag_values", codes);
    write_attribute(regions, "flag_meanings", fmt::format("{}", fmt::join(region_names, " ")));
    make_dimension(file, "region");
}

void add_coordinates(hid_t file, const std::vector<AccuracyRow>& rows)
{
    add_bare_dimension(file, setting, std::int64_t(rows.size()));
    add_coordinate(file, "quantile", error_quantiles,
                   "share of the points with at most this error");
    add_regions(file);
    add_coordinate(file, "distance", distance_limits, "class of |margin|: below this");
}

void add_settings(const Table& table)
{
    table.add("method", "0 rk45, 1 taylor", "1",
              [](const AccuracyRow& row) { return int(row.numerics.method); });
    table.add("tolerance", "local error per step over the size of the motion", "1",
              [](const AccuracyRow& row) { return row.numerics.tolerance; });
    table.add("resolve", "1 where verdicts in doubt were settled with more digits", "1",
              [](const AccuracyRow& row) { return row.numerics.resolve; });
}

void add_results(const Table& table)
{
    table.add("seconds_per_point", "time per point on one core, of regions alone", "s",
              [](const AccuracyRow& row) { return row.seconds_per_point; });
    table.add("steps", "steps tried per point", "1",
              [](const AccuracyRow& row) { return row.steps; });
    table.add("evaluations", "evaluations per point, of the acceleration or of its series", "1",
              [](const AccuracyRow& row) { return row.evaluations; });
    table.add("angle_error", "quantile", "error of the angle against 50 digits", "rad",
              [](const AccuracyRow& row) -> auto& { return row.angle; });
    table.add("velocity_error", "quantile", "error of the velocity against 50 digits", "rad",
              [](const AccuracyRow& row) -> auto& { return row.velocity; });
    table.add("margin_error", "quantile", "error of the margin against 50 digits", "1",
              [](const AccuracyRow& row) -> auto& { return row.margin; });
    table.add("flips", "points whose verdict is wrong", "1",
              [](const AccuracyRow& row) { return row.flips; });
    table.add("flips_by_region", "region", "points of the region whose verdict is wrong", "1",
              [](const AccuracyRow& row) -> auto& { return row.flips_by_region; });
    table.add("flips_by_distance", "distance", "points of the class whose verdict is wrong", "1",
              [](const AccuracyRow& row) -> auto& { return row.flips_by_distance; });
    table.add("undecided", "points without a verdict", "1",
              [](const AccuracyRow& row) { return row.undecided; });
    table.add("bound_exceeded", "share of the points whose error of the margin exceeds its bound",
              "1", [](const AccuracyRow& row) { return row.bound_exceeded; });
    table.add("bound_over_error", "median of the bound over the error of the margin", "1",
              [](const AccuracyRow& row) { return row.bound_over_error; });
}

void write(hid_t file, const AccuracySample& sample, const std::vector<AccuracyRow>& rows)
{
    write_attribute(file, "points", sample.plane.points());
    write_attribute(file, "points_settled", sample.settled);
    write_attribute(file, "points_in_50_digits", sample.in_digits);
    add_coordinates(file, rows);
    const Table table(file, rows);
    add_settings(table);
    add_results(table);
    add_counts(file, "points_by_region", "region", sample.by_region, "points of the region");
    add_counts(file, "points_by_distance", "distance", sample.by_distance, "points of the class");
}

} // namespace

void expect_room_for_accuracy_file(const std::string& path)
{
    expect_room_for(path, kind);
}

void write_accuracy_file(const std::string& path, const Job& job, const AccuracySample& sample,
                         const std::vector<AccuracyRow>& rows)
{
    write_whole_file(path, kind, job, [&](hid_t file) { write(file, sample, rows); });
}

} // namespace overturn
