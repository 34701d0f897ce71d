// Preloaded into overturn: simulates faults of the disk for the result file FAULTY_FILE:
//
//   KILL_AT_WRITE=17       SIGKILL during the 17th write of this process
//   KILL_TORN=1            half of the bytes of that write are written
//   KILL_BY=10             this signal instead of SIGKILL
//   FAIL_AT_WRITE=17       all writes from the 17th on fail, with the error number ERROR
//   FAIL_AT_SYNC=1         syncing fails, too
//   CRASH_AT_READ=17       crash at the 17th read of this process
//   READ_TAKES=10          milliseconds of each read
//   WRITE_TAKES=10         milliseconds of each write, in all ranks, ...
//   SLOW_WHILE=PATH        ... while this file exists
//   COUNT_WRITES_IN=PATH   writes the numbers of writes and syncs at exit
//   QUOTA_OF_USER=9000,100 quotactl() reports this limit and use in bytes; also QUOTA_OF_GROUP
//   FAULTY_RANK=1          only in this rank; without a launcher the rank is 0
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/quota.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

long number_from(const char* name, long otherwise)
{
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : std::atol(text);
}

/// Whether the descriptor is that of the file, under its name or its temporary name.
bool is_the_file(int descriptor)
{
    const char* wanted = std::getenv("FAULTY_FILE");
    char path[4096] = {};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    return wanted != nullptr && readlink(link.c_str(), path, sizeof path - 1) > 0 &&
           (std::string(path) == wanted || std::string(path) == std::string(wanted) + ".part");
}

bool is_faulty_rank()
{
    return number_from("OMPI_COMM_WORLD_RANK", number_from("PMI_RANK", 0)) ==
           number_from("FAULTY_RANK", 0);
}

struct Count {
    long writes = 0;
    long reads = 0;
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

template <class Function>
Function original(const char* name)
{
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// A write of the given number of bytes, done by write_some(bytes).
template <class WriteSome>
ssize_t faulty_write(int descriptor, size_t bytes, const WriteSome& write_some)
{
    if (is_the_file(descriptor)) {
        ++count.writes;
        if (const char* slow = std::getenv("SLOW_WHILE");
            slow != nullptr && access(slow, F_OK) == 0) {
            usleep(useconds_t(1000 * number_from("WRITE_TAKES", 0)));
        }
        if (is_faulty_rank() && count.writes == number_from("KILL_AT_WRITE", -1)) {
            write_some(number_from("KILL_TORN", 0) ? bytes / 2 : 0);
            raise(int(number_from("KILL_BY", SIGKILL)));
        }
        const long failing = number_from("FAIL_AT_WRITE", -1);
        if (is_faulty_rank() && failing >= 0 && count.writes >= failing) {
            errno = int(number_from("ERROR", EIO));
            return -1;
        }
    }
    return write_some(bytes);
}

void begin_read(int descriptor)
{
    if (is_the_file(descriptor) && is_faulty_rank()) {
        usleep(useconds_t(1000 * number_from("READ_TAKES", 0)));
        if (++count.reads == number_from("CRASH_AT_READ", 0)) {
            raise(SIGSEGV);
        }
    }
}

ssize_t write_at(int descriptor, const void* buffer, size_t bytes, off64_t offset)
{
    static const auto real = original<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
    return faulty_write(descriptor, bytes,
                        [&](size_t some) { return real(descriptor, buffer, some, offset); });
}

ssize_t read_at(int descriptor, void* buffer, size_t bytes, off64_t offset)
{
    static const auto real = original<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
    begin_read(descriptor);
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
    return faulty_write(descriptor, bytes,
                        [&](size_t some) { return real(descriptor, buffer, some); });
}

extern "C" ssize_t writev(int descriptor, const iovec* parts, int number)
{
    static const auto real = original<ssize_t (*)(int, const iovec*, int)>("writev");
    const size_t first = number > 0 ? parts[0].iov_len : 0;
    return faulty_write(descriptor, first, [&](size_t some) {
        const iovec part{number > 0 ? parts[0].iov_base : nullptr, some};
        return some == first ? real(descriptor, parts, number) : real(descriptor, &part, 1);
    });
}

extern "C" ssize_t pread64(int descriptor, void* buffer, size_t bytes, off64_t offset)
{
    return read_at(descriptor, buffer, bytes, offset);
}

extern "C" ssize_t pread(int descriptor, void* buffer, size_t bytes, off_t offset)
{
    return read_at(descriptor, buffer, bytes, offset);
}

extern "C" ssize_t read(int descriptor, void* buffer, size_t bytes)
{
    static const auto real = original<ssize_t (*)(int, void*, size_t)>("read");
    begin_read(descriptor);
    return real(descriptor, buffer, bytes);
}

extern "C" int fsync(int descriptor)
{
    static const auto real = original<int (*)(int)>("fsync");
    if (is_the_file(descriptor)) {
        ++count.syncs;
        if (is_faulty_rank() && number_from("FAIL_AT_SYNC", 0)) {
            errno = int(number_from("ERROR", EIO));
            return -1;
        }
    }
    return real(descriptor);
}

extern "C" int quotactl(int command, const char*, int, caddr_t address)
{
    constexpr int types = 0xff;
    const char* given =
        std::getenv((command & types) == USRQUOTA ? "QUOTA_OF_USER" : "QUOTA_OF_GROUP");
    unsigned long limit = 0;
    unsigned long used = 0;
    if (given == nullptr || std::sscanf(given, "%lu,%lu", &limit, &used) != 2) {
        errno = ESRCH;
        return -1;
    }
    auto* const quota = reinterpret_cast<struct dqblk*>(address);
    quota->dqb_bhardlimit = limit / 1024;
    quota->dqb_curspace = used;
    return 0;
}
