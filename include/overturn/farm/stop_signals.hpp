// The polite ways to stop a run: SIGUSR1 (a batch system's warning), SIGTERM and SIGINT raise a
// flag; the ranks finish the tile in hand. A second SIGINT ends the process at once.
#pragma once

namespace overturn {

/// Listens for the signals from construction to destruction. One at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// Whether a signal came since construction.
    static bool requested();
};

} // namespace overturn
