// Fuzzes the reader of recorded motions.
#include "hostile_input.hpp"
#include "support/scratch_folder.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const overturn::ScratchFolder folder;
    overturn::use_as_record({reinterpret_cast<const char*>(data), size}, folder / "record.txt");
    return 0;
}
