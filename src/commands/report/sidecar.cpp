#include "sidecar.hpp"

#include "overturn/answers/json.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/text_outputs.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace overturn {

namespace {

using Clock = std::chrono::system_clock; // dates

constexpr double update_interval = 10; // [s]

/// A run that is this silent may be dead: it updates its sidecar three times as often.
constexpr double longest_silence = 30; // [s]

constexpr const char* date_format = "%Y-%m-%dT%H:%M:%S";

/// With milliseconds.
std::string date_of(Clock::time_point time)
{
    const auto second = std::chrono::floor<std::chrono::seconds>(time);
    const auto rest = std::chrono::floor<std::chrono::milliseconds>(time - second);
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(second), rest.count());
}

/// The date in UTC; nullopt if it is none.
std::optional<Clock::time_point> time_of(const std::string& date)
{
    std::tm parts = {};
    const char* const end = strptime(date.c_str(), date_format, &parts);
    int milliseconds = 0;
    constexpr int year_1970 = 70;
    constexpr int year_2200 = 300; // nanoseconds since 1970 fit into 64 bits
    if (end == nullptr || std::sscanf(end, ".%3dZ", &milliseconds) != 1 ||
        parts.tm_year < year_1970 || parts.tm_year > year_2200) {
        return {};
    }
    return Clock::from_time_t(timegm(&parts)) + std::chrono::milliseconds(milliseconds);
}

std::optional<double> number_in(const Json& json, const char* name)
{
    const auto found = json.find(name);
    return found != json.end() && found->is_number() ? std::optional(found->get<double>())
                                                     : std::nullopt;
}

std::string text_in(const Json& json, const char* name)
{
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

} // namespace

Sidecar::Sidecar(std::string path, std::vector<std::string> hosts, Kernel kernel,
                 std::chrono::system_clock::time_point start)
    : path_(std::move(path)), hosts_(std::move(hosts)), kernel_(kernel), start_(start)
{}

void Sidecar::update(const ProgressState& progress)
{
    progress_ = progress;
    if (progress.seconds < next_) {
        return;
    }
    next_ = progress.seconds + update_interval;
    try {
        write_sidecar(path_, text(RunState::running, nullptr), Syncing::no);
    } catch (const std::exception&) {
        return; // see the header
    }
}

void Sidecar::finish(const FarmReport& report) const
{
    const RunState state = report.stopped ? RunState::stopped : RunState::finished;
    write_sidecar(path_, text(state, &report), Syncing::yes);
}

std::string Sidecar::text(RunState state, const FarmReport* report) const
{
    const auto now = Clock::now();
    Json sidecar;
    sidecar["program_version"] = program_version();
    sidecar["program_commit"] = program_commit();
    sidecar["state"] = name_of(state);
    sidecar["start"] = date_of(start_);
    sidecar["refreshed"] = date_of(now);
    sidecar["wall_seconds"] = std::chrono::duration<double>(now - start_).count();
    sidecar["computing_seconds"] = progress_.seconds;
    sidecar["items"] = progress_.items;
    sidecar["items_all"] = progress_.all;
    sidecar["items_before"] = progress_.before;
    sidecar["items_done"] = progress_.done;
    sidecar["items_per_second"] = if_known(progress_.rate());
    sidecar["seconds_left"] = if_known(progress_.seconds_left());
    sidecar["kernel"] = name_of(kernel_);
    sidecar["compiler"] = compiler_version();
    sidecar["hdf5"] = hdf5_version();
    sidecar["mpi"] = mpi_version();
    sidecar["rank_count"] = hosts_.size();
    if (report != nullptr) {
        sidecar["requests"] = report->dispatch.requests;
        sidecar["dealing_seconds"] = report->dispatch.seconds;
        for (std::size_t rank = 0; rank < report->ranks.size(); ++rank) {
            const RankShare& share = report->ranks[rank];
            Json& json = sidecar["ranks"].emplace_back();
            json["host"] = hosts_[rank];
            json["tiles"] = share.tiles;
            json["compute_seconds"] = share.compute_seconds;
            json["write_seconds"] = share.write_seconds;
        }
    }
    return text_of(sidecar);
}

std::optional<LastRun> last_run_of(const std::string& path)
{
    const std::string sidecar = path + ".json";
    std::error_code none;
    if (!std::filesystem::is_regular_file(sidecar, none)) {
        return {};
    }
    std::ifstream stream(sidecar, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const Json json = Json::parse(text, nullptr, false);
    if (!text.starts_with(sidecar_beginning) || !json.is_object()) {
        return {};
    }
    const auto written = time_of(text_in(json, "refreshed"));
    const auto state = enumerator_named<RunState>(text_in(json, "state"));
    if (!written || !state) {
        return {};
    }
    const auto count = [&](const char* name) {
        const auto found = json.find(name);
        return found != json.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
    };
    // The clock of the host that writes may be ahead of this one.
    const double age = std::chrono::duration<double>(Clock::now() - *written).count();
    return LastRun{.state = *state,
                   .age = std::max(age, 0.0),
                   .elapsed = number_in(json, "wall_seconds").value_or(0),
                   .ranks = count("rank_count"),
                   .progress = {.before = count("items_before"),
                                .done = count("items_done"),
                                .all = count("items_all"),
                                .seconds = number_in(json, "computing_seconds").value_or(0)}};
}

FileProgress progress_of(const StoredResult& stored, const std::optional<LastRun>& run)
{
    const TilesSummary& tiles = stored.tiles();
    Items items{tiles.tiles_of_job, "lines"};
    if (stored.origin().kind == FileKind::spectrum) {
        items = {1, "points"};
        for (const AxisSummary& axis : tiles.axes) {
            items.count *= axis.size;
        }
    }
    FileProgress found{.state = RunState::unknown,
                       .progress = run ? run->progress : ProgressState(),
                       .elapsed = run ? std::optional(run->elapsed) : std::nullopt,
                       .seconds_left = {}};
    found.progress.items = items.name;
    found.progress.all = items.in(tiles.tiles, tiles.tiles_of_job);
    found.progress.done = items.in(tiles.tiles_done, tiles.tiles_of_job);
    if (tiles.tiles_done == tiles.tiles) {
        found.state = RunState::finished;
        found.seconds_left = 0;
    } else if (run && run->state != RunState::running) {
        found.state = RunState::stopped; // if it says finished, the file is another one
    } else if (run && run->age < longest_silence) {
        found.state = RunState::running;
        found.progress.seconds += run->age;
        *found.elapsed += run->age;
        found.seconds_left = found.progress.seconds_left();
    }
    return found;
}

} // namespace overturn
