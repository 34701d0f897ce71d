// A result file opened for reading. Its structure and metadata are checked; the values of its tiles
// are not.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/file/spectrum_summary.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/tile.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace overturn {

struct StoredSpectrum : SpectrumSummary {
    std::string path;
    hdf5::Handle file;
    std::vector<std::uint64_t> checksums; ///< by tile number
    std::vector<AuditCount> audits;       ///< the same, if the spectrum is filled

    Tiling tiling() const;
};

/// Names of the coordinates whose size or values do not match the job. Throws FileError if they
/// cannot be read.
std::vector<std::string> foreign_coordinates(const StoredSpectrum& stored, const Job& job);

/// Throws FileError if the file is missing, not a spectrum or boundary of overturn, or damaged.
StoredSpectrum open_stored_spectrum(const std::string& path);

} // namespace overturn
