#include "sample.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace overturn {

namespace {

/// About `count` values of an axis, including its ends.
Axis spread(const Axis& axis, std::int64_t count)
{
    if (axis.size() <= count) {
        return Axis(axis.values());
    }
    AxisList values;
    for (std::int64_t i = 0; i < count; ++i) {
        values.push_back(axis[count == 1 ? axis.size() / 2 : i * (axis.size() - 1) / (count - 1)]);
    }
    return Axis(values);
}

} // namespace

Grid sample_of(const Grid& grid, std::int64_t points)
{
    constexpr std::int64_t most_of_others = 3;
    Grid sample = grid;
    Axis* amplitude = nullptr;
    Axis* frequency = nullptr;
    auto left = double(points);
    for (Dimension& dimension : sample.dimensions) {
        Column& column = dimension.columns.front();
        const bool is_last = &dimension == &sample.dimensions.back();
        if (column.quantity->role == Role::motion) {
            left /= double(dimension.size());
        } else if (column.quantity->role == Role::strength) {
            amplitude = &column.values;
        } else if (is_last) {
            frequency = &column.values;
        } else {
            column.values = spread(column.values, most_of_others);
            left /= double(dimension.size());
        }
    }
    const std::int64_t side = std::max<std::int64_t>(1, std::int64_t(std::sqrt(left)));
    const std::int64_t frequencies = frequency != nullptr ? frequency->size() : 1;
    const std::int64_t amplitudes =
        std::clamp<std::int64_t>(std::int64_t(left / double(std::min(side, frequencies))), 1,
                                 amplitude != nullptr ? amplitude->size() : 1);
    if (amplitude != nullptr) {
        *amplitude = spread(*amplitude, amplitudes);
    }
    if (frequency != nullptr) {
        *frequency =
            spread(*frequency, std::max<std::int64_t>(1, std::int64_t(left / double(amplitudes))));
    }
    return sample;
}

std::vector<std::vector<int>> evenly_chosen(const Tiling& tiling, std::int64_t wanted)
{
    const std::int64_t points = count_points(tiling.shape());
    const double stride = std::max(1.0, double(points) / double(wanted));
    const bool all = stride < 2;
    std::vector<std::vector<int>> chosen;
    std::int64_t before = 0;
    double next = all ? 0 : 0.5 * stride;
    // Rows are visited in order. The golden ratio selects the column, so that none is left out.
    double share = 0.5;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const Tile tile = tiling[i];
        const auto columns = tile.count.empty() ? 1 : int(tile.count.back());
        std::set<int> of_tile;
        for (; next < double(before + tile.points()); next += all ? 1 : stride) {
            const auto point = int(std::int64_t(next) - before);
            share = std::fmod(share + 0.6180339887498949, 1.0);
            const int column = all ? point % columns : int(share * columns);
            of_tile.insert(point - point % columns + column);
        }
        chosen.emplace_back(of_tile.begin(), of_tile.end());
        before += tile.points();
    }
    return chosen;
}

} // namespace overturn
