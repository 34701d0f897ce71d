#include "commands.hpp"
#include "guarded_reading.hpp"
#include "report/print.hpp"
#include "report/progress.hpp"
#include "report/result_remarks.hpp"

#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/merge.hpp"
#include "overturn/file/output_lock.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sys/resource.h>

namespace overturn {

namespace {

/// By default a process may often open 1024 files, but raise this limit itself.
void allow_open_files(std::size_t count)
{
    constexpr std::size_t others = 64; // libraries, messages, the output
    rlimit files = {};
    getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = std::clamp<rlim_t>(count + others, files.rlim_cur, files.rlim_max);
    setrlimit(RLIMIT_NOFILE, &files);
}

StoredResult opened(const std::string& path, const OutputLock& lock)
{
    const GuardedReading guarded(path, lock.path());
    StoredResult stored(path);
    stored.tiles(); // throws if it is a history or an accuracy study
    return stored;
}

/// Counts steps of the work, and throws Error once a signal was received.
class Steps {
public:
    Steps(std::int64_t all, const char* items) : progress_(items), all_(all) {}

    void next()
    {
        if (StopSignals::requested()) {
            throw stopped_by_signal(" before the parts were merged");
        }
        progress_.update(++done_, all_);
    }

private:
    Progress progress_;
    std::int64_t all_;
    std::int64_t done_ = 0;
};

/// Throws Error if the file exists and is not the complete result of the job of the part.
bool is_merged(const std::string& path, const StoredResult& part, const OutputLock& lock)
{
    std::error_code reported_by_open;
    if (!std::filesystem::exists(path, reported_by_open)) {
        return false;
    }
    const GuardedReading guarded(path, lock.path());
    const StoredResult merged(path);
    expect_merged(merged, part);
    expect_undamaged(merged);
    return true;
}

} // namespace

int merge(const MergeOptions& options)
{
    const StopSignals signals;
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the file size limit fails with a message
    std::signal(SIGPIPE, SIG_IGN);
    const std::string& output = options.output;
    const OutputLock lock(output);
    allow_open_files(options.parts.size());
    std::vector<std::string> paths = options.parts;
    std::erase_if(paths, [](const std::string& path) { return !std::filesystem::exists(path); });
    // If none exists, the message is that on the first one.
    auto parts = mapped(paths.empty() ? options.parts : paths,
                        [&](const std::string& path) { return opened(path, lock); });
    expect_all_parts(parts);
    if (is_merged(output, parts.front(), lock)) {
        print_line(output + " is already complete.");
        return exit_code::complete;
    }
    expect_room_for_merged(parts.front(), output);
    const TilesSummary& tiles = parts.front().tiles();
    std::uint64_t bytes = 0;
    {
        Steps steps(tiles.tiles_of_job, "tiles checked");
        for (const StoredResult& part : parts) {
            const GuardedReading guarded(part.path(), lock.path());
            expect_undamaged(part, [&] { steps.next(); });
            bytes += part.origin().bytes;
        }
    }
    {
        const GuardedReading guarded(parts.front().path(), lock.path(), bytes);
        Steps steps(tiles.tiles_of_job * std::ssize(tiles.fields), "chunks written");
        merge_parts(parts, output, [&] { steps.next(); });
    }
    print_line(fmt::format("{}: merged {} {} from {} {}", output, tiles.tiles_of_job,
                           noun_of(tiles.tiles_of_job, "tiles"), parts.size(),
                           noun_of(std::ssize(parts), "parts")));
    for (const std::string& line : remarks_on(StoredResult(output))) {
        print_line(fmt::format("{}: {}", output, line));
    }
    return exit_code::complete;
}

} // namespace overturn
