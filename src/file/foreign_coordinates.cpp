#include "attributes.hpp"
#include "coordinates.hpp"
#include "own_dataset.hpp"
#include "stored_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;

/// `pga` was named peak_ground_acceleration in earlier files of format 2, and there was no group.
std::string stored_name_of(const std::string& coordinate, const StoredSpectrum& stored)
{
    if (stored.format < 3) {
        const bool has_old_name =
            coordinate == "pga" && check(H5Lexists(stored.file, "pga", H5P_DEFAULT)) == 0;
        return has_old_name ? "peak_ground_acceleration"
                            : coordinate.substr(coordinate.rfind('/') + 1);
    }
    return coordinate;
}

/// The table of a list, from the variables along its blocks.
Table read_stored_table(const StoredSpectrum& stored, const Job& job)
{
    Table table;
    const auto rows = hsize_t(job.plane.list->size);
    for (const std::string& name : job.blocks->columns) {
        const Handle dataset = open_own_dataset(stored.file, name);
        const std::vector<hsize_t> shape = shape_of(dataset);
        TableColumn column{name, {}, {}};
        if (has_type(dataset, H5T_IEEE_F64LE) && shape == std::vector{rows}) {
            column.numbers.resize(rows);
            check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                          column.numbers.data()));
        } else {
            demand(has_type(dataset, H5T_C_S1) && shape.size() == 2 && shape[0] == rows &&
                       shape[1] <= stored.bytes / rows,
                   "a column of the table is malformed");
            std::string letters(rows * shape[1], '\0');
            check(H5Dread(dataset, H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data()));
            for (hsize_t row = 0; row < rows; ++row) {
                column.texts.emplace_back(letters.substr(row * shape[1], shape[1]).c_str());
            }
        }
        table.columns.push_back(std::move(column));
    }
    return table;
}

/// Throws Hdf5Error, which foreign_coordinates() converts.
std::vector<std::string> find_foreign_coordinates(const StoredSpectrum& stored, Job job)
{
    const auto has_shape = [&](const std::string& name, const std::vector<hsize_t>& shape) {
        const Handle dataset = open_own_dataset(stored.file, name);
        return shape_of(dataset) == shape && has_type(dataset, H5T_IEEE_F64LE);
    };
    std::vector<std::string> foreign;
    // Sizes first: the job in a malicious file may have axes that do not fit into memory.
    for (const Dimension& dimension : dimensions_of(job)) {
        if (!has_shape(dimension.name, {hsize_t(dimension.axis.size())})) {
            foreign.emplace_back(dimension.name);
        }
    }
    const std::string scan = stored_name_of(name_of_scan(job), stored);
    if (job.product == Product::boundary && !has_shape(scan, {hsize_t(job.scan.size())})) {
        foreign.push_back(scan);
    }
    if (!foreign.empty()) {
        return foreign;
    }
    if (job.blocks && !job.blocks->table) {
        Table table = read_stored_table(stored, job);
        if (checksum_of(table) != job.blocks->checksum) {
            return {"the columns of the table"};
        }
        restore_blocks(job, std::move(table));
    }
    for (Coordinate coordinate : coordinates_of(job)) {
        coordinate.name = stored_name_of(coordinate.name, stored);
        if (!has_shape(coordinate.name, coordinate.shape)) {
            foreign.push_back(coordinate.name);
            continue;
        }
        std::vector<double> values(coordinate.values.size());
        const Handle dataset = open_own_dataset(stored.file, coordinate.name);
        check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
        const double tolerance = coordinate.roundings * std::numeric_limits<double>::epsilon();
        const auto is_as_good_as = [=](double value, double computed) {
            return std::islessequal(std::abs(value - computed), tolerance * std::abs(computed)) ||
                   (std::isnan(value) && std::isnan(computed));
        };
        if (!std::equal(values.begin(), values.end(), coordinate.values.begin(), is_as_good_as)) {
            foreign.push_back(coordinate.name);
        }
    }
    return foreign;
}

} // namespace

std::vector<std::string> foreign_coordinates(const StoredSpectrum& stored, const Job& job)
{
    return or_refused(stored.path, [&] { return find_foreign_coordinates(stored, job); });
}

} // namespace overturn
