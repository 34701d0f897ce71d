// Preloaded into overturn, kills it by SIGKILL in the midst of a chosen write to its result file:
//
//   KILL_AT_WRITE=17       the 17th write of this process to KILL_IN_FILE
//   KILL_AT_RANK=1         of this rank alone; without a launcher the rank is 0
//   KILL_TORN=1            half of the bytes get through
//   COUNT_WRITES_IN=PATH   kills nobody, but says at exit how many writes there were, and how often
//                          the file was brought to the disk
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/uio.h>
#include <unistd.h>

namespace {

long number_from(const char* name, long otherwise)
{
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : std::atol(text);
}

/// Whether the descriptor is of the file, under its name or as the part that it begins as.
bool is_the_file(int descriptor)
{
    const char* wanted = std::getenv("KILL_IN_FILE");
    char path[4096] = {};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    return wanted != nullptr && readlink(link.c_str(), path, sizeof path - 1) > 0 &&
           (std::string(path) == wanted || std::string(path) == std::string(wanted) + ".part");
}

struct Count {
    long writes = 0;
    long syncs = 0;
    ~Count()
    {
        if (const char* path = std::getenv("COUNT_WRITES_IN")) {
            std::FILE* file = std::fopen(path, "a");
            std::fprintf(file, "%ld %ld\n", writes, syncs);
            std::fclose(file);
        }
    }
};

Count count;

/// How many of the bytes are to be written before the end; -1: all of them, and no end.
long bytes_before_the_end(int descriptor, size_t bytes)
{
    if (!is_the_file(descriptor)) {
        return -1;
    }
    ++count.writes;
    const bool is_here = number_from("OMPI_COMM_WORLD_RANK", 0) == number_from("KILL_AT_RANK", 0) &&
                         count.writes == number_from("KILL_AT_WRITE", -1);
    return is_here ? long(number_from("KILL_TORN", 0) ? bytes / 2 : 0) : -1;
}

template <class Function>
Function original(const char* name)
{
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

ssize_t write_at(int descriptor, const void* buffer, size_t bytes, off64_t offset)
{
    static const auto real = original<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
    if (const long some = bytes_before_the_end(descriptor, bytes); some >= 0) {
        real(descriptor, buffer, size_t(some), offset);
        raise(SIGKILL);
    }
    return real(descriptor, buffer, bytes, offset);
}

} // namespace

extern "C" ssize_t pwrite64(int descriptor, const void* buffer, size_t bytes, off64_t offset)
{
    return write_at(descriptor, buffer, bytes, offset);
}

extern "C" ssize_t pwrite(int descriptor, const void* buffer, size_t bytes, off_t offset)
{
    return write_at(descriptor, buffer, bytes, offset);
}

extern "C" ssize_t write(int descriptor, const void* buffer, size_t bytes)
{
    static const auto real = original<ssize_t (*)(int, const void*, size_t)>("write");
    if (const long some = bytes_before_the_end(descriptor, bytes); some >= 0) {
        real(descriptor, buffer, size_t(some));
        raise(SIGKILL);
    }
    return real(descriptor, buffer, bytes);
}

extern "C" int fsync(int descriptor)
{
    static const auto real = original<int (*)(int)>("fsync");
    count.syncs += is_the_file(descriptor);
    return real(descriptor);
}

extern "C" ssize_t writev(int descriptor, const iovec* parts, int count)
{
    static const auto real = original<ssize_t (*)(int, const iovec*, int)>("writev");
    if (count > 0) {
        if (const long some = bytes_before_the_end(descriptor, parts[0].iov_len); some >= 0) {
            const iovec part{parts[0].iov_base, size_t(some)};
            real(descriptor, &part, 1);
            raise(SIGKILL);
        }
    }
    return real(descriptor, parts, count);
}
