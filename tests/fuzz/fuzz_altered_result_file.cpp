// Fuzzes the readers of result files with files that are valid HDF5. KEEP_FILE=PATH in the
// environment keeps the file there.
#include "altered_result_file.hpp"
#include "hostile_input.hpp"
#include "support/scratch_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const overturn::ScratchFolder folder;
    const char* const kept = std::getenv("KEEP_FILE");
    const std::string path = kept != nullptr ? kept : folder / "input.h5";
    overturn::write_altered_result_file(path, {reinterpret_cast<const char*>(data), size},
                                        folder / "elsewhere");
    overturn::use_as_result_file(path);
    return 0;
}
