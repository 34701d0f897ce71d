// Fuzzes the reader of jobs and of --set.
#include "hostile_input.hpp"
#include "support/scratch_folder.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const overturn::ScratchFolder folder;
    overturn::use_as_job({reinterpret_cast<const char*>(data), size}, folder / "job.toml");
    return 0;
}
