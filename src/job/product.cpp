#include "overturn/job/job.hpp"

namespace overturn {

Job boundary_of(Job spectrum)
{
    Job job = std::move(spectrum);
    job.product = Product::boundary;
    job.scan = job.plane.amplitude;
    job.plane.amplitude = Axis(AxisRange{0, double(most_crossings - 1), most_crossings});
    job.fields.assign(boundary_fields.begin(), boundary_fields.end());
    return job;
}

Tiling tiling_of(const Job& job)
{
    // A line of a boundary takes longer than a tile of a spectrum: some 10 ms, and many times that
    // where a slow pulse lets blocks bounce on and on.
    constexpr std::int64_t lines = 1;
    return job.product == Product::boundary ? Tiling(job.plane, most_crossings, lines)
                                            : Tiling(job.plane);
}

} // namespace overturn
