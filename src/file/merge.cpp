#include "overturn/file/merge.hpp"

#include "job_difference.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "own_dataset.hpp"
#include "tile_layout.hpp"
#include "working_file.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>

namespace overturn {

using hdf5::check;
using hdf5::Handle;
using layout::in_run_group;

namespace {

const JobPart& part_of(const StoredResult& stored)
{
    return *stored.tiles().part;
}

template <class... Arguments>
[[noreturn]] void refuse(fmt::format_string<Arguments...> text, Arguments&&... arguments)
{
    throw Error(exit_code::output, fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// Throws Error unless both files have the same job. advice: what to do with the file.
void expect_same_job(const StoredResult& stored, const StoredResult& other, std::string_view advice)
{
    const FileOrigin& origin = stored.origin();
    const FileOrigin& expected = other.origin();
    const std::string whose = fmt::format("\"{}\"", other.path());
    if (origin.kind != expected.kind) {
        refuse("\"{}\" is an {}, but {} an {}. {}", stored.path(), name_of(origin.kind), whose,
               name_of(expected.kind), advice);
    }
    if (origin.resolved_job != expected.resolved_job) {
        refuse("\"{}\" belongs to another job than {}: {}{}", stored.path(), whose,
               differing_line(origin.resolved_job, expected.resolved_job, whose), advice);
    }
    if (stored.coordinate_checksums() != other.coordinate_checksums()) {
        refuse("\"{}\" has other values of coordinates than {}: it was computed with another C "
               "library. {}",
               stored.path(), whose, advice);
    }
}

void expect_part_of_this_program(const StoredResult& stored)
{
    if (!stored.tiles().part) {
        refuse("\"{}\" is the file of all tiles of a job, not of a part of it. Give the files that "
               "overturn run --part has written.",
               stored.path());
    }
    const FileOrigin& origin = stored.origin();
    if (origin.program_version != program_version() || origin.program_commit != program_commit()) {
        refuse("\"{}\" was computed by overturn {} (commit {}), but this is overturn {} (commit "
               "{}), which may write another file. Use that version.",
               stored.path(), origin.program_version, origin.program_commit, program_version(),
               program_commit());
    }
}

/// Items that are listed in a message, so that it stays short.
constexpr std::size_t most_listed = 100;

/// The items, and ", ..." if there are more than are listed.
template <class Item>
std::string listed(std::vector<Item> items)
{
    const bool are_more = items.size() > most_listed;
    items.resize(std::min(items.size(), most_listed));
    return fmt::format("{}{}", fmt::join(items, ", "), are_more ? ", ..." : "");
}

/// "3 are unfinished: 4, 5, 8"; empty if there are none. parts: numbers, as many as are listed.
std::string words_on(std::int64_t count, const std::vector<std::int64_t>& parts,
                     std::string_view what)
{
    return count == 0
               ? ""
               : fmt::format("{} {} {}: {}", count, count == 1 ? "is" : "are", what, listed(parts));
}

/// Throws Error if a part is missing, unfinished, or given twice. parts: sorted.
void expect_each_part(const std::vector<StoredResult>& parts)
{
    const auto same = std::ranges::adjacent_find(
        parts, {}, [](const StoredResult& stored) { return part_of(stored).number; });
    if (same != parts.end()) {
        refuse("\"{}\" and \"{}\" are both {}. Give one of them.", same->path(),
               std::next(same)->path(), words_of(part_of(*same)));
    }
    const std::int64_t count = part_of(parts.front()).count;
    std::vector<std::int64_t> missing;
    auto given = parts.begin();
    for (std::int64_t number = 1; number <= count && missing.size() <= most_listed; ++number) {
        if (given != parts.end() && part_of(*given).number == number) {
            ++given;
        } else {
            missing.push_back(number);
        }
    }
    std::vector<std::int64_t> unfinished;
    for (const StoredResult& part : parts) {
        if (part.tiles().tiles_done < part.tiles().tiles) {
            unfinished.push_back(part_of(part).number);
        }
    }
    std::vector<std::string> found{words_on(count - std::ssize(parts), missing, "missing"),
                                   words_on(std::ssize(unfinished), unfinished, "unfinished")};
    std::erase(found, "");
    if (!found.empty()) {
        refuse("of {} parts, {}. Run overturn run --part for each of these, which resumes "
               "unfinished ones, and give all files.",
               count, fmt::join(found, ", and "));
    }
}

/// A part that is open for reading.
struct OpenPart {
    const StoredResult& stored;
    Handle file;

    explicit OpenPart(const StoredResult& part)
        : stored(part),
          file(or_refused(part.path(), [&] { return hdf5::open_to_read(part.path()); }))
    {}

    template <class Value>
    std::vector<Value> of_run_group(const char* name) const
    {
        return or_refused(stored.path(), [&] {
            return read_all<Value>(open_own_dataset(file, in_run_group(name)),
                                   stored.origin().bytes);
        });
    }

    StoredField field_like(const StoredField& merged) const
    {
        return or_refused(stored.path(), [&] {
            return StoredField{merged.field,
                               open_own_dataset(file, std::string(name_of(merged.field))),
                               merged.crossing};
        });
    }
};

void write_bytes(const std::string& path, const std::vector<std::uint8_t>& bytes)
{
    errno = 0;
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    stream.close();
    if (!stream) {
        throw hdf5::Hdf5Error(system_reason(errno));
    }
}

/// Writes numbers of tiles, such as the checksums, each from the part to which its tile belongs.
void merge_numbers(hid_t file, const char* name, const std::vector<OpenPart>& parts,
                   const JobDivision& division)
{
    std::vector<std::uint64_t> merged;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const auto numbers = parts[part].of_run_group<std::uint64_t>(name);
        merged.resize(numbers.size());
        for (std::size_t tile = 0; tile < numbers.size(); ++tile) {
            if (division.part_of(std::int64_t(tile)) == std::int64_t(part + 1)) {
                merged[tile] = numbers[tile];
            }
        }
    }
    check(H5Dwrite(open_own_dataset(file, in_run_group(name)), H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL,
                   H5P_DEFAULT, merged.data()));
}

} // namespace

void expect_all_parts(std::vector<StoredResult>& parts)
{
    std::ranges::for_each(parts, expect_part_of_this_program);
    const StoredResult& first = parts.front();
    for (const StoredResult& part : parts) {
        expect_same_job(
            part, first,
            "Compute it again with the job file and the --set arguments of the others.");
        if (part_of(part).count != part_of(first).count) {
            refuse("\"{}\" is {}, but \"{}\" is {}. Give the parts of one division.", part.path(),
                   words_of(part_of(part)), first.path(), words_of(part_of(first)));
        }
    }
    std::ranges::sort(parts, {}, [](const auto& part) { return part_of(part).number; });
    expect_each_part(parts);
}

void expect_merged(const StoredResult& merged, const StoredResult& part)
{
    constexpr std::string_view advice = "Move it away, or choose another name with -o.";
    expect_same_job(merged, part, advice);
    const TilesSummary& tiles = merged.tiles();
    if (tiles.part) {
        refuse("\"{}\" is {}, not the file of all parts. Choose another name with -o.",
               merged.path(), words_of(*tiles.part));
    }
    if (tiles.tiles_done < tiles.tiles) {
        refuse("\"{}\" exists, but lacks {} of {} tiles. {}", merged.path(),
               tiles.tiles - tiles.tiles_done, tiles.tiles, advice);
    }
}

void expect_room_for_merged(const StoredResult& part, const std::string& path)
{
    const PartFile place(path);
    const auto skeleton = OpenPart(part).of_run_group<std::uint8_t>(layout::skeleton);
    expect_space(path, bytes_of_tiles(tile_layout_of(part.tiles())) + skeleton.size(),
                 "Free some space, or choose another disk with -o.");
}

void merge_parts(const std::vector<StoredResult>& parts, const std::string& path,
                 const BetweenTiles& on_tile)
{
    const TileLayout tiles = tile_layout_of(parts.front().tiles());
    const JobDivision division(tiles.tiling.size(), std::ssize(parts));
    const std::vector<OpenPart> open(parts.begin(), parts.end());
    const auto chunks_of = [&](const StoredField& merged) -> ChunkOfTile {
        const auto fields = std::make_shared<std::vector<StoredField>>();
        for (const OpenPart& part : open) {
            fields->push_back(part.field_like(merged));
        }
        return [&, fields, chunk = FieldValues()](const Tile& tile) mutable -> const FieldValues& {
            on_tile();
            const auto part = std::size_t(division.part_of(tile.number) - 1);
            return chunk = or_refused(open[part].stored.path(), [&] {
                       return read_chunk((*fields)[part], tile, tiles.tiling.tile_shape());
                   });
        };
    };
    netcdf::create_in_place(path, [&](const std::string& temporary) {
        write_bytes(temporary, open.front().of_run_group<std::uint8_t>(layout::skeleton));
        add_tiles(temporary, tiles, {}, chunks_of);
        Handle file(H5Fopen(temporary.c_str(), H5F_ACC_RDWR, hdf5::file_access()), H5Fclose);
        merge_numbers(file, layout::checksum, open, division);
        if (tiles.is_filled) {
            merge_numbers(file, layout::audit_checked, open, division);
            merge_numbers(file, layout::audit_wrong, open, division);
        }
        file.close();
        expect_merged(StoredResult(temporary), parts.front());
    });
}

} // namespace overturn
