#include "counts.hpp"

#include <cmath>
#include <numeric>

namespace overturn {

std::vector<double> acceleration_of_counts(const Lines& lines, std::vector<double> samples,
                                           double acceleration, double counts)
{
    // The sum of integers of up to 30 bits is exact.
    const double mean =
        std::accumulate(samples.begin(), samples.end(), 0.0) / double(samples.size());
    for (double& sample : samples) {
        sample = (sample - mean) * acceleration / counts;
        if (!std::isfinite(sample)) {
            lines.refuse("with {} per {} counts, the accelerations exceed the range of double "
                         "precision. Correct it.",
                         acceleration, counts);
        }
    }
    return samples;
}

} // namespace overturn
