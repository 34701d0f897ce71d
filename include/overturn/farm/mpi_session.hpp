// The MPI session of this process, from MPI_Init to MPI_Finalize. A process that no launcher
// (mpirun, srun) has started is the only rank.
#pragma once

#include <mpi.h>

#include <chrono>
#include <string>
#include <vector>

namespace overturn {

/// The rank that a launcher gave this process, without initialising MPI; 0 without a launcher.
int launched_rank();

/// Waiting ranks test for messages at this interval and sleep in between.
inline constexpr std::chrono::microseconds polling_interval{50};

/// Initialises and finalises MPI, unless MPI is initialised already.
class MpiSession {
public:
    /// Throws Error.
    MpiSession();
    ~MpiSession() { leave(); }
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;

    int rank() const { return rank_; }
    int size() const { return size_; }
    MPI_Comm communicator() const { return communicator_; }

    /// Returns the value of rank 0 on all ranks. Collective.
    template <class Value>
    Value from_rank_0(Value value) const
    {
        broadcast(&value, sizeof value);
        return value;
    }
    std::string from_rank_0(std::string text) const;

    /// Returns the values of all ranks, by rank, on rank 0; nothing elsewhere. Collective.
    template <class Value>
    std::vector<Value> gather_on_rank_0(const Value& value) const
    {
        std::vector<Value> values(rank_ == 0 ? std::size_t(size_) : 0);
        gather(&value, values.data(), sizeof value);
        return values;
    }

    /// The host of this rank.
    const std::string& host() const { return host_; }

    /// The host of each rank, on rank 0; empty elsewhere.
    const std::vector<std::string>& hosts() const { return hosts_; }

    /// Prints `rank 7: message` and stops all ranks; the launcher returns the exit code.
    [[noreturn]] void abort(int exit_code, const std::string& message) const;

private:
    void broadcast(void* bytes, std::size_t size) const;
    void gather(const void* bytes, void* all, std::size_t size) const;
    void leave();

    MPI_Comm communicator_ = MPI_COMM_NULL; ///< a duplicate of the world
    bool finalizes_ = true;
    int rank_ = 0;
    int size_ = 1;
    std::string host_;
    std::vector<std::string> hosts_;
};

/// Ends all ranks with the exit code. For signal handlers after a crash: if MPI fails or takes
/// longer than 5 s, this process ends, and the launcher ends the others. Without MPI it ends this
/// process.
[[noreturn]] void end_all_ranks(int exit_code);

} // namespace overturn
