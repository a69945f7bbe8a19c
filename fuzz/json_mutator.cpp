#include <algorithm>

#include "mutate.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t room, unsigned seed)
{
    lumel::fuzz::Random random(seed);
    std::vector<std::uint8_t> text(data, data + size);
    lumel::fuzz::mutate_json(text, room, random);
    std::copy(text.begin(), text.end(), data);
    return text.size();
}
