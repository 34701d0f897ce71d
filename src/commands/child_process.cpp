#include "child_process.hpp"

#include "exit_code.hpp"

#include "overturn/file/file_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace overturn {

namespace {

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU};

void limit(int resource, rlim_t most)
{
    const rlimit limits{most, most};
    setrlimit(resource, &limits);
}

/// Limits processor time and memory for the file at the path, and disables core files.
void limit_resources(const std::string& path)
{
    std::error_code none;
    const std::uintmax_t found = std::filesystem::file_size(path, none);
    const rlim_t bytes = none ? 0 : rlim_t(found);
    const rlim_t seconds = 60 + 60 * (bytes >> 30);
    const rlimit processor_time{seconds, seconds + 1}; // SIGXCPU comes before SIGKILL
    setrlimit(RLIMIT_CPU, &processor_time);
    limit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__ // which reserves terabytes of address space at the start
    limit(RLIMIT_DATA, (rlim_t(1) << 29) + 2 * bytes);
#endif
}

[[noreturn]] void be_child(pid_t parent, const std::string& path, const std::function<void()>& read)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(exit_code::internal); // the parent ended before the call of prctl
    }
    limit_resources(path);
    int code = exit_code::complete;
    try {
        read();
        if (std::fflush(stdout) != 0) {
            throw FileError("cannot write to stdout.");
        }
    } catch (const std::exception& error) {
        code = complain(error);
    }
    _exit(code);
}

/// Waits for the child, and returns its status as waitpid() does.
int wait_for(pid_t child, const std::function<bool()>& is_unwanted)
{
    int status = 0;
    for (;;) {
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) {
            return status;
        }
        if (ended < 0 && errno != EINTR) {
            throw FileError(fmt::format("cannot wait for a process: {}.", std::strerror(errno)));
        }
        if (is_unwanted()) {
            kill(child, SIGKILL);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

} // namespace

int run_in_child(const std::string& path, const std::function<void()>& read,
                 const std::function<bool()>& is_unwanted)
{
    std::signal(SIGCHLD, SIG_DFL); // SIG_IGN, inherited from a parent, would discard the status
    std::fflush(nullptr);          // otherwise the child would print buffered text again
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) {
        throw FileError(
            fmt::format("cannot start a process to read \"{}\": {}.", path, std::strerror(errno)));
    }
    if (child == 0) {
        be_child(parent, path, read);
    }
    const int status = wait_for(child, is_unwanted);
    if (WIFEXITED(status)) {
        return WEXITSTATUS(status);
    }
    const int signal = WTERMSIG(status);
    if (signal == SIGKILL) {
        if (is_unwanted()) {
            return exit_code::stopped;
        }
        throw FileError(fmt::format("the process that read \"{}\" was killed, perhaps because it "
                                    "ran out of memory.",
                                    path));
    }
    if (std::find(crashes.begin(), crashes.end(), signal) == crashes.end()) {
        std::signal(signal, SIG_DFL); // it was sent to this process as well
        raise(signal);
    }
    throw FileError(fmt::format(
        "\"{}\" is damaged: the HDF5 library {}.", path,
        signal == SIGXCPU ? "does not finish reading it in time"
                          : fmt::format("crashes while reading it ({})", strsignal(signal))));
}

} // namespace overturn
