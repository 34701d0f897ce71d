#include "apart.hpp"

#include "exit_code.hpp"

#include "overturn/file/file_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <spawn.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace overturn {

namespace {

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU};

void limit(int resource, rlim_t most)
{
    const rlimit limits{most, most};
    setrlimit(resource, &limits);
}

/// A crash leaves no core file, an endless loop ends, no size in a file takes all memory, and
/// nobody stays behind alone.
void prepare_to_crash(const std::string& path)
{
    std::error_code none;
    const std::uintmax_t found = std::filesystem::file_size(path, none);
    const rlim_t bytes = none ? 0 : rlim_t(found);
    const rlim_t seconds = 60 + 60 * (bytes >> 30);
    const rlimit processor_time{seconds, seconds + 1}; // first a signal that tells what it was
    setrlimit(RLIMIT_CPU, &processor_time);
    limit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__ // which takes all there is, to begin with
    limit(RLIMIT_DATA, (rlim_t(1) << 29) + 2 * bytes);
#endif
    end_with_parent();
}

int call(const std::function<int()>& read)
{
    try {
        return read();
    } catch (const std::exception& error) {
        return complain(error);
    }
}

/// Who starts us may have asked for children that leave nothing to wait for.
void expect_children()
{
    std::signal(SIGCHLD, SIG_DFL);
}

int wait_for(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            throw FileError(
                fmt::format("cannot learn how a process has ended: {}.", std::strerror(errno)));
        }
    }
    return status;
}

/// The last complaint of a process among what else it, or its loader, has to say; how it ended
/// otherwise.
std::string complaint_in(const std::string& errors, int status)
{
    constexpr std::string_view name = "\noverturn: ";
    const std::string lines = fmt::format("\n{}", errors);
    const std::size_t begin = lines.rfind(name);
    if (begin != lines.npos) {
        std::string complaint = lines.substr(begin + name.size());
        complaint.erase(complaint.find_last_not_of('\n') + 1);
        return complaint;
    }
    return WIFEXITED(status)
               ? fmt::format("a process of overturn ended with exit code {} and no word.",
                             WEXITSTATUS(status))
               : fmt::format("a process of overturn was ended by a signal ({}).",
                             strsignal(WTERMSIG(status)));
}

/// Takes what has come through; false at its end.
bool take(int pipe_end, std::string& text)
{
    std::array<char, 4096> block;
    const ssize_t size = ::read(pipe_end, block.data(), block.size());
    text.append(block.data(), std::size_t(std::max<ssize_t>(size, 0)));
    return size > 0 || (size < 0 && errno == EINTR);
}

struct Pipe {
    std::array<int, 2> ends{-1, -1};

    Pipe()
    {
        if (pipe2(ends.data(), O_CLOEXEC) != 0) {
            throw FileError(fmt::format("cannot open a pipe: {}.", std::strerror(errno)));
        }
    }
    ~Pipe()
    {
        close(ends[0]);
        close_entrance();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int exit() const { return ends[0]; }
    int entrance() const { return ends[1]; }
    void close_entrance()
    {
        if (ends[1] >= 0) {
            close(std::exchange(ends[1], -1));
        }
    }
};

/// A file in memory.
class Input {
public:
    explicit Input(const std::string& text) : descriptor_(memfd_create("input", MFD_CLOEXEC))
    {
        if (descriptor_ < 0 ||
            write(descriptor_, text.data(), text.size()) != ssize_t(text.size())) {
            throw FileError(fmt::format("cannot hand over a job: {}.", std::strerror(errno)));
        }
        lseek(descriptor_, 0, SEEK_SET);
    }
    ~Input() { close(descriptor_); }
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

pid_t start(const std::vector<std::string>& arguments, const Input& input, const Pipe& output,
            const Pipe& errors)
{
    posix_spawn_file_actions_t redirections;
    posix_spawn_file_actions_init(&redirections);
    posix_spawn_file_actions_adddup2(&redirections, input.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&redirections, output.entrance(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&redirections, errors.entrance(), STDERR_FILENO);
    std::string name = "overturn";
    std::vector<char*> words{name.data()};
    for (const std::string& argument : arguments) {
        words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    constexpr const char* self = "/proc/self/exe"; // also if it was replaced meanwhile
    pid_t child = 0;
    const int fault = posix_spawn(&child, self, &redirections, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&redirections);
    if (fault != 0) {
        throw FileError(fmt::format("cannot start another process of overturn by {}: {}.", self,
                                    std::strerror(fault)));
    }
    return child;
}

} // namespace

void end_with_parent()
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
}

int read_apart(const std::string& path, const std::function<int()>& read)
{
    expect_children();
    std::fflush(nullptr); // what is in a buffer would be printed twice
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) {
        throw FileError(
            fmt::format("cannot start a process to read \"{}\": {}.", path, std::strerror(errno)));
    }
    if (child == 0) {
        prepare_to_crash(path);
        if (getppid() != parent) {
            _exit(exit_code::internal); // nobody is waiting any more
        }
        const int code = call(read);
        _exit(std::fflush(stdout) == 0 ? code
                                       : complain(FileError("cannot write what was found.")));
    }
    const int status = wait_for(child);
    if (WIFEXITED(status)) {
        return WEXITSTATUS(status);
    }
    const int signal = WTERMSIG(status);
    if (signal == SIGKILL) {
        throw FileError(fmt::format("the process that read \"{}\" was killed, perhaps for want of "
                                    "memory.",
                                    path));
    }
    if (std::find(crashes.begin(), crashes.end(), signal) == crashes.end()) {
        std::signal(signal, SIG_DFL); // whoever ended the child meant us
        raise(signal);
    }
    throw FileError(fmt::format(
        "\"{}\" is damaged: the HDF5 library {}.", path,
        signal == SIGXCPU ? "does not come to an end with it"
                          : fmt::format("crashes when it reads it ({})", strsignal(signal))));
}

Answer ask_overturn(const std::vector<std::string>& arguments,
                    const std::function<bool()>& is_unwanted, const std::string& input)
{
    expect_children();
    Pipe output;
    Pipe errors;
    const pid_t child = start(arguments, Input(input), output, errors);
    output.close_entrance();
    errors.close_entrance();
    std::string printed;
    std::string complained;
    std::array<pollfd, 2> ends{pollfd{output.exit(), POLLIN, 0}, pollfd{errors.exit(), POLLIN, 0}};
    const std::array<std::string*, 2> texts{&printed, &complained};
    constexpr int look_every = 50; // [ms]
    bool unwanted = false;
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        if (!unwanted && is_unwanted()) {
            unwanted = true;
            kill(child, SIGKILL);
        }
        if (poll(ends.data(), ends.size(), look_every) <= 0) {
            continue;
        }
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (ends[i].revents != 0 && !take(ends[i].fd, *texts[i])) {
                ends[i].fd = -1; // poll leaves it out
            }
        }
    }
    const int status = wait_for(child);
    Answer answer{.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : exit_code::internal,
                  .output = std::move(printed),
                  .complaint = complaint_in(complained, status)};
    if (!WIFEXITED(status) && (unwanted || is_unwanted())) {
        answer.exit_code = exit_code::stopped; // a signal to all of a job was meant for us, too
    }
    return answer;
}

} // namespace overturn
