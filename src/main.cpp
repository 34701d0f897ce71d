#include "commands/command_line.hpp"
#include "commands/report/print.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/error.hpp"

#include <cstdio>

int main(int argc, char** argv)
{
    using namespace overturn;
    // Under a launcher only rank 0 prints messages and executes the commands that are not parallel.
    // The other ranks return 0: if they returned an error, a launcher might kill rank 0 before it
    // prints.
    const bool is_rank_0 = launched_rank() == 0;
    keep_freed_memory();
    try {
        const Command command = read_command_line(argc, argv);
        if (!is_rank_0 && !command.on_every_rank) {
            return exit_code::complete;
        }
        const int code = command.execute();
        if (code == exit_code::complete && !command.on_every_rank &&
            (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) {
            throw Error(exit_code::output, "cannot write to stdout.");
        }
        return code;
    } catch (const std::exception& error) {
        return is_rank_0 ? print_error(error) : exit_code::complete;
    }
}
