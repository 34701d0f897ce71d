// The readers of the formats. Each reads the lines of a whole file, or refuses them.
#pragma once

#include "lines.hpp"
#include "overturn/record/read_record.hpp"

namespace overturn {

/// PEER: four lines of header, the third with the unit, the fourth with NPTS and DT, then NPTS
/// numbers. The unit of the options is that of a file that states none, or one that is not
/// understood; such a file is refused without it.
RecordFile read_at2(Lines lines, const RecordOptions& options);

/// GeoNet: up to three components, each with 26 lines of header and with acceleration, velocity and
/// displacement in mm/s2, mm/s and mm. Only the acceleration is kept.
RecordFile read_v2a(Lines lines, const RecordOptions& options);

/// USGS: 27 lines of header, comments that begin with |, then numbers in cm/s2.
RecordFile read_smc(Lines lines, const RecordOptions& options);

/// K-NET and KiK-net: a header of keys, then counts of the digitiser. One component. The mean of
/// all counts is removed; a scale factor in the header gives gal per count.
RecordFile read_knet(Lines lines, const RecordOptions& options);

/// COSMOS, version 1.20: channels, each with a text, integers, reals, comments, and samples in the
/// unit and format that the line before them states. Velocities and displacements are skipped.
/// Counts, of raw records, become accelerations in g: their mean is removed.
RecordFile read_cosmos(Lines lines, const RecordOptions& options);

/// CSMIP (CGS, CDMG), volume 2: channels, each with a text, integers, reals, and acceleration,
/// velocity and displacement. Only the acceleration is kept.
RecordFile read_csmip(Lines lines, const RecordOptions& options);

/// ESM: a header of keys, then one number per line in the unit of the header. One component.
RecordFile read_esm(Lines lines, const RecordOptions& options);

/// One column of accelerations, or two of times and accelerations.
RecordFile read_text(Lines lines, const RecordOptions& options);

/// Refuses a line that announces another quantity.
[[noreturn]] inline void refuse_motion(const Lines& lines)
{
    lines.refuse("{} does not announce accelerations. Give the file of the acceleration.",
                 lines.quoted());
}

} // namespace overturn
