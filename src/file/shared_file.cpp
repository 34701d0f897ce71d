// Whether all ranks can open a file by its path, and have the same file under it.
#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "system_reason.hpp"

#include "overturn/file/spectrum_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <random>
#include <unistd.h>

namespace overturn {

namespace {

using hdf5::Handle;

/// What rank 0 writes for the others to read.
struct Token {
    std::uint64_t number = 0;
    std::int64_t place = 0; ///< in the file [byte]
};

std::int64_t place_of_token(const std::string& path)
{
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, hdf5::file_access()), H5Fclose);
    const Handle dataset(H5Dopen2(file, layout::run_token, H5P_DEFAULT), H5Dclose);
    const haddr_t place = H5Dget_offset(dataset);
    if (place == HADDR_UNDEF) {
        throw hdf5::Hdf5Error("the random number of a run has no place in it");
    }
    return std::int64_t(place);
}

bool write(const std::string& path, const Token& token)
{
    const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    const bool written = pwrite(descriptor, &token.number, sizeof token.number, token.place) ==
                         ssize_t(sizeof token.number);
    return close(descriptor) == 0 && written; // over NFS other hosts see it once it is closed
}

bool holds(const std::string& path, const Token& token)
{
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    std::uint64_t found = 0;
    const bool read = pread(descriptor, &found, sizeof found, token.place) == ssize_t(sizeof found);
    if (descriptor >= 0) {
        close(descriptor);
    }
    return read && found == token.number;
}

} // namespace

void demand_path_for_mpi([[maybe_unused]] const std::string& path)
{
#ifndef OMPI_MAJOR_VERSION // MPICH and its relatives read files by ROMIO
    if (path.find(':') != std::string::npos) {
        throw FileError(
            fmt::format("\"{}\" has a colon, and this MPI library takes what precedes it "
                        "for a type of file system. Choose another path with -o.",
                        path));
    }
#endif
}

std::vector<int> ranks_with_another_file(const std::string& path, MPI_Comm communicator)
{
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &ranks);
    Token token;
    const auto demand = [&](bool success) {
        if (!success) {
            throw FileError(
                fmt::format("cannot open \"{}\" for writing: {}.", path, system_reason(errno)));
        }
    };
    if (rank == 0) {
        try {
            std::random_device random;
            token = {random() + (std::uint64_t(random()) << 32), place_of_token(path)};
        } catch (const hdf5::Hdf5Error& error) {
            throw FileError(fmt::format("cannot open \"{}\": {}.", path, error.what()));
        }
        demand(write(path, token));
    }
    MPI_Bcast(&token, int(sizeof token), MPI_BYTE, 0, communicator);
    const int is_same = rank == 0 || holds(path, token);
    std::vector<int> same(std::size_t(rank == 0 ? ranks : 0));
    MPI_Gather(&is_same, 1, MPI_INT, same.data(), 1, MPI_INT, 0, communicator);
    std::vector<int> others;
    if (rank == 0) {
        demand(write(path, {.number = 0, .place = token.place}));
        for (int other = 0; other < ranks; ++other) {
            if (!same[std::size_t(other)]) {
                others.push_back(other);
            }
        }
    }
    return others;
}

} // namespace overturn
