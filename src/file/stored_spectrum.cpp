#include "stored_spectrum.hpp"

#include "attributes.hpp"
#include "layout.hpp"
#include "operating_system.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"

#include "overturn/file/file_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <new>
#include <sstream>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;

/// Whether all values are stored. This also reads the whole chunk index, so that a damaged index is
/// found, or crashes HDF5, before the file is used.
bool is_stored_as_a_whole(hid_t dataset, const std::vector<hsize_t>& shape, hsize_t bytes_per_value)
{
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    hsize_t expected = bytes_per_value;
    std::vector<hsize_t> chunk(shape.size(), 1);
    if (H5Pget_layout(creation) == H5D_CHUNKED) {
        check(H5Pget_chunk(creation, int(chunk.size()), chunk.data()));
    }
    for (std::size_t i = 0; i < shape.size(); ++i) {
        demand(chunk[i] >= 1, "a field has empty chunks");
        expected *= (shape[i] + chunk[i] - 1) / chunk[i] * chunk[i];
    }
    const bool is_compressed = check(H5Pget_nfilters(creation)) > 0;
    return H5Dget_storage_size(dataset) == expected || is_compressed;
}

std::string read_text(hid_t file, const std::string& name, std::uint64_t bytes)
{
    const Handle dataset = open_own_dataset(file, name);
    std::string text(length_of_list(dataset, H5T_C_S1, bytes, "a text is malformed"), '\0');
    check(H5Dread(dataset, H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
    return text;
}

AxisSummary read_axis(hid_t file, const std::string& name, std::uint64_t bytes)
{
    constexpr const char* malformed = "an axis is malformed";
    const Handle dataset = open_own_dataset(file, name);
    std::vector<double> values(length_of_list(dataset, H5T_IEEE_F64LE, bytes, malformed));
    demand(!values.empty(), malformed);
    check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return {name, std::int64_t(values.size()), values.front(), values.back(),
            hdf5::read_text_attribute(dataset, "units")};
}

/// The fields in the order of their creation, which is that of the job.
std::vector<FieldSummary> read_fields(hid_t file)
{
    H5G_info_t group = {};
    check(H5Gget_info(file, &group));
    std::vector<FieldSummary> fields;
    for (hsize_t i = 0; i < group.nlinks; ++i) {
        std::string name(64, '\0');
        const auto length = check(H5Lget_name_by_idx(file, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i,
                                                     name.data(), name.size(), H5P_DEFAULT));
        name.resize(std::min(std::size_t(length), name.size()));
        const auto* found = std::find(field_names.begin(), field_names.end(), name);
        if (found != field_names.end()) {
            const auto field = Field(found - field_names.begin());
            fields.push_back({field, name, layout::stored_as(field).name});
        }
    }
    demand(!fields.empty(), "there are no fields");
    return fields;
}

void check_field(const StoredSpectrum& spectrum, Field field)
{
    const Handle dataset = open_own_dataset(spectrum.file, std::string(name_of(field)));
    const std::vector<hsize_t> shape = shape_of(dataset);
    const std::vector<AxisSummary> axes = dimensions_of(field, spectrum.axes);
    demand(shape.size() == axes.size() && has_type(dataset, layout::stored_as(field).file),
           "a field is malformed");
    std::uint64_t room = spectrum.bytes / bytes_per_point(field);
    for (std::size_t i = 0; i < shape.size(); ++i) {
        demand(shape[i] == hsize_t(axes[i].size), "a field does not fit the axes");
        demand(shape[i] <= room, "a field is larger than the file");
        room /= shape[i];
    }
    demand(is_stored_as_a_whole(dataset, shape, bytes_per_point(field)),
           "values of a field are missing");
}

/// The names of the dimensions, slowest first. Files of format 1 have four.
std::vector<std::string> read_dimensions(const StoredSpectrum& spectrum)
{
    const Handle checksums =
        open_own_dataset(spectrum.file, layout::in_run_group(layout::checksum, spectrum.format));
    std::istringstream words(hdf5::read_text_attribute(checksums, layout::dimensions));
    std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
    if (spectrum.format == 1) {
        names = {"slenderness", "restitution",
                 spectrum.product == Product::boundary ? "crossing" : "amplitude", "frequency"};
    }
    demand(!names.empty() && names.size() <= H5S_MAX_RANK, "the dimensions are malformed");
    return names;
}

Shape read_tile_shape(hid_t checksums)
{
    if (hdf5::has_attribute(checksums, layout::tile_shape)) {
        return hdf5::read_integers_attribute(checksums, layout::tile_shape);
    }
    return {1, 1, hdf5::read_integer_attribute(checksums, "amplitude_extent"),
            hdf5::read_integer_attribute(checksums, "frequency_extent")};
}

void read_checksums_of_tiles(StoredSpectrum& spectrum)
{
    const Handle dataset =
        open_own_dataset(spectrum.file, layout::in_run_group(layout::checksum, spectrum.format));
    spectrum.tile_shape = read_tile_shape(dataset);
    const Shape& tile = spectrum.tile_shape;
    demand(tile.size() == spectrum.axes.size() &&
               std::all_of(tile.begin(), tile.end(), [](auto size) { return size >= 1; }),
           "the tiles are malformed");
    constexpr const char* foreign = "the checksums do not fit the tiles";
    spectrum.tiles = spectrum.tiling().size();
    demand(length_of_list(dataset, H5T_STD_U64LE, spectrum.bytes, foreign) ==
               hsize_t(spectrum.tiles),
           foreign);
    spectrum.checksums = read_checksums(dataset);
    spectrum.tiles_done =
        spectrum.tiles -
        std::count(spectrum.checksums.begin(), spectrum.checksums.end(), not_computed_checksum);
}

/// The metadata of a file whose kind is at most `last`; `wanted` names the kind in the message.
FileOrigin read_origin(hid_t file, const std::string& path, FileKind last, const char* wanted)
{
    FileOrigin origin;
    origin.bytes = std::filesystem::file_size(path);
    const std::string kind = hdf5::read_text_attribute(file, "kind");
    origin.kind = FileKind(std::find(layout::kinds.begin(), layout::kinds.end(), kind) -
                           layout::kinds.begin());
    if (origin.kind > last) {
        throw FileError(fmt::format("\"{}\" is an HDF5 file, but not a {} of overturn{}.", path,
                                    wanted,
                                    kind.empty() ? "" : fmt::format(": its kind is \"{}\"", kind)));
    }
    origin.format = hdf5::has_attribute(file, layout::format_version)
                        ? hdf5::read_integer_attribute(file, layout::format_version)
                        : 1;
    if (origin.format < 1 || origin.format > layout::newest_format) {
        throw FileError(fmt::format("\"{}\" has format version {}, but this program reads up to "
                                    "version {} only. Use a newer program.",
                                    path, origin.format, layout::newest_format));
    }
    origin.title = hdf5::read_text_attribute(file, "title");
    origin.program_version = hdf5::read_text_attribute(file, "program_version");
    origin.program_commit = hdf5::read_text_attribute(file, "program_commit");
    origin.resolved_job =
        read_text(file, layout::in_run_group(layout::job_resolved, origin.format), origin.bytes);
    return origin;
}

StoredSpectrum read_spectrum(Handle file, const std::string& path)
{
    StoredSpectrum spectrum;
    static_cast<FileOrigin&>(spectrum) = read_origin(file, path, FileKind::boundary, "spectrum");
    spectrum.product = Product(spectrum.kind);
    spectrum.path = path;
    spectrum.file = std::move(file);
    for (const std::string& name : read_dimensions(spectrum)) {
        spectrum.axes.push_back(read_axis(spectrum.file, name, spectrum.bytes));
    }
    spectrum.fields = read_fields(spectrum.file);
    for (const FieldSummary& field : spectrum.fields) {
        check_field(spectrum, field.field);
    }
    read_checksums_of_tiles(spectrum);
    return spectrum;
}

Handle open_file(const std::string& path)
{
    std::error_code reason;
    if (!std::filesystem::is_regular_file(path, reason)) {
        throw FileError(fmt::format("cannot read \"{}\": {}.", path,
                                    reason ? in_sentence(reason.message())
                                           : std::string("it is not a regular file")));
    }
    hdf5::start();
    if (check(H5Fis_hdf5(path.c_str())) == 0) {
        throw FileError(fmt::format("\"{}\" is not an HDF5 file.", path));
    }
    return hdf5::open_to_read(path);
}

} // namespace

Tiling StoredSpectrum::tiling() const
{
    Shape shape;
    for (const AxisSummary& axis : axes) {
        shape.push_back(axis.size);
    }
    return {std::move(shape), tile_shape};
}

StoredSpectrum open_stored_spectrum(const std::string& path)
{
    return or_refused(path, [&] { return read_spectrum(open_file(path), path); });
}

FileOrigin origin_of(const std::string& path)
{
    return or_refused(
        path, [&] { return read_origin(open_file(path), path, FileKind::accuracy, "result"); });
}

} // namespace overturn
