#include "overturn/job/job.hpp"

#include "read_plane.hpp"
#include "resolved_text.hpp"

#include <fmt/format.h>

namespace overturn {

Job boundary_of(Job job)
{
    if (job.plane.amplitude.size() == 1) {
        throw JobError(fmt::format("plane.amplitude has one value, {}, and flips are looked for "
                                   "between the first and the last. Give two or more.",
                                   job.plane.amplitude.first()));
    }
    job.product = Product::boundary;
    job.resolved = resolved_text(job);
    job.scan = job.plane.amplitude;
    job.plane.amplitude = Axis(AxisRange{0, double(most_crossings - 1), most_crossings});
    job.fields.assign(boundary_fields.begin(), boundary_fields.end());
    // A spectrum of two amplitudes may have a boundary of 64 crossings that is too large.
    if (const PlaneSize size = size_of(job.plane, job.fields); size.bytes > most_bytes) {
        throw JobError(fmt::format("plane has {:.4g} lines of one frequency, restitution and "
                                   "slenderness, whose boundaries would take {:.4g} bytes; {:.4g} "
                                   "can be addressed. Lower the counts.",
                                   size.points / most_crossings, size.bytes, most_bytes));
    }
    return job;
}

Tiling tiling_of(const Job& job)
{
    // A line of a boundary takes longer than a tile of a spectrum: some 10 ms, and many times that
    // where a slow pulse lets blocks bounce on and on.
    constexpr std::int64_t lines = 1;
    return job.product == Product::boundary ? Tiling(shape_of(job.plane), most_crossings, lines)
                                            : Tiling(job.plane);
}

} // namespace overturn
