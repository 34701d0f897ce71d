// main() of the tests that run on several ranks: every rank runs every test, a failure is printed
// with its rank, and one failing rank fails the program.

#include <gtest/gtest.h>
#include <mpi.h>

#include <iostream>
#include <sstream>

namespace {

class FailuresWithRank : public testing::EmptyTestEventListener {
public:
    explicit FailuresWithRank(int rank) : rank_(rank) {}

    void OnTestPartResult(const testing::TestPartResult& result) override
    {
        if (result.failed()) {
            // In one write, so that the lines of the ranks are not mixed.
            std::ostringstream text;
            text << "rank " << rank_ << ": " << (result.file_name() ? result.file_name() : "?")
                 << ':' << result.line_number() << ": " << result.message() << '\n';
            std::cerr << text.str() << std::flush;
        }
    }

private:
    int rank_;
};

int run_on_this_rank(int rank)
{
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    if (rank != 0) {
        delete listeners.Release(listeners.default_result_printer());
    }
    listeners.Append(new FailuresWithRank(rank));
    const int failed = RUN_ALL_TESTS();
    return failed != 0 || testing::UnitTest::GetInstance()->test_to_run_count() == 0;
}

} // namespace

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);

    // A separate communicator: the messages of a rank that left a test early must not be mixed with
    // these.
    MPI_Comm verdicts = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &verdicts);
    const int failed = run_on_this_rank(rank);
    int failed_ranks = 0;
    MPI_Allreduce(&failed, &failed_ranks, 1, MPI_INT, MPI_SUM, verdicts);
    if (rank == 0 && failed_ranks > 0) {
        std::cerr << "FAILED on " << failed_ranks << " of " << ranks << " ranks" << std::endl;
    }
    MPI_Comm_free(&verdicts);
    MPI_Finalize();
    return failed_ranks > 0 ? 1 : 0;
}
