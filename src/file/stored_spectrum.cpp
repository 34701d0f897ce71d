#include "stored_spectrum.hpp"

#include "attributes.hpp"
#include "coordinates.hpp"
#include "layout.hpp"
#include "operating_system.hpp"
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

void demand(bool condition, const char* what_is_wrong)
{
    if (!condition) {
        throw hdf5::Hdf5Error(what_is_wrong);
    }
}

/// The number of names (hard links) of an object.
unsigned count_names(hid_t object)
{
#if H5_VERSION_GE(1, 12, 0)
    H5O_info2_t info = {};
    check(H5Oget_info3(object, &info, H5O_INFO_BASIC));
#else
    H5O_info_t info = {};
    check(H5Oget_info(object, &info));
#endif
    return info.rc;
}

/// Opens a dataset that is stored in the file itself, under a single name. HDF5 follows links and
/// external storage into other files, which a resumed run would write to.
Handle open_own_dataset(hid_t file, const std::string& name)
{
    H5L_info_t link = {};
    check(H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT));
    demand(link.type == H5L_TYPE_HARD, "a dataset is a link to another object");
    Handle dataset = hdf5::open_dataset(file, name);
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    demand(check(H5Pget_external_count(creation)) == 0 && H5Pget_layout(creation) != H5D_VIRTUAL,
           "the values of a dataset are stored in another file");
    demand(count_names(dataset) == 1, "a dataset has two names");
    return dataset;
}

std::vector<hsize_t> shape_of(hid_t dataset)
{
    const Handle space(H5Dget_space(dataset), H5Sclose);
    std::vector<hsize_t> shape(std::size_t(check(H5Sget_simple_extent_ndims(space))));
    check(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
    return shape;
}

bool has_type(hid_t dataset, hid_t expected)
{
    const Handle type(H5Dget_type(dataset), H5Tclose);
    return check(H5Tequal(type, expected)) > 0;
}

/// The length of a list of this type. It is checked against the size of the file, because a damaged
/// length could exhaust the memory.
hsize_t length_of_list(hid_t dataset, hid_t type, std::uint64_t bytes_of_file,
                       const char* what_is_wrong)
{
    const std::vector<hsize_t> shape = shape_of(dataset);
    const hsize_t bytes_per_value = H5Tget_size(type);
    demand(shape.size() == 1 && shape[0] <= bytes_of_file / bytes_per_value &&
               shape[0] * bytes_per_value <= H5Dget_storage_size(dataset) &&
               has_type(dataset, type),
           what_is_wrong);
    return shape[0];
}

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

std::string read_text(hid_t file, const char* name, std::uint64_t bytes)
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
    const Handle checksums = open_own_dataset(spectrum.file, layout::checksum);
    std::istringstream words(hdf5::read_text_attribute(checksums, layout::dimensions));
    std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
    if (spectrum.format == 1) {
        names = {"slenderness", "restitution",
                 spectrum.product == Product::boundary ? "crossing" : "amplitude", "frequency"};
    }
    demand(names.size() >= 2 && names.size() <= H5S_MAX_RANK, "the dimensions are malformed");
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
    const Handle dataset = open_own_dataset(spectrum.file, layout::checksum);
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
    origin.resolved_job = read_text(file, layout::job_resolved, origin.bytes);
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

/// `pga` was named peak_ground_acceleration in earlier files of format 2.
std::string stored_name_of(const std::string& coordinate, hid_t file)
{
    const bool has_old_name =
        coordinate == "pga" && check(H5Lexists(file, "pga", H5P_DEFAULT)) == 0;
    return has_old_name ? "peak_ground_acceleration" : coordinate;
}

/// Throws Hdf5Error, which foreign_coordinates() converts.
std::vector<std::string> find_foreign_coordinates(const StoredSpectrum& stored, const Job& job)
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
    const std::string scan = name_of_scan(job);
    if (job.product == Product::boundary && !has_shape(scan, {hsize_t(job.scan.size())})) {
        foreign.push_back(scan);
    }
    if (!foreign.empty()) {
        return foreign;
    }
    for (Coordinate coordinate : coordinates_of(job)) {
        coordinate.name = stored_name_of(coordinate.name, stored.file);
        std::vector<double> values(coordinate.values.size());
        if (has_shape(coordinate.name, coordinate.shape)) {
            const Handle dataset = open_own_dataset(stored.file, coordinate.name);
            check(
                H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
        }
        const double tolerance = coordinate.roundings * std::numeric_limits<double>::epsilon();
        const auto is_as_good_as = [=](double value, double computed) {
            return std::abs(value - computed) <= tolerance * std::abs(computed);
        };
        if (!std::equal(values.begin(), values.end(), coordinate.values.begin(), is_as_good_as)) {
            foreign.push_back(coordinate.name);
        }
    }
    return foreign;
}

/// Returns the result of `read`; converts its errors to a FileError that names the file.
template <class Read>
auto or_refused(const std::string& path, const Read& read)
{
    try {
        return read();
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(
            fmt::format("\"{}\" cannot be read or is damaged: {}.", path, error.what()));
    } catch (const std::bad_alloc&) {
        throw FileError(fmt::format("\"{}\" is damaged: it contains an impossible size.", path));
    }
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

std::vector<std::string> foreign_coordinates(const StoredSpectrum& stored, const Job& job)
{
    return or_refused(stored.path, [&] { return find_foreign_coordinates(stored, job); });
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
