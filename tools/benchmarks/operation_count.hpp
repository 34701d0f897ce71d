// Counts the floating-point operations of overturn's kernels: computes the forced stage and the
// region of every point with a number type that counts its operations.
#pragma once

#include "peer.hpp"

namespace overturn::benchmarks {

/// Operations of single lanes. Not counted: lanes that wait for their neighbours, comparisons,
/// selections, absolute values and changes of sign.
struct Operations {
    std::int64_t fused = 0;   ///< multiply-adds rounded once
    std::int64_t plain = 0;   ///< additions, subtractions, multiplications
    std::int64_t divided = 0; ///< divisions and square roots
};

struct OperationCount {
    Operations operations; ///< of all points together
    int ends_that_differ;  ///< in any bit from the ends computed by the kernel
};

OperationCount count_operations(const PeerProblem& problem, const Numerics& numerics);

} // namespace overturn::benchmarks
