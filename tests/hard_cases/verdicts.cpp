#include "verdicts.hpp"

#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>

namespace overturn {

namespace {

constexpr std::uint8_t why_undecided =
    status::cap_was_hit | status::not_finite | status::unresolved;

std::string description(const HardCase& point, const Numerics& numerics, const Outcome& outcome)
{
    std::ostringstream text;
    text << point << "\n  " << name_of(numerics.method) << " at " << numerics.tolerance
         << (numerics.resolve ? ", resolved" : "") << ": region " << int(outcome.region)
         << ", margin " << outcome.margin << " +- " << outcome.error << ", angle " << outcome.angle
         << ", velocity " << outcome.velocity << ", impacts " << outcome.impacts << ", steps "
         << outcome.steps << ", status " << int(outcome.status);
    return text.str();
}

bool is_decided(const Outcome& outcome)
{
    return outcome.region != Region::undecided;
}

void expect_well_formed(const Outcome& outcome, const Allowance& allowed)
{
    EXPECT_GE(outcome.error, 0); // false for NaN, too
    EXPECT_LE(outcome.steps, allowed.most_steps);
    if (is_decided(outcome)) {
        EXPECT_LE(outcome.region, Region::F_minus);
        EXPECT_EQ(outcome.status & why_undecided, 0);
        EXPECT_TRUE(std::isfinite(outcome.angle));
        EXPECT_TRUE(std::isfinite(outcome.velocity));
        EXPECT_TRUE(std::isfinite(outcome.margin));
        EXPECT_EQ(is_safe(outcome.region), outcome.margin >= 0);
    } else {
        EXPECT_NE(outcome.status & why_undecided, 0);
        if (outcome.status & (status::cap_was_hit | status::not_finite)) {
            EXPECT_TRUE(std::isinf(outcome.error));
        }
    }
}

/// Whether the verdict of the run is certain.
bool is_sure(const Outcome& outcome, const Numerics& numerics)
{
    return is_decided(outcome) && (numerics.resolve || std::abs(outcome.margin) > outcome.error);
}

void check(const HardCase& point, const Numerics& numerics, const Outcome& outcome,
           std::optional<bool> safe, const Allowance& allowed)
{
    SCOPED_TRACE(description(point, numerics, outcome));
    expect_well_formed(outcome, allowed);
    EXPECT_TRUE(is_decided(outcome) || (numerics.resolve ? allowed.unresolved : allowed.undecided));
    if (safe && is_sure(outcome, numerics)) {
        EXPECT_EQ(is_safe(outcome.region), *safe);
    }
}

std::optional<bool> verdict_of(const Truth& truth)
{
    return truth.settled ? std::optional(is_safe(truth.region)) : std::nullopt;
}

} // namespace

Outcome outcome_of(const HardCase& point, const Numerics& numerics)
{
    const Problem problem{
        .scene = {.motion = Pulse{point.pulse, {.window = point.window}}, .theory = point.theory},
        .grid = grid_of_point(point),
        .numerics = numerics,
        .fields = {Field::region, Field::angle, Field::velocity, Field::margin, Field::error,
                   Field::impacts, Field::steps, Field::status}};
    const auto values = compute_tile(problem, tiling_of(problem)[0], widest_kernel()).values;
    const auto number = [&](std::size_t i) { return std::get<std::vector<double>>(values[i])[0]; };
    return {.region = Region(std::get<std::vector<std::uint8_t>>(values[0])[0]),
            .angle = number(1),
            .velocity = number(2),
            .margin = number(3),
            .error = number(4),
            .impacts = std::get<std::vector<std::uint16_t>>(values[5])[0],
            .steps = std::get<std::vector<std::uint32_t>>(values[6])[0],
            .status = std::get<std::vector<std::uint8_t>>(values[7])[0]};
}

std::vector<Numerics> plain_numerics()
{
    std::vector<Numerics> all;
    for (const Method method : {Method::rk45, Method::taylor}) {
        for (const double tolerance : {1e-4, 1e-9, 1e-12}) {
            all.push_back({.method = method, .tolerance = tolerance});
        }
    }
    return all;
}

std::vector<Numerics> resolving_numerics()
{
    return {{.method = Method::rk45, .tolerance = 1e-4, .resolve = true},
            {.method = Method::taylor, .tolerance = 1e-4, .resolve = true},
            {.method = Method::rk45, .tolerance = 1e-9, .resolve = true}};
}

Outcome expect_right_verdict(const HardCase& point, const Numerics& numerics, const Truth& truth,
                             const Allowance& allowed)
{
    const Outcome outcome = outcome_of(point, numerics);
    check(point, numerics, outcome, verdict_of(truth), allowed);
    return outcome;
}

Truth expect_right_verdicts(const HardCase& point, const Allowance& allowed)
{
    const Truth truth = truth_of(point);
    std::optional<bool> safe = verdict_of(truth);
    for (const auto& all : {plain_numerics(), resolving_numerics()}) {
        for (const Numerics& numerics : all) {
            const Outcome outcome = outcome_of(point, numerics);
            check(point, numerics, outcome, safe, allowed);
            if (!safe && is_sure(outcome, numerics)) {
                safe = is_safe(outcome.region); // the others must agree
            }
        }
    }
    return truth;
}

} // namespace overturn
