#pragma once
// Changes to inputs that keep what a reader checks first, so that they get past it.

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

/// libFuzzer's own changes, in place. Returns the new size, at most `room`.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

namespace lumel::fuzz {

using Random = std::minstd_rand;

/// libFuzzer's own changes to bytes, which may grow to `room`.
inline void mutate(std::vector<std::uint8_t>& bytes, std::size_t room)
{
    const std::size_t size = bytes.size();
    bytes.resize(std::max(size, room));
    bytes.resize(LLVMFuzzerMutate(bytes.data(), size, bytes.size()));
}

/// Changes JSON text: a value, a member, or the text itself where it is no JSON.
void mutate_json(std::vector<std::uint8_t>& text, std::size_t room, Random& random);

}  // namespace lumel::fuzz
