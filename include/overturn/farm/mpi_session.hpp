// A rank's membership in a run under MPI: from MPI_Init to MPI_Finalize.
// Started by a launcher (mpirun, srun) or alone; alone it is one rank of one.
#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace overturn {

/// The number that a launcher gave this process, without initialising MPI; 0 without a launcher.
int launched_rank();

/// The ranks cannot work together, because of how they were started.
class LaunchError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Initialises MPI and leaves it again; where MPI is initialised already, joins in and leaves it
/// so.
class MpiSession {
public:
    /// Throws LaunchError.
    MpiSession();
    ~MpiSession() { leave(); }
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;

    int rank() const { return rank_; }
    int size() const { return size_; }
    MPI_Comm communicator() const { return communicator_; }

    /// What rank 0 holds, on all ranks; all must call it.
    int from_rank_0(int value) const;
    std::string from_rank_0(std::string text) const;

    /// The host of each rank, on rank 0; nothing elsewhere; all must call it.
    std::vector<std::string> host_names() const;

    /// Prints `rank 7: message` and stops all ranks; the launcher returns the exit code.
    [[noreturn]] void abort(int exit_code, const std::string& message) const;

private:
    void leave();

    MPI_Comm communicator_ = MPI_COMM_NULL; ///< the world's ranks, with messages of their own
    bool finalizes_ = true;
    int rank_ = 0;
    int size_ = 1;
};

/// The MPI library's name and version, such as "Open MPI v4.1.4".
std::string mpi_library();

} // namespace overturn
