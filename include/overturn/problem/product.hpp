// What is computed over the points of a grid. Each product knows its dimensions, tiles and items;
// compute_tile() computes its fields.
#pragma once

#include "overturn/problem/tile.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace overturn {

struct Grid;
struct Problem;
struct Quantity;

/// A dimension of the stored fields.
struct StoredDimension {
    std::string name;
    std::int64_t size;
};

/// What a run counts: points of a spectrum, or lines of a boundary.
struct Items {
    std::int64_t count;
    const char* name; ///< plural

    /// Those in some of all tiles, as if these were equal.
    std::int64_t in(std::int64_t tiles, std::int64_t all) const
    {
        return std::int64_t(double(count) * double(tiles) / double(all));
    }
};

/// The fields of every point, each integrated.
struct Spectrum {
    bool operator==(const Spectrum&) const = default;
    std::vector<StoredDimension> dimensions(const Problem& problem) const;
    Shape tile(const Problem& problem) const;
    Items items(const Problem& problem) const;
};

/// The fields of every point; only points near the boundaries of regions are integrated, see
/// fill.hpp.
struct FilledSpectrum : Spectrum {
    bool operator==(const FilledSpectrum&) const = default;
    double audit = 1e-3; ///< share of the filled points that are integrated as well

    Shape tile(const Problem& problem) const;
};

/// The values of one coordinate at which the verdict flips, for all others.
struct Boundaries {
    /// Of the block, or of its loss at impacts; nullptr: the strength.
    const Quantity* along = nullptr;

    bool operator==(const Boundaries&) const = default;

    /// The place of the dimension that the flips replace.
    std::size_t dimension(const Grid& grid) const;

    std::vector<StoredDimension> dimensions(const Problem& problem) const;
    Shape tile(const Problem& problem) const;
    Items items(const Problem& problem) const;
};

/// A spectrum by default.
struct Product : std::variant<Spectrum, FilledSpectrum, Boundaries> {
    using variant::variant;

    /// Whether the method, the tolerance and the fields are those of the job: a boundary settles
    /// every verdict, and has fields of its own.
    bool has_settings() const { return !std::holds_alternative<Boundaries>(*this); }

    /// If it has flips along a dimension instead of its values; nullptr if it has not.
    const Boundaries* boundaries() const { return std::get_if<Boundaries>(this); }

    /// The share of the filled points that are integrated as well; none if no point is filled.
    std::optional<double> audit() const
    {
        const auto* filled = std::get_if<FilledSpectrum>(this);
        return filled != nullptr ? std::optional(filled->audit) : std::nullopt;
    }
};

} // namespace overturn
