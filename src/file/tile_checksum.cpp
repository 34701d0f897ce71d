#include "tile_checksum.hpp"

#include <xxhash.h>

#include <bit>
#include <memory>

namespace overturn {

static_assert(std::endian::native == std::endian::little, "values are hashed as they are stored");

std::uint64_t tile_checksum(const std::vector<FieldValues>& fields)
{
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(),
                                                                           XXH64_freeState);
    XXH64_reset(state.get(), 0);
    for (const FieldValues& field : fields) {
        std::visit(
            [&](const auto& values) {
                XXH64_update(state.get(), values.data(), values.size() * sizeof(values[0]));
            },
            field);
    }
    const std::uint64_t hash = XXH64_digest(state.get());
    return hash == not_computed_checksum ? 1 : hash;
}

} // namespace overturn
