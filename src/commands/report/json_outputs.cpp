#include "json_outputs.hpp"

#include "overturn/answers/json.hpp"
#include "overturn/file/result_writer.hpp"

namespace overturn {

namespace {

Json fields_of(const Problem& problem)
{
    Json list = Json::array();
    for (const FieldSize& size : field_sizes(problem)) {
        Json& field = list.emplace_back();
        field["name"] = name_of(size.field);
        field["bytes_per_value"] = size.bytes_per_value;
        field["bytes"] = size.bytes();
    }
    return list;
}

} // namespace

std::string json_of(const Job& job, const std::string& path, const DiskSpace& space,
                    const RunEstimate& estimate, const std::vector<std::string>& warnings)
{
    const Problem& problem = job.problem;
    const Items items = items_of(problem);
    const auto bytes = double(result_bytes(job));
    const auto available = space.available();
    const auto quota = space.quota();
    Json members;
    members["file"] = path;
    members["contains"] = name_of(kind_of(problem.product));
    members["items"] = items.name;
    members["items_all"] = items.count;
    members["tiles"] = estimate.tiles;
    members["fields"] = fields_of(problem);
    members["file_bytes"] = bytes;
    members["free_bytes"] = if_known(space.free);
    members["quota_bytes"] = quota ? if_finite(quota->limit) : Json();
    members["quota_used_bytes"] = quota ? Json(quota->used) : Json();
    members["fits"] = available ? Json(bytes <= *available) : Json();
    members["ranks"] = estimate.ranks;
    members["kernel"] = name_of(estimate.kernel);
    members["seconds"] = estimate.seconds();
    members["core_hours"] = estimate.core_hours();
    members["tile_share"] = estimate.tile_share();
    members["start_seconds"] = estimate.start_seconds;
    members["creation_seconds"] =
        estimate.creation_speed ? Json(estimate.creation_seconds) : Json();
    members["seconds_per_tile"] = estimate.sample.mean;
    members["tiles_sampled"] = estimate.sample.tiles;
    members["integrated_share"] = if_known(estimate.sample.integrated_share);
    members["memory_bytes"] = estimate.memory;
    members["memory_bytes_of_rank_0"] = estimate.memory_of_rank_0;
    members["warnings"] = warnings;
    return text_of(members);
}

std::string json_of(const StoredResult& stored, const std::optional<LastRun>& run)
{
    const FileOrigin& origin = stored.origin();
    Json members;
    members["file"] = stored.path();
    members["bytes"] = origin.bytes;
    members["contains"] = name_of(origin.kind);
    members["title"] = if_named(origin.title);
    members["program_version"] = origin.program_version;
    members["program_commit"] = origin.program_commit;
    if (!origin.has_tiles()) {
        return text_of(members);
    }
    const TilesSummary& tiles = stored.tiles();
    const auto [state, progress, elapsed, seconds_left] = progress_of(stored, run);
    Json& axes = members["axes"] = Json::array();
    for (const AxisSummary& axis : tiles.axes) {
        Json& each = axes.emplace_back();
        each["name"] = axis.name;
        each["size"] = axis.size;
        each["first"] = axis.first;
        each["last"] = axis.last;
        each["units"] = axis.units;
    }
    Json& fields = members["fields"] = Json::array();
    for (const Field field : tiles.fields) {
        fields.push_back(name_of(field));
    }
    members["part"] = tiles.part ? Json(tiles.part->number) : Json();
    members["parts"] = tiles.part ? Json(tiles.part->count) : Json();
    members["tiles"] = tiles.tiles;
    members["tiles_done"] = tiles.tiles_done;
    members["items"] = progress.items;
    members["items_all"] = progress.all;
    members["items_done"] = progress.done;
    members["state"] = name_of(state);
    members["items_per_second"] = if_known(progress.rate());
    members["elapsed_seconds"] = if_known(elapsed);
    members["seconds_left"] = if_known(seconds_left);
    members["refreshed_seconds_ago"] = run ? Json(run->age) : Json();
    members["ranks"] = run ? Json(run->ranks) : Json();
    return text_of(members);
}

} // namespace overturn
