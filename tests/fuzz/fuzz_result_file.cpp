// Fuzzes the readers of result files with raw bytes.
#include "hostile_input.hpp"
#include "support/scratch_folder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

/// A block of metadata that ends with its checksum.
struct Block {
    std::size_t begin;
    std::size_t checksum;
};

std::uint32_t number_at(const std::uint8_t* data)
{
    std::uint32_t number = 0;
    std::memcpy(&number, data, sizeof number);
    return number;
}

/// The checksum of HDF5's metadata: Bob Jenkins's lookup3, hashlittle().
std::uint32_t checksum_of(const std::uint8_t* data, std::size_t size)
{
    using std::rotl;
    std::uint32_t a = 0xdeadbeef + std::uint32_t(size);
    std::uint32_t b = a;
    std::uint32_t c = a;
    for (; size > 12; size -= 12, data += 12) {
        a += number_at(data);
        b += number_at(data + 4);
        c += number_at(data + 8);
        a -= c, a ^= rotl(c, 4), c += b;
        b -= a, b ^= rotl(a, 6), a += c;
        c -= b, c ^= rotl(b, 8), b += a;
        a -= c, a ^= rotl(c, 16), c += b;
        b -= a, b ^= rotl(a, 19), a += c;
        c -= b, c ^= rotl(b, 4), b += a;
    }
    std::array<std::uint8_t, 12> rest{};
    std::copy_n(data, size, rest.begin());
    a += number_at(rest.data());
    b += number_at(rest.data() + 4);
    c += number_at(rest.data() + 8);
    c ^= b, c -= rotl(b, 14);
    a ^= c, a -= rotl(c, 11);
    b ^= a, b -= rotl(a, 25);
    c ^= b, c -= rotl(b, 16);
    a ^= c, a -= rotl(c, 4);
    b ^= a, b -= rotl(a, 14);
    c ^= b, c -= rotl(b, 24);
    return c;
}

/// Returns the block that begins at `begin`, if one of a usual length does.
std::vector<Block> block_at(const std::uint8_t* data, std::size_t size, std::size_t begin)
{
    constexpr std::size_t longest = 1024;
    for (std::size_t end = begin + 8; end + 4 <= size && end < begin + longest; ++end) {
        if (number_at(data + end) == checksum_of(data + begin, end - begin)) {
            return {{begin, end}};
        }
    }
    return {};
}

/// Returns any block, if there is one.
std::vector<Block> any_block(const std::uint8_t* data, std::size_t size, std::mt19937& random)
{
    constexpr std::array<std::string_view, 6> signatures{"OHDR", "OCHK", "FRHP",
                                                         "BTHD", "BTLF", "BTIN"};
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::string_view signature = signatures[random() % signatures.size()];
    std::size_t begin = bytes.find(signature, random() % (size + 1));
    begin = begin == bytes.npos ? bytes.find(signature) : begin;
    return begin == bytes.npos ? std::vector<Block>{} : block_at(data, size, begin);
}

} // namespace

// HDF5 refuses metadata with a wrong checksum, so that altered metadata would rarely be read: every
// other time they get a correct one.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed)
{
    std::mt19937 random(seed);
    const std::vector<Block> blocks =
        random() % 2 == 0 ? any_block(data, size, random) : std::vector<Block>{};
    if (blocks.empty()) {
        return LLVMFuzzerMutate(data, size, most);
    }
    const auto [begin, checksum] = blocks.front();
    for (std::uint64_t i = 0, times = 1 + random() % 3; i < times; ++i) {
        const std::size_t place = begin + 4 + random() % (checksum - begin - 4);
        constexpr std::array<std::uint8_t, 6> limits{0, 1, 0x7f, 0x80, 0xfe, 0xff};
        data[place] = random() % 2 == 0 ? std::uint8_t(random()) : limits[random() % limits.size()];
    }
    const std::uint32_t right = checksum_of(data + begin, checksum - begin);
    std::memcpy(data + checksum, &right, sizeof right);
    return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const overturn::ScratchFolder folder;
    overturn::use_as_result_file({reinterpret_cast<const char*>(data), size}, folder / "input.h5");
    return 0;
}
