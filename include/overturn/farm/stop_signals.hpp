// The polite ways to stop a run: SIGUSR1 (a batch system's warning), SIGTERM, SIGINT and SIGHUP
// (the terminal is gone) raise a flag; the ranks finish the tile in hand, if it takes no longer
// than half a second. A second SIGINT ends the process at once.
#pragma once

namespace overturn {

/// Listens for the signals from construction to destruction; not for SIGHUP where the process was
/// started to ignore it, as by nohup. One at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// Whether a signal came since construction.
    static bool requested();

    /// Whether a signal came, and half a second has passed since this was asked first after it:
    /// what is in hand had better be dropped.
    static bool overdue();
};

} // namespace overturn
