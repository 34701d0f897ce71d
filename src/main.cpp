#include "commands/command_line.hpp"
#include "commands/exit_code.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/sweep/sweep_tile.hpp"

int main(int argc, char** argv)
{
    using namespace overturn;
    // Under a launcher only rank 0 prints messages and executes the commands that are not parallel.
    // The other ranks return 0: if they returned an error, a launcher might kill rank 0 before it
    // prints.
    const bool leads = launched_rank() == 0;
    keep_freed_memory();
    try {
        const Command command = read_command_line(argc, argv);
        return leads || command.on_every_rank ? command.execute() : exit_code::complete;
    } catch (const std::exception& error) {
        return leads ? complain(error) : exit_code::complete;
    }
}
