#include "hostile_input.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/job/job.hpp"
#include "overturn/text/error.hpp"
#include "support/scratch_folder.hpp"
#include "support/untrapped_floating_point.hpp"

#include <fmt/format.h>

#include <vector>

namespace overturn {

namespace {

/// Removes the lines "--set KEY=VALUE" from the beginning.
std::vector<std::string> take_overrides(std::string_view& bytes)
{
    constexpr std::string_view option = "--set ";
    std::vector<std::string> overrides;
    while (bytes.starts_with(option)) {
        const std::string_view line = bytes.substr(0, bytes.find('\n'));
        overrides.emplace_back(line.substr(option.size()));
        bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    }
    return overrides;
}

void use(const Job& job, const std::string& path)
{
    const Problem& problem = job.problem;
    demand(problem.grid.points() > 0 && tiling_of(problem).size() > 0,
           "an accepted job has no points");
    demand(result_bytes(job) > double(problem.grid.points()), "a file is smaller than its values");
    if (const Pulse* pulse = problem.scene.pulse()) {
        cut_by_window(*pulse);
    }
    write_bytes(path, job.resolved);
    const std::string again = read_job(path).resolved;
    demand(again == job.resolved,
           fmt::format("the resolved job\n{}\nis read back as\n{}", job.resolved, again));
    if (problem.grid.axis_or_number(Role::strength)->values.size() > 1 &&
        !problem.product.audit()) {
        demand(items_of(boundary_of(job).problem).count > 0, "a boundary has no lines");
    }
}

} // namespace

Response use_as_job(std::string_view bytes, const std::string& path)
{
    const UntrappedFloatingPoint overflows; // in jobs that are refused because of it
    const std::vector<std::string> overrides = take_overrides(bytes);
    write_bytes(path, std::string(bytes));
    try {
        use(read_job(path, overrides), path);
        return Response::accepted;
    } catch (const Error& error) {
        const std::string message = error.what();
        demand(message.find('\n') == message.npos, "a refusal has more than one line:  " + message);
        return Response::refused;
    }
}

} // namespace overturn
