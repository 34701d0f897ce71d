#include "tile_access.hpp"

#include <xxhash.h>

#include <bit>
#include <cassert>
#include <memory>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;

hdf5::Extents extents(const Shape& shape)
{
    return {shape.begin(), shape.end()};
}

/// Selects the box in a space; a single value is the whole space.
Handle selected(Handle space, const Shape& begin, const Shape& count)
{
    if (!count.empty()) {
        check(H5Sselect_hyperslab(space, H5S_SELECT_SET, extents(begin).data(), nullptr,
                                  extents(count).data(), nullptr));
    }
    return space;
}

/// The part of a dataset that a tile occupies.
Handle selection(hid_t dataset, const Tile& tile)
{
    return selected(Handle(H5Dget_space(dataset), H5Sclose), tile.begin, tile.count);
}

/// The tile's values in memory, in the shape of the selection: if the shapes differ, HDF5 copies
/// point by point, which took half as long as computing the points.
Handle in_memory(const Tile& tile)
{
    return hdf5::space_of(extents(tile.count));
}

/// Reads the values of a tile into the first corner of a box of this shape.
FieldValues read_box(const StoredField& stored, const Tile& part, const Shape& box)
{
    FieldValues values = not_computed(stored.field, count_points(box));
    const Handle memory = selected(hdf5::space_of(extents(box)), Shape(box.size(), 0), part.count);
    std::visit(
        [&](auto& list) {
            check(H5Dread(stored.dataset, hdf5::Type::of(list[0]).memory, memory,
                          selection(stored.dataset, part), H5P_DEFAULT, list.data()));
        },
        values);
    return values;
}

} // namespace

void write_chunk(const StoredField& stored, const Tile& tile, const FieldValues& values)
{
    const Tile part = stored.part_of(tile);
    if (part.count.empty()) {
        write_tile(stored, tile, values);
        return;
    }
    constexpr std::uint32_t no_filter_skipped = 0;
    std::visit(
        [&](const auto& list) {
            check(H5Dwrite_chunk(stored.dataset, H5P_DEFAULT, no_filter_skipped,
                                 extents(part.begin).data(), list.size() * sizeof(list[0]),
                                 list.data()));
        },
        values);
}

void write_tile(const StoredField& stored, const Tile& tile, const FieldValues& values)
{
    const Tile part = stored.part_of(tile);
    std::visit(
        [&](const auto& list) {
            assert(std::int64_t(list.size()) == part.points());
            check(H5Dwrite(stored.dataset, hdf5::Type::of(list[0]).memory, in_memory(part),
                           selection(stored.dataset, part), H5P_DEFAULT, list.data()));
        },
        values);
}

FieldValues read_tile(const StoredField& stored, const Tile& tile)
{
    const Tile part = stored.part_of(tile);
    return read_box(stored, part, part.count);
}

FieldValues read_chunk(const StoredField& stored, const Tile& tile, const Shape& tile_shape)
{
    return read_box(stored, stored.part_of(tile),
                    stored_dimensions_of(stored.field, tile_shape, stored.crossing));
}

static_assert(std::endian::native == std::endian::little, "values are hashed as they are stored");

TileChecksums::TileChecksums(std::string_view resolved_job)
    : seed_of_first_(XXH64(resolved_job.data(), resolved_job.size(), 0))
{}

std::uint64_t TileChecksums::of(std::int64_t tile, const std::vector<FieldValues>& fields,
                                const std::optional<AuditCount>& audit) const
{
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(),
                                                                           XXH64_freeState);
    XXH64_reset(state.get(), seed_of_first_ ? *seed_of_first_ + std::uint64_t(tile) : 0);
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
    const auto position = hsize_t(tile);
    const Handle place(H5Dget_space(dataset), H5Sclose);
    check(H5Sselect_elements(place, H5S_SELECT_SET, 1, &position));
    check(H5Dwrite(dataset, H5T_NATIVE_UINT64, hdf5::space_of({1}), place, H5P_DEFAULT, &number));
}

} // namespace overturn
