// Wrappers of raw HDF5: handles that close themselves, and check(), which checks every call. A
// failed call throws an Hdf5Error with the innermost cause; the public functions of this module
// convert it to an Error with the file and what to do.
#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace overturn::hdf5 {

class Hdf5Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// To be called before any other HDF5 function. Turns off the messages of HDF5, and the closing of
/// files at exit, which would wait for other ranks.
void start();

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

} // namespace overturn::hdf5
