#include "whole_file.hpp"

#include <array>
#include <functional>
#include <numeric>

namespace overturn {

namespace {

using hdf5::write_attribute;
using namespace netcdf;

constexpr char setting[] = "setting";

/// A variable of numbers along one dimension.
template <class Values>
void add_list(hid_t file, const char* name, const char* dimension, const Values& values,
              const char* long_name)
{
    add_variable(file, {name,
                        {dimension},
                        {values.size()},
                        std::vector<double>(values.begin(), values.end()),
                        long_name,
                        "1"});
}

void add_coordinates(hid_t file, const std::vector<AccuracyRow>& rows)
{
    add_bare_dimension(file, setting, std::int64_t(rows.size()));
    add_list(file, "quantile", "quantile", error_quantiles, "share of points with smaller errors");
    std::vector<std::uint8_t> regions(region_names.size());
    std::iota(regions.begin(), regions.end(), std::uint8_t(0));
    add_codes(file, "region", "region", regions, "region at the end of the ground motion",
              region_names);
    add_list(file, "distance", "distance", distance_limits, "upper limit of |margin| in the class");
}

/// A table with one row per setting.
class Table {
public:
    Table(hid_t file, const std::vector<AccuracyRow>& rows) : file_(file), rows_(rows) {}

    /// A column: a member of each row, or the result of a function of it.
    template <class Value>
    void add(const char* name, const char* long_name, const char* units, const Value& value) const
    {
        std::vector<double> values;
        for (const AccuracyRow& row : rows_) {
            values.push_back(double(std::invoke(value, row)));
        }
        add_variable(file_, {name, {setting}, {rows_.size()}, values, long_name, units});
    }

    /// Columns along a further dimension.
    template <class Number, std::size_t columns>
    void add(const char* name, const char* dimension, const char* long_name, const char* units,
             std::array<Number, columns> AccuracyRow::*member) const
    {
        std::vector<double> values;
        for (const AccuracyRow& row : rows_) {
            values.insert(values.end(), (row.*member).begin(), (row.*member).end());
        }
        add_variable(
            file_, {name, {setting, dimension}, {rows_.size(), columns}, values, long_name, units});
    }

private:
    hid_t file_;
    const std::vector<AccuracyRow>& rows_;
};

/// The settings and the results of each.
void add_columns(const Table& table)
{
    using Row = AccuracyRow;
    table.add("method", "0 rk45, 1 taylor", "1",
              [](const Row& row) { return int(row.numerics.method); });
    table.add("tolerance", "tolerance of the local error", "1",
              [](const Row& row) { return row.numerics.tolerance; });
    table.add("resolve", "1 if verdicts were resolved", "1",
              [](const Row& row) { return row.numerics.resolve; });
    table.add("seconds_per_point", "time per point on one core", "s", &Row::seconds_per_point);
    table.add("steps", "steps tried per point", "1", &Row::steps);
    table.add("evaluations", "evaluations of the equation, per point", "1", &Row::evaluations);
    table.add("angle_error", "quantile", "error of the angle against 50 digits", "rad",
              &Row::angle);
    table.add("velocity_error", "quantile", "error of the velocity against 50 digits", "rad",
              &Row::velocity);
    table.add("margin_error", "quantile", "error of the margin against 50 digits", "1",
              &Row::margin);
    table.add("wrong_verdicts", "wrong verdicts", "1", &Row::wrong_verdicts);
    table.add("wrong_verdicts_by_region", "region", "wrong verdicts in the region", "1",
              &Row::wrong_verdicts_by_region);
    table.add("wrong_verdicts_by_distance", "distance", "wrong verdicts in the class", "1",
              &Row::wrong_verdicts_by_distance);
    table.add("undecided", "points without a verdict", "1", &Row::undecided);
    table.add("bound_exceeded", "share of errors above their bound", "1", &Row::bound_exceeded);
    table.add("bound_over_error", "median of bound over error", "1", &Row::bound_over_error);
}

void write(hid_t file, const AccuracySample& sample, const std::vector<AccuracyRow>& rows)
{
    write_attribute(file, "points", sample.grid.points());
    write_attribute(file, "points_settled", sample.settled);
    write_attribute(file, "points_in_50_digits", sample.in_digits);
    add_coordinates(file, rows);
    add_columns(Table(file, rows));
    add_list(file, "points_by_region", "region", sample.by_region,
             "number of points of the region");
    add_list(file, "points_by_distance", "distance", sample.by_distance,
             "number of points of the class");
}

} // namespace

void write_accuracy_file(const std::string& path, const Job& job, const AccuracySample& sample,
                         const std::vector<AccuracyRow>& rows)
{
    write_whole_file(path, FileKind::accuracy, job, [&](hid_t file) { write(file, sample, rows); });
}

} // namespace overturn
