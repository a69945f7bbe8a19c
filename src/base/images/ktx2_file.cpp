// KTX 2.0: one level of floating-point texels, compressed by Zstandard.
//
// Follows the Khronos KTX File Format Specification 2.0; its data format descriptor follows the
// Khronos Data Format Specification 1.3.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <half.h>
#include <zstd.h>

#include "base/core/error.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

constexpr std::array<std::uint8_t, 12> kIdentifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                      '0',  0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kHeaderSize = 104;  // identifier, header, index and one level [bytes]
constexpr std::uint32_t kZstandard = 2;     // supercompressionScheme

// Higher levels hardly reduce the size.
constexpr int kCompressionLevel = 9;

// Data format descriptor.
constexpr std::uint32_t kBasicBlockSize = 24, kSampleSize = 16;  // [bytes]
constexpr std::uint8_t kModelRgb = 1, kPrimariesRec709 = 1, kTransferLinear = 1;
constexpr std::uint8_t kFloat = 0x80, kSigned = 0x40, kExponent = 0x20, kAlpha = 15;

// Shared exponents, as in EXT_texture_shared_exponent.
constexpr int kMantissaBits = 9, kExponentBits = 5, kExponentBias = 15;
constexpr float kLargestShared = 65408.0f;  // (2^9 - 1) / 2^9 * 2^(31 - 15)

// Numbers in the byte order of the file.
class LittleEndian {
public:
    void add(std::uint64_t number, int bytes)
    {
        for (int i = 0; i < bytes; ++i)
            bytes_.push_back(static_cast<unsigned char>(number >> (8 * i)));
    }
    void word(std::uint32_t number) { add(number, 4); }
    std::vector<unsigned char>& all() { return bytes_; }

private:
    std::vector<unsigned char> bytes_;
};

// A channel, or its exponent, within a texel.
struct Sample {
    std::uint32_t offset = 0, length = 0;  // [bits]
    std::uint8_t channel = 0;              // with qualifiers
    std::uint32_t lower = 0, upper = 0;    // codes of 0 (or -1) and of 1
};

// Texel format fields of the header.
struct TexelLayout {
    std::uint32_t vulkan_format = 0;
    std::uint32_t word_size = 0;   // unit of byte order [bytes]
    std::uint32_t texel_size = 0;  // [bytes]
    std::vector<Sample> samples;
};

TexelLayout half_layout()
{
    TexelLayout layout{.vulkan_format = 97, .word_size = 2, .texel_size = 8, .samples = {}};
    for (const std::uint32_t c : {0, 1, 2, 3})
        layout.samples.push_back(
            {16 * c, 16, std::uint8_t((c == 3 ? kAlpha : c) | kFloat | kSigned),
             std::bit_cast<std::uint32_t>(-1.0f), std::bit_cast<std::uint32_t>(1.0f)});
    return layout;
}

TexelLayout shared_exponent_layout()
{
    // The specification's values for this format.
    constexpr std::uint32_t kOne = 8448, kLargestExponent = 31;
    TexelLayout layout{.vulkan_format = 123, .word_size = 4, .texel_size = 4, .samples = {}};
    for (const std::uint32_t c : {0, 1, 2}) {
        layout.samples.push_back({kMantissaBits * c, kMantissaBits, std::uint8_t(c), 0, kOne});
        layout.samples.push_back({3 * kMantissaBits, kExponentBits, std::uint8_t(c | kExponent),
                                  kExponentBias, kLargestExponent});
    }
    return layout;
}

void add_descriptor(LittleEndian& out, const TexelLayout& layout)
{
    const std::uint32_t size = kBasicBlockSize + kSampleSize * std::uint32_t(layout.samples.size());
    out.word(4 + size);
    out.word(0);                 // Khronos, basic block
    out.word(2 | (size << 16));  // version 1.3
    for (const std::uint8_t byte : {kModelRgb, kPrimariesRec709, kTransferLinear, std::uint8_t(0)})
        out.add(byte, 1);
    out.word(0);                    // blocks of one texel
    out.add(layout.texel_size, 8);  // one plane
    for (const Sample& sample : layout.samples) {
        out.add(sample.offset, 2);
        out.add(sample.length - 1, 1);
        out.add(sample.channel, 1);
        out.word(0);  // position in the block
        out.word(sample.lower);
        out.word(sample.upper);
    }
}

void add_half_texel(LittleEndian& out, const float* rgb)
{
    for (int c = 0; c < 3; ++c)
        out.add(half(std::fmin(std::fmax(rgb[c], 0.0f), float(HALF_MAX))).bits(), 2);
    out.add(half(1.0f).bits(), 2);
}

void add_shared_texel(LittleEndian& out, const float* rgb)
{
    std::array<float, 3> value{};
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = std::fmin(std::fmax(rgb[c], 0.0f), kLargestShared);
    const float largest = std::max({value[0], value[1], value[2]});
    int exponent = std::max(-kExponentBias - 1, largest > 0.0f ? std::ilogb(largest) : -1000) + 1 +
                   kExponentBias;
    const auto unit = [&] { return std::ldexp(1.0f, exponent - kExponentBias - kMantissaBits); };
    if (std::lround(largest / unit()) == 1 << kMantissaBits)
        ++exponent;
    std::uint32_t texel = std::uint32_t(exponent) << (3 * kMantissaBits);
    for (int c = 0; c < 3; ++c)
        texel |= std::uint32_t(std::lround(value[std::size_t(c)] / unit())) << (kMantissaBits * c);
    out.word(texel);
}

std::vector<unsigned char> compress(const std::vector<unsigned char>& bytes)
{
    std::vector<unsigned char> result(ZSTD_compressBound(bytes.size()));
    const std::size_t size =
        ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kCompressionLevel);
    if (ZSTD_isError(size))
        throw Error(ErrorKind::output, "",
                    std::string("texels cannot be compressed: ") + ZSTD_getErrorName(size));
    result.resize(size);
    return result;
}

}  // namespace

std::vector<unsigned char> encode_ktx2(const Image& image, FloatTexel texel)
{
    const bool halves = texel == FloatTexel::half;
    const TexelLayout layout = halves ? half_layout() : shared_exponent_layout();
    LittleEndian texels;
    texels.all().reserve(image.values.size() / std::size_t(image.channels) * layout.texel_size);
    for (std::size_t i = 0; i < image.values.size(); i += std::size_t(image.channels))
        (halves ? add_half_texel : add_shared_texel)(texels, image.values.data() + i);
    const std::vector<unsigned char> level = compress(texels.all());

    LittleEndian descriptor;
    add_descriptor(descriptor, layout);
    const auto descriptor_size = std::uint32_t(descriptor.all().size());

    LittleEndian out;
    out.all().assign(kIdentifier.begin(), kIdentifier.end());
    for (const std::uint32_t word : {layout.vulkan_format, layout.word_size,
                                     std::uint32_t(image.width), std::uint32_t(image.height), 0u,
                                     0u, 1u, 1u, kZstandard})  // 2D, no array, one face, one level
        out.word(word);
    for (const std::uint32_t word : {kHeaderSize, descriptor_size, 0u, 0u})
        out.word(word);
    for (const std::uint64_t word :
         {std::uint64_t(0), std::uint64_t(0), std::uint64_t(kHeaderSize + descriptor_size),
          std::uint64_t(level.size()), std::uint64_t(texels.all().size())})
        out.add(word, 8);
    out.all().insert(out.all().end(), descriptor.all().begin(), descriptor.all().end());
    out.all().insert(out.all().end(), level.begin(), level.end());
    return std::move(out.all());
}

std::string zstd_version()
{
    return ZSTD_versionString();
}

}  // namespace lumel
