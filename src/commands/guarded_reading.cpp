#include "guarded_reading.hpp"

#include "overturn/text/quoting.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/text/error.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

namespace overturn {

namespace {

constexpr std::array fatal_signals{SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPROF};

/// What the handler needs, prepared because it may neither allocate nor format.
struct HandlerData {
    std::array<std::string, fatal_signals.size()> messages; ///< in the order of `fatal_signals`
    std::string lock;
};
HandlerData handler_data;

/// What the destructor restores.
struct Replaced {
    std::array<struct sigaction, fatal_signals.size()> actions;
    stack_t stack;
    rlimit data;
};
Replaced replaced;

std::array<char, std::size_t(1) << 18> stack_of_handler; // for stack overflows

extern "C" void print_and_exit(int signal)
{
    const auto* const found = std::find(fatal_signals.begin(), fatal_signals.end(), signal);
    const std::string& message = handler_data.messages[std::size_t(found - fatal_signals.begin())];
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
    unlink(handler_data.lock.c_str());
    end_all_ranks(exit_code::output);
}

/// The private memory of the process, as RLIMIT_DATA counts it [bytes].
rlim_t data_in_use()
{
    std::ifstream pages("/proc/self/statm"); // size, resident, shared, text, 0, data and stack
    rlim_t count = 0;
    for (int column = 0; column < 6; ++column) {
        pages >> count;
    }
    return count * rlim_t(sysconf(_SC_PAGESIZE));
}

void limit_processor_time(rlim_t seconds)
{
    const itimerval time{.it_interval = {}, .it_value = {.tv_sec = time_t(seconds), .tv_usec = 0}};
    setitimer(ITIMER_PROF, &time, nullptr);
}

} // namespace

GuardedReading::GuardedReading(const std::string& path, const std::string& lock,
                               std::uint64_t more_bytes)
{
    for (std::size_t i = 0; i < fatal_signals.size(); ++i) {
        handler_data.messages[i] =
            fmt::format("overturn: \"{}\" is damaged: the HDF5 library {}.\n", printable(path),
                        fatal_signals[i] == SIGPROF ? "does not finish reading it in time"
                                                    : fmt::format("crashes while reading it ({})",
                                                                  strsignal(fatal_signals[i])));
    }
    handler_data.lock = lock;
    const stack_t stack{
        .ss_sp = stack_of_handler.data(), .ss_flags = 0, .ss_size = stack_of_handler.size()};
    sigaltstack(&stack, &replaced.stack);
    struct sigaction action = {};
    action.sa_handler = print_and_exit;
    action.sa_flags = SA_ONSTACK | SA_NODEFER; // MPI may crash in the handler
    for (std::size_t i = 0; i < fatal_signals.size(); ++i) {
        sigaction(fatal_signals[i], &action, &replaced.actions[i]);
    }

    std::error_code none;
    const std::uintmax_t found = std::filesystem::file_size(path, none);
    const rlim_t bytes = (none ? 0 : rlim_t(found)) + more_bytes;
    limit_processor_time(60 + 60 * (bytes >> 30));
    getrlimit(RLIMIT_DATA, &replaced.data);
#ifndef __SANITIZE_ADDRESS__ // which reserves terabytes of address space at the start
    const rlim_t most = data_in_use() + (rlim_t(1) << 29) + 2 * bytes;
    const rlimit data{std::min(most, replaced.data.rlim_cur), replaced.data.rlim_max};
    setrlimit(RLIMIT_DATA, &data);
#endif
}

GuardedReading::~GuardedReading()
{
    setrlimit(RLIMIT_DATA, &replaced.data);
    limit_processor_time(0);
    for (std::size_t i = 0; i < fatal_signals.size(); ++i) {
        sigaction(fatal_signals[i], &replaced.actions[i], nullptr);
    }
    sigaltstack(&replaced.stack, nullptr);
}

} // namespace overturn
