#include "overturn/farm/stop_signals.hpp"

#include <chrono>
#include <csignal>
#include <initializer_list>
#include <optional>

namespace overturn {

namespace {

volatile std::sig_atomic_t stop_flag = 0; // the only thing that a signal handler may write
std::optional<std::chrono::steady_clock::time_point> noticed;
constexpr std::chrono::seconds patience{1};

extern "C" void raise_stop_flag(int)
{
    stop_flag = 1;
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
    // Restart: a write of a tile must not fail because a signal came.
    listen(SIGUSR1, raise_stop_flag, SA_RESTART);
    listen(SIGTERM, raise_stop_flag, SA_RESTART);
    listen(SIGINT, raise_stop_flag, SA_RESTART | int(SA_RESETHAND));
}

StopSignals::~StopSignals()
{
    for (const int signal : {SIGUSR1, SIGTERM, SIGINT}) {
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
