// Raw HDF5, wrapped once: handles that close themselves, and check(), through which every call
// goes. A failed call becomes an Hdf5Error that carries the innermost cause in plain words; the
// public functions of this room turn it into a FileError that says which file and what to do.
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

/// To be called before anything else of HDF5: makes it silent, and keeps it from closing files on
/// its own at exit, which would wait for other ranks.
void start();

/// Why the last call failed, as in "no space left on device".
std::string innermost_cause();

/// The result of an HDF5 call; throws Hdf5Error if it is negative.
template <class Result>
Result check(Result result)
{
    if (result < 0) {
        throw Hdf5Error(innermost_cause());
    }
    return result;
}

/// Owns an identifier of HDF5.
class Handle {
public:
    using Close = herr_t (*)(hid_t);

    Handle() = default;
    /// `id` is the result of the call that opened it, checked here.
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

    /// Closes now, so that an error is heard of.
    void close()
    {
        if (id_ >= 0) {
            check(close_(std::exchange(id_, -1)));
        }
    }

    /// Gives the identifier up without closing it.
    hid_t release() { return std::exchange(id_, -1); }

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

/// Access to a file without locks, which network file systems often lack.
Handle file_access();

Handle open_to_read(const std::string& path);
Handle open_dataset(hid_t file, std::string_view name);

} // namespace overturn::hdf5
