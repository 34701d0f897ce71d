#include "prepare_output.hpp"

#include "complain.hpp"
#include "guarded_reading.hpp"
#include "human_units.hpp"
#include "output_lines.hpp"

#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/stored_result.hpp"

#include <fmt/format.h>

#include <chrono>

namespace overturn {

namespace {

constexpr const char* before_anything = " before the computation started";

void expect_no_stop(const char* when)
{
    if (StopSignals::requested()) {
        throw stopped_by_signal(when);
    }
}

void create_result_file(const Job& job, const std::string& path)
{
    const long double bytes = spectrum_file_bytes(job);
    constexpr long double made_at_once = 1e8L;
    if (bytes > made_at_once) {
        say(fmt::format("{}: creating a file of {}", path, human_bytes(double(bytes))));
    }
    create_spectrum_file(path, job, [] { expect_no_stop(" before the file was created"); });
}

/// Checks all finished tiles: after a power failure, the checksum of a tile may be on the disk but
/// not its values.
std::vector<std::int64_t> find_damaged_tiles(const StoredResult& stored)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    bool announced = false;
    return stored.damaged_tiles([&] {
        if (!announced && Clock::now() - start > std::chrono::seconds(2)) {
            say(stored.path() + ": verifying finished tiles");
            announced = true;
        }
        expect_no_stop(before_anything);
    });
}

} // namespace

PreparedOutput prepare_output(const Job& job, const std::string& path, const SoleWriter& writer)
{
    PreparedOutput output{};
    bool exists = false;
    {
        const GuardedReading guarded(path, writer.lock());
        if (const auto stored = existing_result(path, job)) {
            output.damaged = find_damaged_tiles(*stored);
            exists = true;
            output.is_complete =
                output.damaged.empty() && stored->tiles().tiles_done == stored->tiles().tiles;
        }
    }
    if (output.is_complete) {
        clear_open_mark(path);
        say(path + " is already complete.");
        return output;
    }
    demand_place_for_sidecar(path);
    if (!exists) {
        create_result_file(job, path);
    }
    return output;
}

} // namespace overturn
