#include "overturn/job/job.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/sweep/boundary.hpp"

#include "deep_key.hpp"
#include "read_steps.hpp"
#include "toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace overturn {

namespace {

// Sufficient for lists of millions of values; a file that is not a job cannot fill the memory.
constexpr TextFileKind job_file{"a job file", std::size_t(64) << 20, "Give the path of a job file.",
                                "Give long axes as first, last and count."};

toml::table parse(const std::string& text, const std::string& path)
{
    if (text.starts_with("\x89HDF\r\n")) {
        throw JobError(
            fmt::format("{0}: this is a result file, not a job file. Give the job file; to "
                        "resume its run, also -o {0}.",
                        path));
    }
    if (const std::size_t deep = find_deep_key(text); deep != text.npos) {
        const auto line = std::count(text.begin(), text.begin() + std::ptrdiff_t(deep), '\n') + 1;
        throw JobError(fmt::format("{}:{}: a key has more than {} parts, but keys of a job have at "
                                   "most three, such as plane.frequency.count. Shorten the key.",
                                   path, line, most_key_parts));
    }
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        throw JobError(fmt::format("{}: this is not TOML: {}. Fix it here or just before; strings "
                                   "need \"quotes\".",
                                   place_of(error.source()),
                                   on_one_line(std::string(error.description()))));
    }
}

std::string read_title(const Entry& job)
{
    const auto entry = find(job, "title");
    if (!entry) {
        return "";
    }
    std::string title = string_of(*entry);
    if (title.find('\0') != title.npos) {
        refuse(*entry, " has a NUL character, which ends strings in other programs. Remove it.");
    }
    return title;
}

/// Largest total size of the fields [bytes], with a margin to what can be addressed.
constexpr long double most_bytes = 0x1p62L;

/// The size of a job, in floating point, which cannot overflow here.
struct JobSize {
    long double points;
    long double bytes;
};

JobSize size_of(const Job& job)
{
    JobSize size{.points = 1, .bytes = 0};
    for (const std::int64_t count : shape_of(job.plane)) {
        size.points *= static_cast<long double>(count);
    }
    for (const Field field : job.fields) {
        size.bytes += size.points * static_cast<long double>(bytes_per_point(field));
    }
    return size;
}

} // namespace

Job read_job(const std::string& path, const std::vector<std::string>& overrides)
{
    return read_job_text(text_of_file<JobError>(path, job_file), path, overrides);
}

namespace {

/// Throws JobError if the factor on a record, or the scaled vertical motion, overflows.
void expect_finite_scales(const Entry& entry, const Job& job)
{
    for (const Motion& motion : job.motions) {
        const double scale = job.largest_scale(motion);
        const double upwards = motion.record ? motion.record->upwards_peak() : 0;
        if (!std::isfinite(scale) || !std::isfinite(scale * upwards)) {
            refuse(*find(*find(entry, "plane"), name_of(job.plane.amplitude_is)),
                   fmt::format(" {} {}, which exceeds the range of double precision as a factor on "
                               "\"{}\", whose peak is {} g. Correct the unit of the record, or "
                               "lower the value.",
                               job.plane.amplitude.size() > 1 ? "reaches" : "is",
                               job.plane.amplitude.last(), motion.name, motion.measures.pga));
        }
    }
}

/// Throws JobError if the vertical motion of every record cancels gravity at every point.
void expect_gravity(const Entry& entry, const Job& job)
{
    if (job.blocks && !job.blocks->table) { // the job of a result file
        return;
    }
    const auto cancels = [&](const Motion& motion) {
        return !(job.smallest_scale(motion) < motion.largest_scale);
    };
    if (!job.motions.empty() && std::all_of(job.motions.begin(), job.motions.end(), cancels)) {
        const auto plane = find(entry, "plane");
        if (!plane) {
            const Motion& motion =
                *std::find_if(job.motions.begin(), job.motions.end(), [&](const Motion& any) {
                    return std::isfinite(job.smallest_scale(any));
                });
            refuse(*find(entry, "blocks"),
                   fmt::format(" have scales of {:.6g} or more under \"{}\", whose vertical motion "
                               "cancels gravity from the scale {:.6g} on, which is a PGA of {:.6g} "
                               "g. Give smaller values of scale or pga in the table.",
                               job.smallest_scale(motion), motion.name, motion.largest_scale,
                               motion.largest_scale * motion.measures.pga));
        }
        const bool is_range = job.plane.amplitude.size() > 1;
        refuse(*find(*plane, name_of(job.plane.amplitude_is)),
               fmt::format(" {} {}, where the vertical motion of \"{}\" cancels gravity. {} below "
                           "the scale {:.6g}, which is a PGA of {:.6g} g.",
                           is_range ? "begins at" : "is", job.plane.amplitude.first(),
                           job.motions.front().name, is_range ? "Begin" : "Choose a value",
                           job.motions.front().largest_scale,
                           job.motions.front().largest_scale * job.motions.front().measures.pga));
    }
}

Job read_any_job(std::string text, const std::string& name,
                 const std::vector<std::string>& overrides, JobText kind)
{
    Job job;
    job.given = std::move(text);
    job.overrides = overrides;
    toml::table table = parse(job.given, name);
    for (const std::string& argument : overrides) {
        apply_override(table, argument);
    }
    const Entry entry{&table, ""};
    expect_table(entry, job_keys);
    job.title = read_title(entry);
    job.scene = read_scene(entry);
    if (const Entry scene = *find(entry, "scene"); find(scene, "record")) {
        const std::string folder = std::filesystem::path(name).parent_path().string();
        job.motions = read_motions(scene, folder, job.scene.gravity, kind);
        for (const Motion& motion : job.motions) {
            job.scene.records.push_back(motion.record);
        }
    }
    job.numerics = read_numerics(entry, job.scene.is_recorded());
    job.fields = read_fields(entry);
    expect_known_errors(entry, job.numerics, job.fields);
    job.plane.motions = std::int64_t(job.motions.size());
    if (const auto blocks = find(entry, "blocks")) {
        const std::string folder = std::filesystem::path(name).parent_path().string();
        job.blocks = read_blocks(*blocks, folder, job, kind);
    }
    read_plane(entry, job.plane);
    expect_finite_scales(entry, job);
    expect_gravity(entry, job);
    expect_fillable(entry, job);
    if (job.numerics.fill) {
        job.fields.push_back(Field::evaluated);
    }
    if (const JobSize size = size_of(job); size.bytes > most_bytes) {
        refuse(*find(entry, "plane"),
               fmt::format(" has {:.4g} points and would take {:.4g} bytes, but at most {:.4g} are "
                           "allowed. Lower the counts.",
                           size.points, size.bytes, most_bytes));
    }
    job.resolved = resolved_text(job);
    return job;
}

} // namespace

Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides)
{
    return read_any_job(std::move(text), name, overrides, JobText::given);
}

Job read_resolved_job(std::string text, const std::string& name)
{
    return read_any_job(std::move(text), name, {}, JobText::resolved);
}

double Job::smallest_scale(const Motion& motion) const
{
    return scales(motion).first;
}

double Job::largest_scale(const Motion& motion) const
{
    return scales(motion).second;
}

std::pair<double, double> Job::scales(const Motion& motion) const
{
    if (plane.list && plane.list->has_own_motions) {
        const std::int64_t number = &motion - motions.data();
        std::pair<double, double> all{std::numeric_limits<double>::infinity(), 0};
        for (std::size_t i = 0; i < plane.list->amplitude.size(); ++i) {
            if (plane.list->motion[i] == number) {
                all = {std::min(all.first, plane.list->amplitude[i]),
                       std::max(all.second, plane.list->amplitude[i])};
            }
        }
        return all;
    }
    const double unit = plane.amplitude_is == AmplitudeQuantity::pga ? motion.measures.pga : 1;
    return {plane.amplitude.first() / unit, plane.amplitude.last() / unit};
}

Job boundary_of(Job job)
{
    if (job.blocks) {
        throw JobError(
            fmt::format("blocks.table = {}: a boundary is computed over a plane, not for "
                        "a list of blocks. Use `overturn run`, with many values of pga "
                        "or scale.",
                        in_quotes(job.blocks->file)));
    }
    if (job.numerics.fill) {
        throw JobError("numerics.fill = true is for spectra; a boundary is found without filling. "
                       "Remove it.");
    }
    if (job.plane.amplitude.size() == 1) {
        throw JobError(fmt::format("plane.{} has one value, {}, but flips are found between the "
                                   "first and the last. Give two or more values.",
                                   name_of(job.plane.amplitude_is), job.plane.amplitude.first()));
    }
    job.product = Product::boundary;
    job.resolved = resolved_text(job);
    job.scan = job.plane.amplitude;
    const std::int64_t crossings = most_crossings(job.scene);
    job.plane.amplitude = Axis(AxisRange{0, double(crossings - 1), crossings});
    job.fields = boundary_fields(job.scene, job.plane);
    // With fewer amplitudes than crossings, the boundary is larger than the spectrum.
    if (const JobSize size = size_of(job); size.bytes > most_bytes) {
        throw JobError(fmt::format("plane has {:.4g} lines of one frequency, restitution and "
                                   "slenderness, whose boundaries would take {:.4g} bytes, but at "
                                   "most {:.4g} are allowed. Lower the counts.",
                                   size.points / double(crossings), size.bytes, most_bytes));
    }
    return job;
}

Tiling tiling_of(const Job& job)
{
    // A line of a boundary takes longer than a tile of a spectrum: about 10 ms, and much more for
    // slow pulses, under which blocks bounce very often.
    constexpr std::int64_t lines = 1;
    return job.product == Product::boundary
               ? Tiling(shape_of(job.plane), {most_crossings(job.scene), lines})
           : job.numerics.fill ? filled_tiling(job.plane)
                               : Tiling(job.plane);
}

} // namespace overturn
