#include "overturn/problem/pulse_table.hpp"

#include "overturn/mechanics/intensity_measures.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overturn {

namespace {

void expect_rows(const std::vector<double>& times, const std::vector<double>& values)
{
    const auto refuse = [](std::size_t row, std::string_view column, const std::string& reason) {
        throw GivenError(std::int64_t(row), column, reason);
    };
    const auto refuse_all = [](const std::string& reason) {
        throw GivenError(GivenError::no_row, "", reason);
    };
    if (times.size() < 2 || times.size() > most_shape_rows) {
        refuse_all(fmt::format(" has {} {}. Give 2 to {} rows.", times.size(),
                               times.size() == 1 ? "row" : "rows", most_shape_rows));
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
        for (const auto& [column, value] : {std::pair("time", times[i]), {"value", values[i]}}) {
            if (!std::isfinite(value)) {
                refuse(i, column,
                       fmt::format(" = {} is not a finite number. Give one in every row.", value));
            }
        }
        if (i > 0 && !(times[i] - times[i - 1] >= least_shape_step)) {
            refuse(
                i, "time",
                fmt::format(" = {} is not after the time before it, {}, by {} or more. Times over "
                            "the period must increase; give a jump as two close times.",
                            times[i], times[i - 1], least_shape_step));
        }
    }
    if (!(times.back() - times.front() <= longest_shape)) {
        refuse(
            times.size() - 1, "time",
            fmt::format(" = {} is {} periods after the first time; at most {} are allowed. Times "
                        "are over the period of the pulse, not in seconds.",
                        times.back(), times.back() - times.front(), longest_shape));
    }
    if (std::ranges::all_of(values, [](double value) { return value == 0; })) {
        refuse_all(" is zero at all times. Give a value that is not.");
    }
}

} // namespace

ScaledTable pulse_of_table(const std::vector<double>& times, const std::vector<double>& values)
{
    expect_rows(times, values);
    const double peak = peak_of(values);
    std::vector<double> phases =
        mapped(times, [&](double time) { return 2 * std::numbers::pi * (time - times.front()); });
    std::vector<double> shape = mapped(values, [&](double value) { return value / peak; });
    return {{std::make_shared<const Accelerogram>(
                Accelerogram::of_pulse(std::move(phases), std::move(shape)))},
            peak,
            times.back() - times.front()};
}

} // namespace overturn
