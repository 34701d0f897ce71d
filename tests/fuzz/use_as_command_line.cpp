#include "hostile_input.hpp"

#include "commands/command_line.hpp"
#include "commands/commands.hpp"
#include "overturn/text/error.hpp"

#include <stdexcept>
#include <vector>

namespace overturn {

namespace {

[[noreturn]] int refuse_to_run()
{
    throw std::logic_error("parsing a command line has run a command");
}

} // namespace

// The parser needs names of commands; none is executed here.
int run(const RunOptions&)
{
    refuse_to_run();
}
int merge(const MergeOptions&)
{
    refuse_to_run();
}
int check(const CheckOptions&)
{
    refuse_to_run();
}
int accuracy(const AccuracyOptions&)
{
    refuse_to_run();
}
int history(const HistoryOptions&)
{
    refuse_to_run();
}
int topple(const ToppleOptions&)
{
    refuse_to_run();
}
int assess(const AssessOptions&)
{
    refuse_to_run();
}
int keys(const KeysOptions&)
{
    refuse_to_run();
}
int info(const InfoOptions&)
{
    refuse_to_run();
}
int verify(const std::string&)
{
    refuse_to_run();
}
int doctor(const std::string&)
{
    refuse_to_run();
}

Response use_as_command_line(std::string_view bytes)
{
    std::vector<std::string> words{"overturn"};
    while (!bytes.empty()) {
        const std::string_view line = bytes.substr(0, bytes.find('\n'));
        words.emplace_back(line.substr(0, line.find('\0'))); // an argument ends at a null
        bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    }
    std::vector<const char*> arguments;
    for (const std::string& word : words) {
        arguments.push_back(word.c_str());
    }
    const int count = int(arguments.size());
    arguments.push_back(nullptr); // as for main()
    try {
        const Command command = read_command_line(count, arguments.data());
        return command.execute ? Response::accepted
                               : throw std::logic_error("a command has nothing to execute");
    } catch (const Error&) {
        return Response::refused;
    }
}

} // namespace overturn
