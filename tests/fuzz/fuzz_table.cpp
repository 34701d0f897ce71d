// Fuzzes the reader of tables.
#include "hostile_input.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    overturn::use_as_table({reinterpret_cast<const char*>(data), size});
    return 0;
}
