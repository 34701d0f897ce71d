// Whether a path names the same file on all ranks.
#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "operating_system.hpp"

#include "overturn/file/spectrum_file.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <random>

namespace overturn {

namespace {

using hdf5::Handle;

/// A random number that rank 0 writes and all ranks read.
struct Token {
    std::uint64_t number = 0;
    std::int64_t place = 0; ///< in the file [byte]
};

std::int64_t place_of_token(const std::string& path)
{
    const Handle file = hdf5::open_to_read(path);
    const Handle dataset = hdf5::open_dataset(file, layout::in_run_group(layout::run_token));
    const haddr_t place = H5Dget_offset(dataset);
    if (place == HADDR_UNDEF) {
        throw hdf5::Hdf5Error("its run_token is not stored");
    }
    return std::int64_t(place);
}

void write(const std::string& path, const Token& token)
{
    errno = 0;
    std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(token.place);
    stream.write(reinterpret_cast<const char*>(&token.number), sizeof token.number);
    stream.close(); // makes the number visible to other hosts over NFS
    if (!stream) {
        throw Error(exit_code::output, "cannot open \"{}\" for writing: {}.", path,
                    system_reason(errno));
    }
}

bool holds(const std::string& path, const Token& token)
{
    std::uint64_t found = 0;
    std::ifstream stream(path, std::ios::binary);
    stream.seekg(token.place);
    stream.read(reinterpret_cast<char*>(&found), sizeof found);
    return stream && found == token.number;
}

} // namespace

void demand_path_for_mpi([[maybe_unused]] const std::string& path)
{
#ifndef OMPI_MAJOR_VERSION // MPICH and its derivatives use ROMIO
    if (path.find(':') != std::string::npos) {
        throw Error(exit_code::output,

                    "\"{}\" has a colon, but this MPI library interprets the text before a colon "
                    "as a type of file system. Choose another path with -o.",
                    path);
    }
#endif
}

std::optional<int> rank_with_another_file(const std::string& path, MPI_Comm communicator)
{
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &ranks);
    Token token;
    if (rank == 0) {
        try {
            std::random_device random;
            token = {random() + (std::uint64_t(random()) << 32), place_of_token(path)};
        } catch (const hdf5::Hdf5Error& error) {
            throw Error(exit_code::output, "cannot open \"{}\": {}.", path, error.what());
        }
        write(path, token);
    }
    MPI_Bcast(&token, int(sizeof token), MPI_BYTE, 0, communicator);
    const int other = holds(path, token) ? ranks : rank;
    int first = ranks;
    MPI_Reduce(&other, &first, 1, MPI_INT, MPI_MIN, 0, communicator);
    if (rank == 0) {
        write(path, {.number = 0, .place = token.place});
    }
    MPI_Bcast(&first, 1, MPI_INT, 0, communicator);
    return first < ranks ? std::optional(first) : std::nullopt;
}

} // namespace overturn
