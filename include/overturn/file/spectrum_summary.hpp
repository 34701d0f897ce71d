// Reads a result file, given only its path: a summary of its content, and what is damaged.
#pragma once

#include "overturn/file/file_error.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/fill.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

struct AxisSummary {
    std::string name;
    std::int64_t size = 0;
    double first = 0; ///< in `units`
    double last = 0;  ///< in `units`
    std::string units;
};

struct FieldSummary {
    Field field = Field::region;
    std::string name;
    std::string type; ///< "uint8", "uint16", "uint32" or "float64"
};

/// The first two correspond to Product.
enum class FileKind { spectrum, boundary, history, accuracy };

/// The metadata that every kind of result file contains.
struct FileOrigin {
    FileKind kind = FileKind::spectrum;
    std::int64_t format = 1; ///< version of the layout
    std::string title;
    std::string program_version;
    std::string program_commit;
    std::string resolved_job;
    std::uint64_t bytes = 0; ///< of the file
};

/// Throws FileError if the file is missing, not a result file of overturn, or damaged.
FileOrigin origin_of(const std::string& path);

/// The metadata of a spectrum or a boundary.
struct SpectrumSummary : FileOrigin {
    Product product = Product::spectrum;
    std::vector<AxisSummary> axes;    ///< slowest first: the dimensions of every field
    std::vector<FieldSummary> fields; ///< in the job's order
    Shape tile_shape;                 ///< of a tile [points]
    std::int64_t tiles = 0;
    std::int64_t tiles_done = 0;
    std::optional<AuditCount> audit; ///< of all tiles, if the spectrum is filled
};

/// Throws FileError if the file is missing, not a spectrum or boundary of overturn, or damaged.
SpectrumSummary summarize(const std::string& path);

/// The number of computed lines of a boundary, and of those that need a remark.
struct BoundaryLines {
    std::int64_t computed = 0;
    std::int64_t unsafe_at_first = 0; ///< overturn at the first amplitude of the job
    std::int64_t undecided = 0;       ///< at some amplitude, or beyond the last stored flip
    bool has_shares = false;          ///< under a record
    double unsafe_share = 0;          ///< mean of the computed lines [1]
    double undecided_share = 0;       ///< mean of the computed lines [1]
};

/// Throws FileError as summarize() does.
BoundaryLines count_lines(const std::string& path);

/// Names of the coordinates whose size or values do not match the job stored in the file. Throws
/// FileError as summarize() does, and if that job cannot be read.
std::vector<std::string> damaged_coordinates(const std::string& path);

/// Numbers of the computed tiles whose values do not match their checksum, ascending. Reads all
/// data, and calls `between_tiles`, which may throw to stop it. Throws FileError as summarize()
/// does.
std::vector<std::int64_t> damaged_tiles(
    const std::string& path, const std::function<void()>& between_tiles = [] {});

} // namespace overturn
