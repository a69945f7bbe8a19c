#pragma once
// A reader of the KTX2 files that scene.glb holds, by the offsets of the specification: shares no
// code with the writer.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

#include <glm/gtc/packing.hpp>
#include <zstd.h>

#include "base/core/image.h"

namespace lumel::test {

inline std::uint32_t word_at(std::span<const std::uint8_t> file, std::size_t offset)
{
    std::uint32_t word = 0;
    if (offset + sizeof word > file.size())
        throw std::runtime_error("the file ends early");
    std::memcpy(&word, file.data() + offset, sizeof word);
    return word;
}

inline float half_at(std::span<const std::uint8_t> texels, std::size_t offset)
{
    std::uint16_t half = 0;
    std::memcpy(&half, texels.data() + offset, sizeof half);
    return glm::unpackHalf1x16(half);
}

inline float shared_exponent_at(std::span<const std::uint8_t> texels, std::size_t offset,
                                std::size_t channel)
{
    const std::uint32_t word = word_at(texels, offset);
    return std::ldexp(float(word >> (9 * channel) & 511u), int(word >> 27) - 15 - 9);
}

/// RGB of R16G16B16A16_SFLOAT (97) or E5B9G9R9_UFLOAT_PACK32 (123).
inline Image decode_ktx2(std::span<const std::uint8_t> file)
{
    const std::uint32_t format = word_at(file, 12);
    Image image(int(word_at(file, 20)), int(word_at(file, 24)), 3);
    const std::size_t count = image.values.size() / 3;
    const std::size_t texel = format == 97 ? 8 : 4;
    if ((format != 97 && format != 123) || word_at(file, 40) != 1 || word_at(file, 44) != 2)
        throw std::runtime_error("not the format that is written");
    std::vector<std::uint8_t> texels(count * texel);
    const std::size_t size = ZSTD_decompress(
        texels.data(), texels.size(), file.subspan(word_at(file, 80)).data(), word_at(file, 88));
    if (size != texels.size() || size != word_at(file, 96))
        throw std::runtime_error("texels cannot be unpacked");
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            image.values[3 * i + c] = format == 97 ? half_at(texels, i * texel + 2 * c)
                                                   : shared_exponent_at(texels, i * texel, c);
    return image;
}

}  // namespace lumel::test
