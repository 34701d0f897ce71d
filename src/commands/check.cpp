// What a job would compute, store and cost. Writes nothing.
#include "commands.hpp"
#include "estimate.hpp"
#include "exit_code.hpp"
#include "human_units.hpp"
#include "print_row.hpp"
#include "printable.hpp"

#include "overturn/file/spectrum_file.hpp"
#include "overturn/job/job.hpp"

#include <fmt/format.h>

namespace overturn {

namespace {

std::string axis_text(const Axis& axis, std::string_view unit = "")
{
    if (axis.size() == 1) {
        return fmt::format("{}{}", axis.first(), unit);
    }
    return fmt::format("{} values from {} to {}{}", axis.size(), axis.first(), axis.last(), unit);
}

void print_scene(const Job& job)
{
    print_row("pulse", name_of(job.scene.pulse));
    if (has_window(job.scene.pulse)) {
        print_row("window",
                  fmt::format("-{0} to {0} pulse periods, cut off at {1:.2g} % of the peak",
                              job.scene.window, 100 * cut_by_window(job.scene)));
    }
    print_row("theory", name_of(job.scene.theory));
    print_row("method", fmt::format("{}, tolerance {}{}", name_of(job.numerics.method),
                                    job.numerics.tolerance,
                                    job.numerics.resolve ? ", verdicts resolved" : ""));
}

void print_plane(const Plane& plane)
{
    print_row("frequency", axis_text(plane.frequency));
    print_row("amplitude", axis_text(plane.amplitude));
    print_row("restitution",
              axis_text(plane.restitution) +
                  (plane.restitution_of == RestitutionOf::maximum ? ", of the maximum" : ""));
    print_row("slenderness", axis_text(plane.slenderness, " rad"));
}

void print_size(const Job& job)
{
    const Tiling tiling(job.plane);
    const auto points = double(job.plane.points());
    print_row("points", fmt::format("{} in {} {}", human_count(points), tiling.size(),
                                    noun_of(double(tiling.size()), "tiles")));
    for (const Field field : job.fields) {
        print_row("field", fmt::format("{}, {}", name_of(field),
                                       human_bytes(points * double(bytes_per_point(field)))));
    }
    print_row("file", human_bytes(double(spectrum_file_bytes(job, tiling))));
}

} // namespace

int check(const JobSource& source)
{
    const Kernel kernel = widest_kernel(); // throws if this processor has none
    const Job job = read_job(source.path, source.overrides);
    if (!job.title.empty()) {
        fmt::print("{}\n\n", printable(job.title));
    }
    print_scene(job);
    print_plane(job.plane);
    print_size(job);
    print_row("time", fmt::format("about {} on one rank with kernel {}; n ranks on n cores need "
                                  "1/n of it",
                                  human_duration(estimated_seconds(job, kernel)), name_of(kernel)));
    return exit_code::complete;
}

} // namespace overturn
