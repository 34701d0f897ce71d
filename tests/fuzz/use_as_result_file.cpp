#include "hostile_input.hpp"

#include "altered_result_file.hpp"

#include "overturn/file/merge.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"
#include "support/scratch_folder.hpp"

#include <optional>

namespace overturn {

namespace {

/// Whether the request was answered and not refused.
template <class Question>
bool is_answered(const Question& question)
{
    try {
        question();
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// As `overturn merge` does with the only part of a job.
void merge(const StoredResult& stored)
{
    std::vector<StoredResult> parts{stored};
    expect_all_parts(parts);
    if (stored.damaged_coordinates().empty() && stored.damaged_tiles().empty()) {
        const ScratchFolder folder;
        merge_parts(parts, folder / "merged.h5", [] {});
    }
}

} // namespace

Response use_as_result_file(const std::string& path)
{
    std::optional<StoredResult> stored;
    const bool is_opened = is_answered([&] { stored.emplace(path); });
    const bool is_verified = is_opened && is_answered([&] {
                                 stored->damaged_coordinates();
                                 stored->damaged_tiles();
                             });
    if (is_opened) {
        is_answered([&] { stored->count_lines(); });
        is_answered([&] { merge(*stored); });
    }
    stored.reset();
    is_answered([&] { existing_result(path, job_to_alter()); });
    return is_verified ? Response::accepted : Response::refused;
}

Response use_as_result_file(std::string_view bytes, const std::string& path)
{
    write_bytes(path, std::string(bytes));
    return use_as_result_file(path);
}

} // namespace overturn
