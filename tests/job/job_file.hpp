// Jobs for tests.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/problem/coordinates.hpp"
#include "support/refusal.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// The job of a text, whose path in messages is job.toml.
inline Job job_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    return read_job_text(text, "job.toml", overrides);
}

/// The message with which the text is refused; empty if it is accepted.
inline std::string refusal_of(const std::string& text,
                              const std::vector<std::string>& overrides = {})
{
    return refusal(exit_code::job, [&] { job_of(text, overrides); });
}

/// A valid job; the tests of refusals depend on its line numbers.
inline constexpr const char* sound_job = R"(title = "A sound job"
[scene]
pulse = "one_sine"
[plane]
frequency = { first = 0.1, last = 12.0, count = 10 }
amplitude = { values = [0.5, 1.0, 2.0] }
restitution_of_maximum = { values = [0.7, 0.85] }
slenderness = { values = [0.1745716] }
[numerics]
tolerance = 1e-9
[output]
fields = ["region", "angle"]
)";

/// The valid job with one line, counted from 1, replaced by other text.
inline std::string sound_job_with(int line, const std::string& text)
{
    const std::string job = sound_job;
    std::size_t begin = 0;
    for (int i = 1; i < line; ++i) {
        begin = job.find('\n', begin) + 1;
    }
    return job.substr(0, begin) + text + job.substr(job.find('\n', begin));
}

/// The valid job with the older spelling of its restitution.
inline std::string older_job()
{
    return sound_job_with(7, "restitution = { values = [0.7, 0.85], of = \"maximum\" }");
}

/// The given values of a quantity.
inline Axis axis(const Job& job, std::string_view quantity)
{
    const Column* column = job.problem.grid.find(quantity);
    if (column == nullptr) {
        throw std::runtime_error("the grid does not contain " + std::string(quantity));
    }
    return column->values;
}

/// The first value of a coordinate, given or derived.
inline double coordinate(const Job& job, std::string_view name)
{
    return Coordinates(job.problem.scene, job.problem.grid).of(name).first();
}

inline bool gives(const Job& job, std::string_view quantity)
{
    return job.problem.grid.find(quantity) != nullptr;
}

/// The names of the dimensions, slowest first.
inline std::vector<std::string> dimensions_of(const Job& job)
{
    std::vector<std::string> names;
    for (const Dimension& dimension : job.problem.grid.dimensions) {
        names.push_back(dimension.name);
    }
    return names;
}

} // namespace overturn
