// Reads files of recorded ground motions: PEER AT2, GeoNet V2A, USGS SMC, K-NET, KiK-net, COSMOS,
// CSMIP, ESM, and plain text. Values are those of the file: nothing is scaled, filtered, resampled
// or corrected. Only counts of a digitiser are converted, and lose their mean.
#pragma once

#include "overturn/text/motion_words.hpp"
#include "overturn/text/names.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn {

enum class AccelerationUnit { g, m_per_s2, cm_per_s2, mm_per_s2, gal };

/// In job files.
template <>
inline constexpr std::array<std::string_view, 5> names_of<AccelerationUnit>{"g", "m/s2", "cm/s2",
                                                                            "mm/s2", "gal"};

/// One component of a recorded motion.
struct RecordComponent {
    /// As in the file, such as "N28W"; empty if the file does not name it. Names may repeat. Bytes
    /// that are not UTF-8 are read as Latin-1.
    std::string name;
    /// Where its sensor is, such as "Roof: SW"; empty if the file does not state it.
    std::string place = {};
    /// The earthquake and the station, as they are read of AT2, SMC, K-NET, KiK-net and ESM files,
    /// to compare those of different files; in any encoding. Empty if it is unknown.
    std::string event = {};
    std::vector<double> acceleration{}; ///< at least one sample [unit]
    AccelerationUnit unit = AccelerationUnit::g;
    double time_step = 0; ///< above 0 [s]
    /// Whether the file states that it was neither filtered nor corrected for the instrument.
    bool is_uncorrected = false;
    double start = 0; ///< time of the first sample, if the file states times [s]
    /// Numbers of the header that differ from the samples by little, with their line.
    std::vector<std::string> remarks = {};
    std::optional<MotionOf> motion_of = {}; ///< if the file states it
    /// Peak acceleration over g of the ground that caused the motion of a floor, if it is stated.
    std::optional<double> ground_pga = {};
    /// Header lines as in the file, without line ends, in any encoding; for text, the comments.
    std::vector<std::string> header{};
};

/// Its accelerations over g; gravity: g [m/s2].
std::vector<double> over_gravity(const RecordComponent& component, double gravity);

struct RecordFile {
    /// "AT2", "V2A", "SMC", "K-NET", "KiK-net", "COSMOS", "CSMIP", "ESM" or "text"
    std::string format;
    std::vector<RecordComponent> components;
    bool has_given_unit = false; ///< whether the unit is that of the options
};

/// A component as users choose it: its number, counted from 1, or its name.
using ComponentChoice = std::variant<std::int64_t, std::string>;

/// The chosen component, or why there is none.
struct ChosenComponent {
    const RecordComponent* component; ///< null unless exactly one is meant
    bool is_ambiguous;                ///< whether several are
    std::string refusal;              ///< follows the choice, and lists all components
};

/// file: its name, for the refusal
ChosenComponent chosen_component(const RecordFile& content, const ComponentChoice& choice,
                                 const std::string& file);

/// What a file of plain text does not state. Both are refused if the file states them.
struct RecordOptions {
    std::optional<double> time_step;      ///< of one column [s]
    std::optional<AccelerationUnit> unit; ///< of one or two columns, and of an AT2 file that states
                                          ///< none or one that is not understood
};

/// Larger records are refused.
inline constexpr std::size_t most_samples = 10'000'000;
inline constexpr std::uint64_t largest_record_file = std::uint64_t(1) << 30; ///< [bytes]

/// Reads the text of a file; `name` replaces the path in messages. docs/records.md states how the
/// formats are recognised. Throws Error.
RecordFile parse_record(std::string_view text, const std::string& name,
                        const RecordOptions& options = {});

/// The same for a file. Throws Error.
RecordFile read_record(const std::string& path, const RecordOptions& options = {});

} // namespace overturn
