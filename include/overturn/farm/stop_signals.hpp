// The signals that stop a run: SIGUSR1 (the warning of a batch system), SIGTERM, SIGINT and SIGHUP
// (the terminal was closed) set a flag, and the ranks finish the current tile if that takes no
// longer than half a second. A second SIGINT ends the process at once.
#pragma once

namespace overturn {

/// Handles the signals from construction to destruction, but not SIGHUP if the process was started
/// with SIGHUP ignored, as by nohup. After destruction, SIGUSR1 is ignored. One object at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// Whether a signal was received since construction.
    static bool requested();

    /// Whether a signal was received, and half a second has passed since the first call after it:
    /// the current tile is to be dropped.
    static bool overdue();
};

} // namespace overturn
