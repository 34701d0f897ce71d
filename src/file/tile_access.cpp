#include "tile_access.hpp"

#include "layout.hpp"

#include <array>
#include <cassert>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;

/// Where a tile lies in a dataset of four dimensions.
Handle selection(hid_t dataset, const Tile& tile)
{
    const std::array<hsize_t, 4> begin{hsize_t(tile.slenderness), hsize_t(tile.restitution),
                                       hsize_t(tile.amplitude_begin),
                                       hsize_t(tile.frequency_begin)};
    const std::array<hsize_t, 4> count{1, 1, hsize_t(tile.amplitude_count),
                                       hsize_t(tile.frequency_count)};
    Handle space(H5Dget_space(dataset), H5Sclose);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr));
    return space;
}

Handle row_of(hsize_t length)
{
    return Handle(H5Screate_simple(1, &length, nullptr), H5Sclose);
}

} // namespace

void write_tile(hid_t dataset, const Tile& tile, Field field, const FieldValues& values)
{
    const Handle place = selection(dataset, tile);
    const Handle row = row_of(hsize_t(tile.points()));
    std::visit(
        [&](const auto& list) {
            assert(std::int64_t(list.size()) == tile.points());
            check(H5Dwrite(dataset, layout::stored_as(field).memory, row, place, H5P_DEFAULT,
                           list.data()));
        },
        values);
}

FieldValues read_tile(hid_t dataset, const Tile& tile, Field field)
{
    const Handle place = selection(dataset, tile);
    const Handle row = row_of(hsize_t(tile.points()));
    FieldValues values = make_field_values(field, std::size_t(tile.points()));
    std::visit(
        [&](auto& list) {
            check(H5Dread(dataset, layout::stored_as(field).memory, row, place, H5P_DEFAULT,
                          list.data()));
        },
        values);
    return values;
}

void write_checksum(hid_t dataset, std::int64_t tile, std::uint64_t checksum)
{
    const hsize_t position = hsize_t(tile);
    const Handle place(H5Dget_space(dataset), H5Sclose);
    check(H5Sselect_elements(place, H5S_SELECT_SET, 1, &position));
    check(H5Dwrite(dataset, H5T_NATIVE_UINT64, row_of(1), place, H5P_DEFAULT, &checksum));
}

std::vector<std::uint64_t> read_checksums(hid_t dataset)
{
    const Handle space(H5Dget_space(dataset), H5Sclose);
    std::vector<std::uint64_t> checksums(std::size_t(check(H5Sget_simple_extent_npoints(space))));
    check(H5Dread(dataset, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, checksums.data()));
    return checksums;
}

} // namespace overturn
