// A scratch folder shared by all ranks of MPI_COMM_WORLD. Creation and removal are collective.
#pragma once

#include "support/scratch_folder.hpp"

#include <mpi.h>

#include <optional>
#include <string>

namespace overturn {

class SharedScratchFolder {
public:
    SharedScratchFolder()
    {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        if (rank == 0) {
            path_ = mine_.emplace() / "";
        }
        auto length = int(path_.size());
        MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
        path_.resize(std::size_t(length));
        MPI_Bcast(path_.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
    }
    ~SharedScratchFolder() { MPI_Barrier(MPI_COMM_WORLD); }
    SharedScratchFolder(const SharedScratchFolder&) = delete;
    SharedScratchFolder& operator=(const SharedScratchFolder&) = delete;

    std::string operator/(const std::string& name) const { return path_ + name; }

private:
    std::optional<ScratchFolder> mine_;
    std::string path_;
};

} // namespace overturn
