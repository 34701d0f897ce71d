#include "tile_access.hpp"

#include "layout.hpp"

#include <xxhash.h>

#include <bit>
#include <cassert>
#include <memory>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;

using Extents = std::vector<hsize_t>;

Extents extents(const Shape& shape)
{
    return {shape.begin(), shape.end()};
}

/// The part of a dataset that a tile occupies.
Handle selection(hid_t dataset, const Tile& tile)
{
    Handle space(H5Dget_space(dataset), H5Sclose);
    if (!tile.count.empty()) { // a single value is the whole dataset
        check(H5Sselect_hyperslab(space, H5S_SELECT_SET, extents(tile.begin).data(), nullptr,
                                  extents(tile.count).data(), nullptr));
    }
    return space;
}

/// The tile's values in memory, in the shape of the selection: if the shapes differ, HDF5 copies
/// point by point, which took half as long as computing the points.
Handle in_memory(const Tile& tile)
{
    return Handle(H5Screate_simple(int(tile.count.size()), extents(tile.count).data(), nullptr),
                  H5Sclose);
}

} // namespace

FieldValues not_computed(Field field, std::int64_t count)
{
    const auto stored = layout::stored_as(field);
    return std::visit(
        [&](auto value) { return FieldValues(std::vector(std::size_t(count), value)); },
        stored.fill);
}

void write_chunk(hid_t dataset, const Tile& tile, Field field, const FieldValues& values)
{
    if (tile.count.empty()) {
        write_tile(dataset, tile, field, values);
        return;
    }
    constexpr std::uint32_t no_filter_skipped = 0;
    const Extents begin = extents(tile.begin);
    std::visit(
        [&](const auto& list) {
            check(H5Dwrite_chunk(dataset, H5P_DEFAULT, no_filter_skipped, begin.data(),
                                 list.size() * sizeof(list[0]), list.data()));
        },
        values);
}

void write_tile(hid_t dataset, const Tile& tile, Field field, const FieldValues& values)
{
    const Handle place = selection(dataset, tile);
    const Handle memory = in_memory(tile);
    std::visit(
        [&](const auto& list) {
            assert(std::int64_t(list.size()) == tile.points());
            check(H5Dwrite(dataset, layout::stored_as(field).memory, memory, place, H5P_DEFAULT,
                           list.data()));
        },
        values);
}

FieldValues read_tile(hid_t dataset, const Tile& tile, Field field)
{
    const Handle place = selection(dataset, tile);
    const Handle memory = in_memory(tile);
    FieldValues values = make_field_values(field, std::size_t(tile.points()));
    std::visit(
        [&](auto& list) {
            check(H5Dread(dataset, layout::stored_as(field).memory, memory, place, H5P_DEFAULT,
                          list.data()));
        },
        values);
    return values;
}

static_assert(std::endian::native == std::endian::little, "values are hashed as they are stored");

std::uint64_t tile_checksum(const std::vector<FieldValues>& fields,
                            const std::optional<AuditCount>& audit)
{
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(),
                                                                           XXH64_freeState);
    XXH64_reset(state.get(), 0);
    for (const FieldValues& field : fields) {
        std::visit(
            [&](const auto& values) {
                XXH64_update(state.get(), values.data(), values.size() * sizeof(values[0]));
            },
            field);
    }
    if (audit) {
        const std::int64_t counts[] = {audit->checked, audit->wrong};
        XXH64_update(state.get(), counts, sizeof counts);
    }
    const std::uint64_t hash = XXH64_digest(state.get());
    return hash == not_computed_checksum ? 1 : hash;
}

void write_number(hid_t dataset, std::int64_t tile, std::uint64_t number)
{
    const hsize_t position = hsize_t(tile);
    const Handle place(H5Dget_space(dataset), H5Sclose);
    check(H5Sselect_elements(place, H5S_SELECT_SET, 1, &position));
    const hsize_t one = 1;
    const Handle memory(H5Screate_simple(1, &one, nullptr), H5Sclose);
    check(H5Dwrite(dataset, H5T_NATIVE_UINT64, memory, place, H5P_DEFAULT, &number));
}

std::vector<std::uint64_t> read_numbers(hid_t dataset)
{
    const Handle space(H5Dget_space(dataset), H5Sclose);
    std::vector<std::uint64_t> numbers(std::size_t(check(H5Sget_simple_extent_npoints(space))));
    check(H5Dread(dataset, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()));
    return numbers;
}

} // namespace overturn
