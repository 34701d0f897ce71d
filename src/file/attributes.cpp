#include "attributes.hpp"

namespace overturn::hdf5 {

namespace {

void write(hid_t object, const char* name, hid_t stored, hid_t given, const Handle& space,
           const void* values)
{
    const Handle attribute(H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    check(H5Awrite(attribute, given, values));
}

Handle scalar()
{
    return Handle(H5Screate(H5S_SCALAR), H5Sclose);
}

Handle list(hsize_t length)
{
    return Handle(H5Screate_simple(1, &length, nullptr), H5Sclose);
}

Handle text_type(std::size_t length)
{
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    check(H5Tset_size(type, length));
    check(H5Tset_strpad(type, H5T_STR_NULLPAD));
    check(H5Tset_cset(type, H5T_CSET_UTF8));
    return type;
}

} // namespace

void write_attribute(hid_t object, const char* name, std::string_view text)
{
    if (!text.empty()) {
        const Handle type = text_type(text.size());
        write(object, name, type, type, scalar(), text.data());
    }
}

void write_attribute(hid_t object, const char* name, double value)
{
    write(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar(), &value);
}

void write_attribute(hid_t object, const char* name, std::int64_t value)
{
    write(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, scalar(), &value);
}

void write_attribute(hid_t object, const char* name, const std::vector<std::uint8_t>& values)
{
    write(object, name, H5T_STD_U8LE, H5T_NATIVE_UINT8, list(values.size()), values.data());
}

void write_attribute(hid_t object, const char* name, const std::vector<std::uint16_t>& values)
{
    write(object, name, H5T_STD_U16LE, H5T_NATIVE_UINT16, list(values.size()), values.data());
}

void write_attribute(hid_t object, const char* name, const std::vector<std::uint32_t>& values)
{
    write(object, name, H5T_STD_U32LE, H5T_NATIVE_UINT32, list(values.size()), values.data());
}

void write_attribute(hid_t object, const char* name, const std::vector<std::int64_t>& values)
{
    write(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, list(values.size()), values.data());
}

bool has_attribute(hid_t object, const char* name)
{
    return check(H5Aexists(object, name)) > 0;
}

std::string read_text_attribute(hid_t object, const char* name)
{
    if (!has_attribute(object, name)) {
        return {};
    }
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (H5Tget_class(type) != H5T_STRING || check(H5Tis_variable_str(type)) > 0 ||
        check(H5Sget_simple_extent_npoints(space)) != 1) {
        return {};
    }
    std::string text(H5Tget_size(type), '\0');
    check(H5Aread(attribute, type, text.data()));
    return text;
}

std::int64_t read_integer_attribute(hid_t object, const char* name)
{
    const std::vector<std::int64_t> values = read_integers_attribute(object, name);
    if (values.size() != 1) {
        throw Hdf5Error("the attribute " + std::string(name) + " is not a number");
    }
    return values[0];
}

std::vector<std::int64_t> read_integers_attribute(hid_t object, const char* name)
{
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const hssize_t count = check(H5Sget_simple_extent_npoints(space));
    if (count > H5S_MAX_RANK) {
        throw Hdf5Error("the attribute " + std::string(name) + " is too long");
    }
    std::vector<std::int64_t> values(static_cast<std::size_t>(count));
    check(H5Aread(attribute, H5T_NATIVE_INT64, values.data()));
    return values;
}

} // namespace overturn::hdf5
