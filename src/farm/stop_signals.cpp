#include "overturn/farm/stop_signals.hpp"

#include <chrono>
#include <csignal>
#include <optional>

namespace overturn {

namespace {

volatile std::sig_atomic_t stop_flag = 0; // the only thing that a signal handler may write
std::optional<std::chrono::steady_clock::time_point> noticed;
constexpr std::chrono::milliseconds patience{500};

extern "C" void raise_stop_flag(int)
{
    stop_flag = 1;
}

constexpr int listened_to[] = {SIGUSR1, SIGTERM, SIGINT, SIGHUP};

bool is_ignored(int signal)
{
    struct sigaction action = {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void listen(int signal, void (*handler)(int), int flags)
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
    noticed.reset();
    for (const int signal : listened_to) {
        if (signal == SIGHUP && is_ignored(signal)) {
            continue; // by nohup
        }
        // Restart: a write of a tile must not fail because a signal came.
        listen(signal, raise_stop_flag, SA_RESTART | (signal == SIGINT ? int(SA_RESETHAND) : 0));
    }
}

StopSignals::~StopSignals()
{
    for (const int signal : listened_to) {
        listen(signal, SIG_DFL, 0);
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
    if (!noticed) {
        noticed = now;
    }
    return now - *noticed >= patience;
}

} // namespace overturn
