#include "overturn/farm/mpi_session.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <poll.h>
#include <span>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace overturn {

namespace {

/// The rank, as set by mpirun of Open MPI, by launchers with PMIx, and by those with PMI.
constexpr const char* rank_variables[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};

/// The number of ranks that they started; srun sets the last one for every MPI.
constexpr const char* size_variables[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE",
                                          "SLURM_STEP_NUM_TASKS"};

const char* first_of(std::span<const char* const> variables)
{
    for (const char* variable : variables) {
        if (const char* value = std::getenv(variable)) {
            return value;
        }
    }
    return nullptr;
}

/// Settings of Open MPI 4.1, which other libraries ignore. The user's settings have priority.
void prepare_open_mpi()
{
    constexpr int keep = 0;
    constexpr int replace = 1;
    // overturn uses no shared file pointers. Two of the components for them create and remove
    // OUT.h5.locktest.0, OUT.h5.data.0, ... even if unrelated files have these names, and the first
    // one overflows a buffer at paths of 245 bytes or more. The third one stays: with none, no file
    // can be opened.
    setenv("OMPI_MCA_sharedfp", "^lockedfile,individual", replace);
    const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (first_of(rank_variables) == nullptr) {
        // A single rank sends no messages. It starts in 0.01 s instead of 0.33 s if it forks no
        // daemon and opens no network.
        setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
        setenv("OMPI_MCA_pml", "ob1", keep);
        setenv("OMPI_MCA_btl", "self", keep);
        // Otherwise several such runs share a session folder, and one fails if it creates the
        // folder while another removes it. Nothing is stored there.
        setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
    } else if (here != nullptr && all != nullptr && std::string_view(here) == all) {
        // Ranks on one host communicate through its memory. They start in 0.1 s instead of 0.3 s if
        // they open no network.
#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION == 4 // elsewhere "vader" has another name
        setenv("OMPI_MCA_pml", "ob1", keep);
        setenv("OMPI_MCA_btl", "self,vader", keep);
#endif
    }
}

/// Waits without occupying a core. MPI's own waiting spins, which takes the core from ranks that
/// compute if there are more ranks than cores.
void wait_for(MPI_Request& request)
{
    int arrived = 0;
    while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), !arrived) {
        std::this_thread::sleep_for(polling_interval);
    }
}

volatile std::sig_atomic_t exit_code_of_abort = 0;

extern "C" void exit_now(int)
{
    _exit(exit_code_of_abort);
}

} // namespace

int launched_rank()
{
    const char* rank = first_of(rank_variables);
    return rank == nullptr ? 0 : std::atoi(rank);
}

MpiSession::MpiSession()
{
    int initialized = 0;
    MPI_Initialized(&initialized);
    finalizes_ = initialized == 0;
    if (finalizes_) {
        prepare_open_mpi();
        // MPICH handles SIGUSR1 as the notice of a failed rank, and contacts the launcher; without
        // a launcher it waits forever. Here the signal means a stop.
        struct sigaction before = {};
        sigaction(SIGUSR1, nullptr, &before);
        int provided = MPI_THREAD_SINGLE;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SINGLE, &provided);
        sigaction(SIGUSR1, &before, nullptr);
    }
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator_);
    MPI_Comm_rank(communicator_, &rank_);
    MPI_Comm_size(communicator_, &size_);
    // If the launcher belongs to another MPI, each process would be the only rank and compute
    // everything.
    const char* started = first_of(size_variables);
    if (started != nullptr && std::atoi(started) != size_) {
        leave();
        throw Error(
            exit_code::usage,
            "the launcher started {} processes, but MPI found {}. Use the mpirun of the MPI "
            "that this program was built with, or srun --mpi=pmix.",
            started, size_);
    }
    using Name = std::array<char, MPI_MAX_PROCESSOR_NAME>;
    Name own{}; // its zeros end the name
    int length = 0;
    MPI_Get_processor_name(own.data(), &length);
    host_ = own.data();
    hosts_ =
        mapped(gather_on_rank_0(own), [](const Name& name) { return std::string(name.data()); });
}

void MpiSession::leave()
{
    MPI_Comm_free(&communicator_);
    if (finalizes_) {
        MPI_Finalize();
    }
}

void MpiSession::broadcast(void* bytes, std::size_t size) const
{
    constexpr std::size_t most_at_once = std::size_t(1) << 30; // MPI counts in int
    for (std::size_t sent = 0; sent < size; sent += most_at_once) {
        const std::size_t block = std::min(size - sent, most_at_once);
        MPI_Request arriving = MPI_REQUEST_NULL;
        MPI_Ibcast(static_cast<char*>(bytes) + sent, int(block), MPI_BYTE, 0, communicator_,
                   &arriving);
        wait_for(arriving); // rank 0 may have to read gigabytes first
    }
}

void MpiSession::gather(const void* bytes, void* all, std::size_t size) const
{
    MPI_Request gathering = MPI_REQUEST_NULL;
    MPI_Igather(bytes, int(size), MPI_BYTE, all, int(size), MPI_BYTE, 0, communicator_, &gathering);
    wait_for(gathering); // workers are done with their tiles before rank 0
}

std::string MpiSession::from_rank_0(std::string text) const
{
    text.resize(from_rank_0(text.size()));
    broadcast(text.data(), text.size());
    return text;
}

void MpiSession::abort(int exit_code, const std::string& message) const
{
    std::fprintf(stderr, "rank %d: %s\n", rank_, message.c_str());
    std::fflush(nullptr);
    end_all_ranks(exit_code);
}

void end_all_ranks(int exit_code)
{
    // MPI_Abort of MPICH 4.0 waits forever for a rank that is suspended; the launcher ends all
    // ranks once one has exited. With MPICH, a mere exit would give the code of a killed rank.
    constexpr unsigned grace = 5; // [s]
    exit_code_of_abort = exit_code;
    for (const int signal : {SIGALRM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) {
        std::signal(signal, exit_now);
    }
    alarm(grace);
    int initialized = 0;
    int size = 1;
    MPI_Initialized(&initialized);
    if (initialized != 0) {
        MPI_Comm_size(MPI_COMM_WORLD, &size);
    }
    if (size > 1) {
        // The launcher of MPICH may drop messages that it has not read when the ranks end.
        constexpr int time_to_read = 200; // [ms]
        poll(nullptr, 0, time_to_read);   // waits; allowed in signal handlers
        MPI_Abort(MPI_COMM_WORLD, exit_code);
    }
    _exit(exit_code);
}

} // namespace overturn
