#include "commands/command_line.hpp"
#include "commands/exit_code.hpp"

#include "overturn/farm/mpi_session.hpp"

int main(int argc, char** argv)
{
    using namespace overturn;
    // A launcher starts many of us, and but for what all ranks do together rank 0 speaks for all.
    // The others end well: seeing a bad end, a launcher may kill rank 0 before it has spoken.
    const bool leads = launched_rank() == 0;
    try {
        const Command command = read_command_line(argc, argv);
        return leads || command.on_every_rank ? command.execute() : exit_code::complete;
    } catch (const std::exception& error) {
        return leads ? complain(error) : exit_code::complete;
    }
}
