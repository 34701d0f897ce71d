// A test that fails only on rank 1, as expected by ctest; see CMakeLists.txt.

#include <gtest/gtest.h>
#include <mpi.h>

TEST(MpiTestMain, FailsIfAnyRankFails)
{
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    EXPECT_NE(rank, 1) << "this failure is expected";
}
