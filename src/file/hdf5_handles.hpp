// Wrappers of raw HDF5: handles that close themselves; check(), which checks every call; and
// attributes in the forms that every netCDF-4 reader supports. A failed call throws an Hdf5Error
// with the innermost cause; the public functions of this module convert it to an Error with the
// file and what to do.
#pragma once

#include <hdf5.h>

#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace overturn::hdf5 {

class Hdf5Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The reason why the last call failed, such as "no space left on device".
std::string innermost_cause();

/// Returns the result of an HDF5 call; throws Hdf5Error if it is negative.
template <class Result>
Result check(Result result)
{
    if (result < 0) {
        throw Hdf5Error(innermost_cause());
    }
    return result;
}

/// Owns an HDF5 identifier.
class Handle {
public:
    using Close = herr_t (*)(hid_t);

    Handle() = default;
    /// `id` is the result of the call that opened the object; it is checked here.
    Handle(hid_t id, Close closer) : id_(check(id)), close_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Handle()
    {
        if (id_ >= 0) {
            close_(id_);
        }
    }

    operator hid_t() const { return id_; }

    /// Closes the object and throws Hdf5Error on failure; the destructor ignores errors.
    void close()
    {
        if (id_ >= 0) {
            check(close_(std::exchange(id_, -1)));
        }
    }

    /// Releases the identifier without closing it.
    hid_t release() { return std::exchange(id_, -1); }

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

/// Access without file locks, which network file systems often do not support.
Handle file_access();

Handle open_to_read(const std::string& path);
Handle open_dataset(hid_t file, std::string_view name);

/// Lengths along each dimension; empty for a single value.
using Extents = std::vector<hsize_t>;

Handle space_of(const Extents& shape);

/// The types of a value in a file and in memory.
struct Type {
    hid_t file;
    hid_t memory;

    static Type of(char) { return {H5T_C_S1, H5T_C_S1}; }
    static Type of(std::uint8_t) { return {H5T_STD_U8LE, H5T_NATIVE_UINT8}; }
    static Type of(std::uint16_t) { return {H5T_STD_U16LE, H5T_NATIVE_UINT16}; }
    static Type of(std::uint32_t) { return {H5T_STD_U32LE, H5T_NATIVE_UINT32}; }
    static Type of(std::uint64_t) { return {H5T_STD_U64LE, H5T_NATIVE_UINT64}; }
    static Type of(std::int64_t) { return {H5T_STD_I64LE, H5T_NATIVE_INT64}; }
    static Type of(float) { return {H5T_IEEE_F32LE, H5T_NATIVE_FLOAT}; }
    static Type of(double) { return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}; }
};

/// Writes fixed-length UTF-8. An empty text is left out: a fixed length cannot be 0.
void write_attribute(hid_t object, const char* name, std::string_view text);

void write_attribute(hid_t object, const char* name, const Type& type, const Extents& shape,
                     const void* values);

template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
void write_attribute(hid_t object, const char* name, Number value)
{
    write_attribute(object, name, Type::of(value), {}, &value);
}

template <class Number>
void write_attribute(hid_t object, const char* name, const std::vector<Number>& values)
{
    write_attribute(object, name, Type::of(Number()), {values.size()}, values.data());
}

/// Empty if the attribute is missing or is not fixed-length text.
std::string read_text_attribute(hid_t object, const char* name);

/// A number or a list of numbers; empty if the attribute is missing. Throws Hdf5Error if it is
/// something else.
std::vector<std::int64_t> read_integers_attribute(hid_t object, const char* name);

} // namespace overturn::hdf5
