#include "overturn/integrate/tableau.hpp"
#include "overturn/number/digits50.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace overturn {
namespace {

using Table = DormandPrince;
using Vector = std::array<Digits50, Table::stages>;

Digits50 exact(const Ratio& ratio)
{
    return Digits50(ratio.numerator) / ratio.denominator;
}

Vector exact(const Table::Row& row)
{
    Vector result;
    for (std::size_t i = 0; i < row.size(); ++i) {
        result[i] = exact(row[i]);
    }
    return result;
}

Digits50 dot(const Vector& a, const Vector& b)
{
    Digits50 sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

/// The elementwise product a * b.
Vector times(const Vector& a, const Vector& b)
{
    Vector result;
    for (std::size_t i = 0; i < a.size(); ++i) {
        result[i] = a[i] * b[i];
    }
    return result;
}

/// The stage matrix applied to a vector.
Vector stages_of(const Vector& x)
{
    Vector result;
    for (std::size_t i = 0; i < x.size(); ++i) {
        result[i] = dot(exact(Table::stage[i]), x);
    }
    result[6] = dot(exact(Table::stage[6]), x);
    return result;
}

/// Order conditions of Butcher's 17 trees up to order 5: elementary weights and required values.
void expect_order(const Vector& b, int order)
{
    Vector one;
    one.fill(1);
    const Vector c = stages_of(one);
    const Vector c2 = times(c, c);
    const Vector ac = stages_of(c);
    const Vector ac2 = stages_of(c2);
    const Vector aac = stages_of(ac);
    struct Condition {
        int order;
        Vector tree;
        int density;
    };
    const std::vector<Condition> conditions{
        {1, one, 1},
        {2, c, 2},
        {3, c2, 3},
        {3, ac, 6},
        {4, times(c2, c), 4},
        {4, times(c, ac), 8},
        {4, ac2, 12},
        {4, aac, 24},
        {5, times(c2, c2), 5},
        {5, times(c2, ac), 10},
        {5, times(ac, ac), 20},
        {5, times(c, ac2), 15},
        {5, times(c, aac), 30},
        {5, stages_of(times(c2, c)), 20},
        {5, stages_of(times(c, ac)), 40},
        {5, stages_of(ac2), 60},
        {5, stages_of(aac), 120},
    };
    bool holds_at_next = true;
    for (const Condition& condition : conditions) {
        const Digits50 defect = dot(b, condition.tree) - Digits50(1) / condition.density;
        if (condition.order <= order) {
            EXPECT_LT(abs(defect), 1e-47) << "order " << condition.order << ", density "
                                          << condition.density; // round-off of 50 digits
        } else {
            holds_at_next = holds_at_next && abs(defect) < 1e-20;
        }
    }
    if (order < 5) {
        EXPECT_FALSE(holds_at_next);
    }
}

TEST(DormandPrince, EveryRowSumsToItsNode)
{
    Vector one;
    one.fill(1);
    for (std::size_t i = 0; i < Table::stages; ++i) {
        EXPECT_LT(abs(dot(exact(Table::stage[i]), one) - exact(Table::node[i])), 1e-48);
    }
}

TEST(DormandPrince, WeightsSatisfyAllConditionsOfOrderFive)
{
    expect_order(exact(Table::stage[6]), 5);
}

TEST(DormandPrince, EmbeddedWeightsSatisfyThoseOfOrderFourOnly)
{
    Vector embedded = exact(Table::stage[6]);
    const Vector error = exact(Table::error);
    for (std::size_t i = 0; i < embedded.size(); ++i) {
        embedded[i] -= error[i];
    }
    expect_order(embedded, 4);
}

} // namespace
} // namespace overturn
