#include "overturn/farm/stop_signals.hpp"

#include <csignal>
#include <initializer_list>

namespace overturn {

namespace {

volatile std::sig_atomic_t stop_flag = 0; // the only thing that a signal handler may write

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

} // namespace overturn
