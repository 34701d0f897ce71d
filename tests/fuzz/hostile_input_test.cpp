// Any job, recorded motion, result file or command line is accepted or refused; nothing else
// happens, and nothing is written. The inputs are the seeds of the fuzz targets and as many
// alterations of them as a few seconds allow, the same in every run.
#include "altered_result_file.hpp"
#include "hostile_input.hpp"
#include "support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <execinfo.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace overturn {
namespace {

std::vector<std::string> seeds_of(const std::string& reader)
{
    std::vector<std::filesystem::path> paths;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(OVERTURN_CORPUS "/") + reader)) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end()); // folders are unordered
    std::vector<std::string> seeds;
    std::transform(paths.begin(), paths.end(), std::back_inserter(seeds),
                   [](const auto& path) { return bytes_of(path.string()); });
    return seeds;
}

/// The seeds, and alterations of them by a few cuts, flips and splices.
class Alterations {
public:
    Alterations(const std::string& reader, std::size_t count)
        : seeds_(seeds_of(reader)), size_(seeds_.size() + count)
    {}

    std::size_t size() const { return size_; }

    /// Depends only on the number.
    std::string operator[](std::size_t number) const
    {
        if (number < seeds_.size()) {
            return seeds_[number];
        }
        std::mt19937_64 random(number);
        std::string bytes = seeds_[random() % seeds_.size()];
        for (std::uint64_t i = 0, times = 1 + random() % 4; i < times; ++i) {
            alter(bytes, random);
        }
        return bytes;
    }

private:
    void alter(std::string& bytes, std::mt19937_64& random) const
    {
        const std::size_t place = random() % (bytes.size() + 1);
        const std::size_t length = random() % 8;
        const std::string& other = seeds_[random() % seeds_.size()];
        switch (random() % 6) {
        case 0: bytes.resize(place); break;
        case 1: bytes.erase(place, length); break;
        case 2: bytes.insert(place, bytes.substr(random() % (bytes.size() + 1), length)); break;
        case 3: bytes = bytes.substr(0, place) + other.substr(random() % (other.size() + 1)); break;
        case 4: bytes.insert(place, 1, char(random())); break;
        default:
            if (place < bytes.size()) {
                bytes[place] = char(random());
            }
        }
    }

    std::vector<std::string> seeds_;
    std::size_t size_;
};

std::vector<std::string> files_in(const std::string& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        names.push_back(entry.path().filename());
    }
    return names;
}

/// Passes every alteration to `use`, which must not throw; no file except one of that name may
/// appear in the folder.
template <class Use>
void expect_no_harm(const Alterations& inputs, const Use& use, const ScratchFolder& folder,
                    const std::vector<std::string>& files)
{
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        try {
            use(inputs[i]);
        } catch (const std::exception& error) {
            ADD_FAILURE() << "input " << i << ": " << error.what();
        }
        ASSERT_EQ(files_in(folder / ""), files) << "input " << i;
    }
}

TEST(AnyBytes, AreAcceptedOrRefusedAsAJob)
{
    const ScratchFolder folder;
    const std::string path = folder / "job.toml";
    expect_no_harm(Alterations("job", 2000),
                   [&](const std::string& bytes) { use_as_job(bytes, path); }, folder,
                   {"job.toml"});
}

TEST(AnyBytes, AreAcceptedOrRefusedAsARecord)
{
    const ScratchFolder folder;
    const std::string path = folder / "record.txt";
    expect_no_harm(Alterations("record", 4000),
                   [&](const std::string& bytes) { use_as_record(bytes, path); }, folder,
                   {"record.txt"});
}

TEST(AnyBytes, AreAcceptedOrRefusedAsATable)
{
    const ScratchFolder folder;
    expect_no_harm(Alterations("table", 4000),
                   [&](const std::string& bytes) { use_as_table(bytes); }, folder, {});
}

TEST(AnyBytes, AreAcceptedOrRefusedAsACommandLine)
{
    const ScratchFolder folder;
    expect_no_harm(Alterations("command_line", 2000),
                   [&](const std::string& bytes) { use_as_command_line(bytes); }, folder, {});
}

TEST(AnyHdf5File, IsAcceptedOrRefusedAsAResultFile)
{
    const ScratchFolder folder;
    const std::string path = folder / "input.h5";
    expect_no_harm(Alterations("altered_result_file", 300),
                   [&](const std::string& recipe) {
                       write_altered_result_file(path, recipe, folder / "elsewhere");
                       use_as_result_file(path);
                   },
                   folder, {"input.h5"});
}

/// Exit codes: where a process crashed.
enum CrashOrigin { elsewhere = 97, in_hdf5 = 98 };

/// HDF5 1.10 crashes at some files. Crashes within HDF5 are accepted, others are not.
[[noreturn]] void exit_with_origin_of_crash(int)
{
    void* frames[64];
    const int count = backtrace(frames, 64);
    for (int i = 0; i < count; ++i) {
        Dl_info place = {};
        const bool known = dladdr(frames[i], &place) != 0 && place.dli_fname != nullptr;
        if (known && std::string_view(place.dli_fname).find("libhdf5") != std::string_view::npos) {
            _exit(in_hdf5);
        }
    }
    _exit(elsewhere);
}

/// Reads the inputs from `next` on in a child process, which increments `next` and may crash.
[[noreturn]] void use_all_from(std::size_t& next, const Alterations& inputs,
                               const std::string& path)
{
    constexpr unsigned patience = 200; // [s] for all inputs
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        std::signal(number, exit_with_origin_of_crash);
    }
    alarm(patience);
    for (; next < inputs.size(); ++next) {
        try {
            use_as_result_file(inputs[next], path);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "input %zu: %s\n", next, error.what());
            _exit(elsewhere);
        }
    }
    _exit(0);
}

TEST(AnyBytes, AreAcceptedOrRefusedAsAResultFile)
{
    const ScratchFolder folder;
    const std::string path = folder / "input.h5";
    const Alterations inputs("result_file", 800);
    void* const shared = mmap(nullptr, sizeof(std::size_t), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    std::size_t& next = *new (shared) std::size_t(0);
    int deaths_in_hdf5 = 0;
    for (; next < inputs.size(); ++next) {
        const pid_t child = fork();
        if (child == 0) {
            use_all_from(next, inputs, path);
        }
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFEXITED(status)) << "input " << next << ": signal " << WTERMSIG(status);
        if (WEXITSTATUS(status) == in_hdf5) {
            ++deaths_in_hdf5;
        } else {
            ASSERT_EQ(WEXITSTATUS(status), 0) << "input " << next;
        }
        ASSERT_EQ(files_in(folder / ""), std::vector<std::string>{"input.h5"});
    }
    RecordProperty("deaths_in_hdf5", deaths_in_hdf5);
    munmap(shared, sizeof(std::size_t));
}

} // namespace
} // namespace overturn
