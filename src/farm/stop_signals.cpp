#include "overturn/farm/stop_signals.hpp"

#include <chrono>
#include <csignal>
#include <optional>

namespace overturn {

namespace {

volatile std::sig_atomic_t stop_flag = 0; // the type that a signal handler may write
std::optional<std::chrono::steady_clock::time_point> first_call; // of overdue() after a signal
constexpr std::chrono::milliseconds time_for_a_tile{500};

extern "C" void set_stop_flag(int)
{
    stop_flag = 1;
}

constexpr int stop_signals[] = {SIGUSR1, SIGTERM, SIGINT, SIGHUP};

bool is_ignored(int signal)
{
    struct sigaction action = {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void handle(int signal, void (*handler)(int), int flags)
{
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

} // namespace

StopSignals::StopSignals()
{
    stop_flag = 0;
    first_call.reset();
    for (const int signal : stop_signals) {
        if (signal == SIGHUP && is_ignored(signal)) {
            continue; // by nohup
        }
        // Restart: a signal must not make the write of a tile fail.
        handle(signal, set_stop_flag, SA_RESTART | (signal == SIGINT ? int(SA_RESETHAND) : 0));
    }
}

StopSignals::~StopSignals()
{
    for (const int signal : stop_signals) {
        // A SIGUSR1 that arrives when a run is complete must not kill it.
        handle(signal, signal == SIGUSR1 ? SIG_IGN : SIG_DFL, 0);
    }
}

bool StopSignals::requested()
{
    return stop_flag != 0;
}

bool StopSignals::overdue()
{
    if (!requested()) {
        return false;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!first_call) {
        first_call = now;
    }
    return now - *first_call >= time_for_a_tile;
}

} // namespace overturn
