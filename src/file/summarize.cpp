#include "layout.hpp"
#include "stored_spectrum.hpp"
#include "tile_access.hpp"

#include "overturn/file/spectrum_summary.hpp"
#include "overturn/mechanics/region.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace overturn {

namespace {

/// Calls `use` with every computed tile and its values of the given fields.
template <class Use>
void for_each_computed_tile(const StoredSpectrum& stored, const std::vector<Field>& fields,
                            const std::function<void()>& between_tiles, const Use& use)
{
    const Tiling tiling = stored.tiling();
    try {
        std::vector<hdf5::Handle> datasets;
        for (const Field field : fields) {
            datasets.push_back(hdf5::open_dataset(stored.file, name_of(field)));
        }
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            between_tiles();
            if (stored.checksums[std::size_t(number)] == not_computed_checksum) {
                continue;
            }
            const Tile tile = tiling[number];
            std::vector<FieldValues> values;
            for (std::size_t i = 0; i < fields.size(); ++i) {
                values.push_back(read_tile(datasets[i], tile, fields[i]));
            }
            use(tile, values);
        }
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(
            fmt::format("cannot read the values in \"{}\": {}.", stored.path, error.what()));
    }
}

} // namespace

SpectrumSummary summarize(const std::string& path)
{
    return open_stored_spectrum(path);
}

BoundaryLines count_lines(const std::string& path)
{
    const StoredSpectrum stored = open_stored_spectrum(path);
    BoundaryLines lines;
    lines.has_shares =
        std::any_of(stored.fields.begin(), stored.fields.end(),
                    [](const FieldSummary& field) { return field.field == Field::unsafe_share; });
    std::vector<Field> fields{Field::region_below, Field::region_above};
    if (lines.has_shares) {
        fields.insert(fields.end(), line_fields.begin(), line_fields.end());
    }
    const auto count = [&](const Tile& tile, const std::vector<FieldValues>& values) {
        const auto& below = std::get<std::vector<std::uint8_t>>(values[0]);
        const auto& above = std::get<std::vector<std::uint8_t>>(values[1]);
        const auto columns = std::size_t(tile.columns());
        lines.computed += tile.columns();
        for (std::size_t column = 0; column < columns; ++column) {
            bool undecided = false;
            for (std::size_t point = column; point < below.size(); point += columns) {
                undecided = undecided || Region(below[point]) == Region::undecided ||
                            Region(above[point]) == Region::undecided;
            }
            lines.undecided += undecided;
            lines.unsafe_at_first += is_unsafe(Region(below[column]));
            if (lines.has_shares) {
                lines.unsafe_share += std::get<std::vector<double>>(values[2])[column];
                lines.undecided_share += std::get<std::vector<double>>(values[3])[column];
            }
        }
    };
    for_each_computed_tile(
        stored, fields, [] {}, count);
    const auto computed = double(std::max<std::int64_t>(1, lines.computed));
    lines.unsafe_share /= computed;
    lines.undecided_share /= computed;
    return lines;
}

std::vector<std::string> damaged_coordinates(const std::string& path)
{
    const StoredSpectrum stored = open_stored_spectrum(path);
    try {
        Job job = read_resolved_job(stored.resolved_job, layout::job_resolved);
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
    std::vector<Field> fields;
    for (const FieldSummary& field : stored.fields) {
        fields.push_back(field.field);
    }
    std::vector<std::int64_t> damaged;
    for_each_computed_tile(stored, fields, between_tiles,
                           [&](const Tile& tile, const std::vector<FieldValues>& values) {
                               const auto number = std::size_t(tile.number);
                               const auto audit = stored.audit
                                                      ? std::optional(stored.audits[number])
                                                      : std::nullopt;
                               if (tile_checksum(values, audit) != stored.checksums[number]) {
                                   damaged.push_back(tile.number);
                               }
                           });
    return damaged;
}

} // namespace overturn
