// A result file opened for reading: what it contains, and what is damaged.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/problem/job_part.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/names.hpp"

#include <cstdint>
#include <functional>
#include <memory>
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

enum class FileKind { spectrum, boundary, history, accuracy };

/// Values of the global attribute `kind`.
template <>
inline constexpr std::array<std::string_view, 4> names_of<FileKind>{
    "overturning spectrum", "overturning boundary", "rocking history", "accuracy study"};

inline FileKind kind_of(const Product& product)
{
    return product.boundaries() != nullptr ? FileKind::boundary : FileKind::spectrum;
}

/// The metadata that every kind of result file contains.
struct FileOrigin {
    FileKind kind = FileKind::spectrum;
    std::int64_t format = 0; ///< version
    std::string title;
    MotionOf motion_of = MotionOf::ground;
    std::string program_version;
    std::string program_commit;
    std::string resolved_job;
    std::uint64_t bytes = 0; ///< of the file

    bool has_tiles() const { return kind == FileKind::spectrum || kind == FileKind::boundary; }
};

/// The content of a spectrum or a boundary.
struct TilesSummary {
    std::vector<AxisSummary> axes;    ///< slowest first: the dimensions of every field
    std::vector<AxisSummary> numbers; ///< coordinates that are equal at all points
    std::vector<Field> fields;        ///< in the job's order
    Shape tile_shape;                 ///< of a tile [points]
    std::int64_t tiles = 0;           ///< that the file contains when it is complete
    std::int64_t tiles_done = 0;
    std::int64_t tiles_of_job = 0; ///< more than `tiles` if the file is a part
    std::optional<JobPart> part;
    std::optional<AuditCount> audit; ///< of all tiles, if the spectrum is filled
};

/// The number of computed lines of a boundary, and of those that need a remark.
struct BoundaryLines {
    std::int64_t computed = 0;
    std::int64_t unsafe_at_first = 0; ///< overturn at the first strength of the job
    std::int64_t undecided = 0;       ///< at some strength, or beyond the last stored flip
    bool has_shares = false;          ///< under a record
    double unsafe_share = 0;          ///< mean of the computed lines [1]
    double undecided_share = 0;       ///< mean of the computed lines [1]
};

/// Called between tiles; an exception from it stops the work.
using BetweenTiles = std::function<void()>;

/// Structure and metadata are checked when the file is opened; the values of its tiles are not.
class StoredResult {
public:
    /// Throws Error if the file is missing, not a result file of overturn, or damaged.
    explicit StoredResult(const std::string& path);

    const std::string& path() const { return path_; }
    const FileOrigin& origin() const { return origin_; }

    /// The rest is for spectra and boundaries.
    const TilesSummary& tiles() const;

    /// Names of the coordinates whose values do not match their checksums, if there are any; of a
    /// part, also the name of its skeleton.
    std::vector<std::string> damaged_coordinates() const;

    /// The text with the checksums of the coordinates.
    std::string coordinate_checksums() const;

    /// Numbers of the computed tiles whose values do not match their checksum, ascending. Reads all
    /// data.
    std::vector<std::int64_t> damaged_tiles(const BetweenTiles& between_tiles = [] {}) const;

    /// Of a boundary.
    BoundaryLines count_lines() const;

private:
    struct Open;
    std::string path_;
    FileOrigin origin_;
    std::shared_ptr<Open> open_;
};

/// The file at the path, or nullopt if there is none. Throws Error if the path exists and is not a
/// result file of this program version and job, or of this part of it. Serial.
std::optional<StoredResult> existing_result(const std::string& path, const Job& job,
                                            const std::optional<JobPart>& part = {});

/// Clears the mark that says that a file is open for writing. HDF5 clears it on closing the file,
/// so a run that is killed after its last tile leaves it set. A file that cannot be written is left
/// as it is.
void clear_open_mark(const std::string& path);

} // namespace overturn
