#include "overturn/job/job.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/error.hpp"

#include "deep_key.hpp"
#include "read_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace overturn {

namespace {

// Sufficient for lists of millions of values; a file that is not a job cannot fill the memory.
constexpr TextFileKind job_file{"a job file", std::size_t(64) << 20, "Give the path of a job file.",
                                "Give long axes as first, last and count."};

toml::table parse(const std::string& text, const std::string& path)
{
    if (text.starts_with("\x89HDF\r\n")) {
        throw Error(exit_code::job,
                    "{0}: this is a result file, not a job file. Give the job file; to resume its "
                    "run, also -o {0}.",
                    path);
    }
    if (const std::size_t deep = find_deep_key(text); deep != text.npos) {
        const auto line = std::count(text.begin(), text.begin() + std::ptrdiff_t(deep), '\n') + 1;
        throw Error(exit_code::job,
                    "{}:{}: a key has more than {} parts, but keys of a job have at most three, "
                    "such as plane.frequency.count. Shorten the key.",
                    path, line, most_key_parts);
    }
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        throw Error(
            exit_code::job,
            "{}: this is not TOML: {}. Fix it here or just before; strings need \"quotes\".",
            place_of(error.source()), on_one_line(std::string(error.description())));
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

JobSize size_of(const Problem& problem)
{
    JobSize size{.points = 1, .bytes = 0};
    for (const std::int64_t count : stored_shape(problem)) {
        size.points *= static_cast<long double>(count);
    }
    for (const Field field : problem.fields) {
        size.bytes += size.points * static_cast<long double>(bytes_per_point(field));
    }
    return size;
}

} // namespace

Job read_job(const std::string& path, const std::vector<std::string>& overrides)
{
    return read_job_text(text_of_file(path, job_file), path, overrides);
}

Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides)
{
    Job job;
    job.given = std::move(text);
    job.overrides = overrides;
    toml::table table = parse(job.given, name);
    for (const std::string& argument : overrides) {
        apply_override(table, argument);
    }
    const Entry entry{&table, ""};
    expect_table(entry, keys_of(""));
    job.title = read_title(entry);
    Problem& problem = job.problem;
    problem.scene = read_scene(entry);
    const std::string folder = std::filesystem::path(name).parent_path().string();
    bool is_suite = false;
    if (const Entry scene = *find(entry, "scene"); find(scene, "record")) {
        RecordedMotions recorded = read_motions(scene, folder, problem.scene.gravity);
        job.motions = std::move(recorded.motions);
        problem.scene.records = std::move(recorded.records);
        is_suite = recorded.is_suite;
    }
    problem.numerics = read_numerics(entry, problem.scene.is_recorded());
    problem.fields = read_fields(entry);
    expect_known_errors(entry, problem);
    expect_contact(entry, problem);
    read_points(entry, folder, is_suite, job);
    expect_fillable(entry, problem); // before `evaluated` is added, which it would refuse
    if (problem.numerics.fill) {
        problem.fields.push_back(Field::evaluated);
    }
    if (const JobSize size = size_of(problem); size.bytes > most_bytes) {
        const auto plane = find(entry, "plane");
        refuse(plane ? *plane : entry,
               " has {:.4g} points and would take {:.4g} bytes, but at most {:.4g} are allowed. "
               "Lower the counts.",
               size.points, size.bytes, most_bytes);
    }
    job.resolved = resolved_text(job);
    return job;
}

Job boundary_of(Job job)
{
    Problem& problem = job.problem;
    if (job.blocks) {
        throw Error(exit_code::job,
                    "blocks.table = {}: a boundary is computed over a plane, not for a list of "
                    "blocks. Use `overturn run`, with many values of pga or scale.",
                    in_quotes(job.blocks->file));
    }
    if (problem.numerics.fill) {
        throw Error(
            exit_code::job,
            "numerics.fill = true is for spectra; a boundary is found without filling. Remove it.");
    }
    if (const Column& strength = *problem.grid.axis_or_number(Role::strength);
        strength.values.size() == 1) {
        throw Error(exit_code::job,
                    "plane.{} has one value, {}, but flips are found between the first and the "
                    "last. Give two or more values.",
                    strength.quantity->name, strength.values.first());
    }
    problem.product = Product::boundary;
    problem.fields = boundary_fields(problem.scene, problem.grid);
    job.resolved = resolved_text(job);
    // With fewer strengths than flips, the boundary is larger than the spectrum.
    if (const JobSize size = size_of(problem); size.bytes > most_bytes) {
        throw Error(
            exit_code::job,
            "plane has {:.4g} lines of one frequency, restitution and slenderness, whose "
            "boundaries would take {:.4g} bytes, but at most {:.4g} are allowed. Lower the counts.",
            size.points / double(most_flips(problem.scene)), size.bytes, most_bytes);
    }
    return job;
}

} // namespace overturn
