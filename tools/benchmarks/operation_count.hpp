// The floating-point operations that overturn's kernels take, counted: the forced stage and the
// region of every point once more, in a number that counts.
#pragma once

#include "peer.hpp"

namespace overturn::benchmarks {

/// Of one lane's own work: lanes that wait for their neighbours, comparisons, selections, absolute
/// values and changes of sign count nothing.
struct Operations {
    std::int64_t fused = 0;   ///< multiply-adds rounded once
    std::int64_t plain = 0;   ///< additions, subtractions, multiplications
    std::int64_t divided = 0; ///< divisions and square roots
};

struct OperationCount {
    Operations operations; ///< of all points together
    int ends_that_differ;  ///< in any bit from those of the product's kernel
};

OperationCount count_operations(const Problem& problem, const Numerics& numerics);

} // namespace overturn::benchmarks
