// Fuzzes the readers of result files, with files that are sound to HDF5.
#include "altered_result_file.hpp"
#include "hostile_input.hpp"
#include "support/scratch_folder.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const overturn::ScratchFolder folder;
    const std::string path = folder / "input.h5";
    overturn::write_altered_result_file(path, {reinterpret_cast<const char*>(data), size},
                                        folder / "elsewhere");
    overturn::use_as_result_file(path);
    return 0;
}
