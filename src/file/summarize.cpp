#include "layout.hpp"
#include "stored_spectrum.hpp"
#include "tile_access.hpp"

#include "overturn/file/spectrum_summary.hpp"
#include "overturn/mechanics/region.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace overturn {

SpectrumSummary summarize(const std::string& path)
{
    const StoredSpectrum stored = open_stored_spectrum(path);
    SpectrumSummary summary;
    static_cast<FileOrigin&>(summary) = stored;
    summary.product = stored.product;
    for (const StoredAxis& axis : stored.axes) {
        summary.axes.push_back({axis.name, std::int64_t(axis.values.size()), axis.values.front(),
                                axis.values.back(), axis.units});
    }
    for (const Field field : stored.fields) {
        summary.fields.push_back({std::string(name_of(field)), layout::stored_as(field).name});
    }
    summary.tile_shape = stored.tile_shape;
    summary.tiles = std::int64_t(stored.checksums.size());
    summary.tiles_done = summary.tiles - std::count(stored.checksums.begin(),
                                                    stored.checksums.end(), not_computed_checksum);
    return summary;
}

BoundaryLines count_lines(const std::string& path)
{
    const StoredSpectrum stored = open_stored_spectrum(path);
    const Tiling tiling = stored.tiling();
    BoundaryLines lines;
    try {
        const auto regions = [&](const Tile& tile, Field field) {
            const hdf5::Handle dataset = hdf5::open_dataset(stored.file, name_of(field));
            return std::get<std::vector<std::uint8_t>>(read_tile(dataset, tile, field));
        };
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            if (stored.checksums[std::size_t(number)] == not_computed_checksum) {
                continue;
            }
            const Tile tile = tiling[number];
            const auto below = regions(tile, Field::region_below);
            const auto above = regions(tile, Field::region_above);
            const auto columns = std::size_t(tile.column_count);
            lines.computed += tile.column_count;
            for (std::size_t column = 0; column < columns; ++column) {
                bool undecided = false;
                for (std::size_t point = column; point < below.size(); point += columns) {
                    undecided = undecided || Region(below[point]) == Region::undecided ||
                                Region(above[point]) == Region::undecided;
                }
                lines.undecided += undecided;
                lines.unsafe_at_first += is_unsafe(Region(below[column]));
            }
        }
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(fmt::format("cannot read the values in \"{}\": {}.", path, error.what()));
    }
    return lines;
}

std::vector<std::string> damaged_coordinates(const std::string& path)
{
    const StoredSpectrum stored = open_stored_spectrum(path);
    try {
        Job job = read_job_text(stored.resolved_job, layout::job_resolved);
        return foreign_coordinates(stored, stored.product == Product::boundary
                                               ? boundary_of(std::move(job))
                                               : std::move(job));
    } catch (const JobError& error) {
        throw FileError(
            fmt::format("\"{}\" is damaged: the job in it cannot be read: {}", path, error.what()));
    }
}

std::vector<std::int64_t> damaged_tiles(const std::string& path,
                                        const std::function<void()>& between_tiles)
{
    const StoredSpectrum stored = open_stored_spectrum(path);
    const Tiling tiling = stored.tiling();
    try {
        std::vector<hdf5::Handle> datasets;
        for (const Field field : stored.fields) {
            datasets.push_back(hdf5::open_dataset(stored.file, name_of(field)));
        }
        std::vector<std::int64_t> damaged;
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            between_tiles();
            const std::uint64_t expected = stored.checksums[std::size_t(number)];
            if (expected == not_computed_checksum) {
                continue;
            }
            std::vector<FieldValues> values;
            for (std::size_t i = 0; i < datasets.size(); ++i) {
                values.push_back(read_tile(datasets[i], tiling[number], stored.fields[i]));
            }
            if (tile_checksum(values) != expected) {
                damaged.push_back(number);
            }
        }
        return damaged;
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(fmt::format("cannot read the values in \"{}\": {}.", path, error.what()));
    }
}

} // namespace overturn
