// The coefficients of Dormand-Prince 5(4) as exact ratios.
// Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19-26.
#pragma once

#include <array>
#include <cstdint>

namespace overturn {

struct Ratio {
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;

    /// Rounded once. Always inlined: kernels must not define functions that the rest of the program
    /// may use.
    template <class S>
    [[gnu::always_inline]] S in() const
    {
        return S(numerator) / S(denominator);
    }
};

struct DormandPrince {
    static constexpr int stages = 7; ///< the last stage of a step is the first of the next

    using Row = std::array<Ratio, stages>;

    static constexpr Row node{{{0}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1}, {1}}};

    /// Stage weights; row 6 holds the weights of the solution of order 5.
    static constexpr std::array<Row, stages> stage{{
        {},
        {{{1, 5}}},
        {{{3, 40}, {9, 40}}},
        {{{44, 45}, {-56, 15}, {32, 9}}},
        {{{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}}},
        {{{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
        {{{35, 384}, {0}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}},
    }};

    /// The solution of order 5 minus the embedded one of order 4.
    static constexpr Row error{
        {{71, 57600}, {0}, {-71, 16695}, {71, 1920}, {-17253, 339200}, {22, 525}, {-1, 40}}};
};

} // namespace overturn
