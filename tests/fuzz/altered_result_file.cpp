#include "altered_result_file.hpp"

#include "file/tile_access.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/text/mapped.hpp"
#include "support/given_values.hpp"
#include "support/scratch_folder.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace overturn {

namespace {

/// Bytes of the recipe; zeros when they are used up.
class Recipe {
public:
    explicit Recipe(std::string_view bytes) : bytes_(bytes) {}

    bool is_over() const { return bytes_.empty(); }

    std::size_t choose(std::size_t count)
    {
        if (is_over()) {
            return 0;
        }
        const auto first = static_cast<unsigned char>(bytes_[0]);
        bytes_.remove_prefix(1);
        return first % count;
    }

    template <class List>
    auto one_of(const List& list)
    {
        return list[choose(std::size(list))];
    }

    std::string text(std::size_t length)
    {
        std::string result(bytes_.substr(0, length));
        bytes_.remove_prefix(result.size());
        result.resize(length);
        return result;
    }

private:
    std::string_view bytes_;
};

constexpr std::array objects{"slenderness",
                             "restitution",
                             "amplitude",
                             "frequency",
                             "region",
                             "impacts",
                             "pga",
                             "run/run_token",
                             "run/job_given",
                             "run/tile",
                             "region_below",
                             "run/checksum",
                             "run/job_resolved",
                             "run/coordinate_checksums",
                             "run/skeleton",
                             "run",
                             "/"};
constexpr std::array attributes{"kind",           "title",      "program_version", "program_commit",
                                "format_version", "dimensions", "tile_shape",      "units",
                                "part",           "parts",      "checksum"};
constexpr std::array<hsize_t, 12> lengths{0,
                                          1,
                                          2,
                                          3,
                                          4,
                                          100,
                                          hsize_t(1) << 20,
                                          (hsize_t(1) << 31) + 1,
                                          (hsize_t(1) << 32) + 1,
                                          hsize_t(1) << 40,
                                          (hsize_t(1) << 61) - 1,
                                          hsize_t(1) << 62};

/// Creates a type, to be closed by the caller. Calls may fail, which leaves the file unchanged.
hid_t type_of(Recipe& recipe)
{
    const std::array plain{H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_STD_U8LE,  H5T_STD_U64LE,
                           H5T_STD_I64LE,  H5T_STD_I8LE,   H5T_STD_U16LE, H5T_C_S1};
    const std::size_t kind = recipe.choose(plain.size() + 4);
    if (kind < plain.size()) {
        return H5Tcopy(plain[kind]);
    }
    if (kind == plain.size()) {
        const hid_t text = H5Tcopy(H5T_C_S1);
        H5Tset_size(text, std::max<std::size_t>(1, recipe.choose(255)));
        return text;
    }
    if (kind == plain.size() + 1) {
        const hid_t text = H5Tcopy(H5T_C_S1);
        H5Tset_size(text, H5T_VARIABLE);
        return text;
    }
    if (kind == plain.size() + 2) {
        const hsize_t length = 3;
        return H5Tarray_create2(H5T_STD_I64LE, 1, &length);
    }
    const hid_t pair = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(pair, "a", 0, H5T_STD_I64LE);
    H5Tinsert(pair, "b", 8, H5T_IEEE_F64LE);
    return pair;
}

std::vector<hsize_t> shape_of(Recipe& recipe)
{
    std::vector<hsize_t> shape(recipe.choose(6));
    std::generate(shape.begin(), shape.end(), [&] { return recipe.one_of(lengths); });
    return shape;
}

hid_t space_of(const std::vector<hsize_t>& shape)
{
    return shape.empty() ? H5Screate(H5S_SCALAR)
                         : H5Screate_simple(int(shape.size()), shape.data(), nullptr);
}

bool is_small(hid_t space)
{
    constexpr hssize_t most = 1024;
    return H5Sget_simple_extent_npoints(space) >= 0 && H5Sget_simple_extent_npoints(space) <= most;
}

void set_attribute(hid_t file, Recipe& recipe)
{
    const hid_t object = H5Oopen(file, recipe.one_of(objects), H5P_DEFAULT);
    const char* const name = recipe.one_of(attributes);
    const hid_t type = type_of(recipe);
    const hid_t space = space_of(shape_of(recipe));
    H5Adelete(object, name);
    if (is_small(space)) {
        const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
        const std::size_t bytes =
            H5Tget_size(type) * std::size_t(H5Sget_simple_extent_npoints(space));
        if (H5Tis_variable_str(type) == 0) {
            H5Awrite(attribute, type, recipe.text(bytes).data());
        }
        H5Aclose(attribute);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Oclose(object);
}

/// The storage of a dataset of this shape.
hid_t creation_of(Recipe& recipe, const std::vector<hsize_t>& shape, hid_t space,
                  const std::string& elsewhere)
{
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    switch (recipe.choose(5)) {
    case 0: H5Pset_layout(creation, H5D_COMPACT); break;
    case 1: {
        std::vector<hsize_t> chunk = shape;
        const hsize_t longest = 1 + recipe.choose(8);
        for (hsize_t& length : chunk) {
            length = std::clamp<hsize_t>(length, 1, longest);
        }
        H5Pset_chunk(creation, int(chunk.size()), chunk.data());
        break;
    }
    case 2: H5Pset_external(creation, elsewhere.c_str(), 0, H5F_UNLIMITED); break;
    case 3:
        H5Pset_virtual(creation, space, elsewhere.c_str(), recipe.one_of(objects), space);
        break;
    default: break;
    }
    return creation;
}

void replace_dataset(hid_t file, Recipe& recipe, const std::string& elsewhere)
{
    const char* const name = recipe.one_of(objects);
    const hid_t type = type_of(recipe);
    const std::vector<hsize_t> shape = shape_of(recipe);
    const hid_t space = space_of(shape);
    const hid_t creation = creation_of(recipe, shape, space, elsewhere);
    H5Ldelete(file, name, H5P_DEFAULT);
    H5Dclose(H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
    H5Pclose(creation);
    H5Sclose(space);
    H5Tclose(type);
}

void replace_link(hid_t file, Recipe& recipe, const std::string& elsewhere)
{
    const char* const name = recipe.one_of(objects);
    const char* const other = recipe.one_of(objects);
    H5Ldelete(file, name, H5P_DEFAULT);
    switch (recipe.choose(5)) {
    case 0: H5Lcreate_soft(other, file, name, H5P_DEFAULT, H5P_DEFAULT); break;
    case 1: H5Lcreate_hard(file, other, file, name, H5P_DEFAULT, H5P_DEFAULT); break;
    case 2:
        H5Lcreate_external(elsewhere.c_str(), other, file, name, H5P_DEFAULT, H5P_DEFAULT);
        break;
    case 3: H5Gclose(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); break;
    default: break;
    }
}

void overwrite_values(hid_t file, Recipe& recipe)
{
    const hid_t dataset = H5Dopen2(file, recipe.one_of(objects), H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    const hid_t space = H5Dget_space(dataset);
    if (is_small(space) && H5Tis_variable_str(type) == 0) {
        const std::size_t bytes =
            H5Tget_size(type) * std::size_t(H5Sget_simple_extent_npoints(space));
        H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, recipe.text(bytes).data());
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(dataset);
}

/// Without tiles, or, as a part, with all of them.
std::string file_to_alter(bool is_part)
{
    const ScratchFolder folder;
    const std::string path = folder / "as_written.h5";
    const Job job = job_to_alter();
    create_result(path, job, is_part ? std::optional(JobPart{1, 1}) : std::nullopt);
    if (is_part) {
        const Tile tile = tiling_of(job.problem)[0];
        const std::vector<FieldValues> values = mapped(
            job.problem.fields, [&](Field field) { return not_computed(field, tile.points()); });
        const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        write_number(hdf5::open_dataset(file, "run/checksum"), tile.number,
                     TileChecksums(job.resolved).of(tile.number, values));
    }
    return bytes_of(path);
}

} // namespace

Job job_to_alter()
{
    Job job;
    job.problem.grid =
        grid_of(job.problem.scene, {axis("frequency", {1, 2}), axis("amplitude", {1, 2}),
                                    number("restitution", 0.7), number("slenderness", 0.2)});
    job.title = "A file to alter";
    job.problem.fields = {Field::region, Field::impacts};
    job.given = "the job file\n";
    job.resolved = "title = \"A file to alter\"\n";
    return job;
}

void write_altered_result_file(const std::string& path, std::string_view recipe,
                               const std::string& elsewhere)
{
    static const std::array files{file_to_alter(false), file_to_alter(true)};
    write_bytes(path, files[recipe.size() % 2]);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    Recipe steps(recipe);
    while (!steps.is_over()) {
        switch (steps.choose(4)) {
        case 0: set_attribute(file, steps); break;
        case 1: replace_dataset(file, steps, elsewhere); break;
        case 2: replace_link(file, steps, elsewhere); break;
        default: overwrite_values(file, steps); break;
        }
    }
    H5Fclose(file);
}

} // namespace overturn
