#include "hostile_input.hpp"

#include "altered_result_file.hpp"

#include "overturn/file/file_error.hpp"
#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/spectrum_summary.hpp"
#include "support/scratch_folder.hpp"

namespace overturn {

namespace {

/// Whether the request was answered and not refused.
template <class Question>
bool is_answered(const Question& question)
{
    try {
        question();
        return true;
    } catch (const FileError&) {
        return false;
    }
}

} // namespace

Verdict use_as_result_file(const std::string& path)
{
    const Job job = job_to_alter();
    const bool is_summarised = is_answered([&] { summarize(path); });
    const bool is_verified = is_answered([&] {
        damaged_coordinates(path);
        damaged_tiles(path);
    });
    is_answered([&] { origin_of(path); });
    is_answered([&] { count_lines(path); });
    is_answered([&] { examine(path, job, tiling_of(job)); });
    return is_summarised && is_verified ? Verdict::accepted : Verdict::refused;
}

Verdict use_as_result_file(std::string_view bytes, const std::string& path)
{
    write_bytes(path, std::string(bytes));
    return use_as_result_file(path);
}

} // namespace overturn
