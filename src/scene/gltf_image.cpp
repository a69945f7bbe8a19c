#include "scene/gltf_image.h"

#include <algorithm>
#include <climits>
#include <cstring>
#include <memory>

#include <stb/stb_image.h>

#include "core/error.h"

namespace lumel {

namespace {

/// Larger textures do not fit common GPUs either.
constexpr int kLargestSide = 16384;
/// Deflate cannot pack better than 1032 : 1, so a shorter PNG lies about its size.
constexpr std::uint64_t kLargestPngRatio = 1032;
/// A Huffman-coded JPEG spends at least one bit on each block of 8 × 8 pixels.
constexpr std::uint64_t kLargestJpegPixelsPerByte = 8 * 64;

constexpr std::uint8_t kPngSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

[[noreturn]] void fail(const std::string& place, const std::string& what)
{
    throw Error(ErrorKind::input, place, what);
}

bool is_png(const Bytes& bytes)
{
    return bytes.size() >= sizeof kPngSignature &&
           std::memcmp(bytes.data(), kPngSignature, sizeof kPngSignature) == 0;
}

bool is_jpeg(const Bytes& bytes)
{
    return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

std::uint32_t big_endian(const Bytes& bytes, std::size_t offset)
{
    return std::uint32_t(bytes[offset]) << 24 | std::uint32_t(bytes[offset + 1]) << 16 |
           std::uint32_t(bytes[offset + 2]) << 8 | bytes[offset + 3];
}

struct Claim {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    bool possible = true;  ///< the file has enough bytes to encode that much
};

Claim png_claim(const Bytes& bytes, const std::string& place)
{
    constexpr std::size_t kHeaderEnd = 29;  // signature, then IHDR up to its interlace method
    if (bytes.size() < kHeaderEnd || std::memcmp(bytes.data() + 12, "IHDR", 4) != 0)
        fail(place, "is a PNG without a header");
    Claim claim{big_endian(bytes, 16), big_endian(bytes, 20)};
    const std::uint8_t color_type = bytes[25];
    const std::uint64_t channels = color_type == 2   ? 3
                                   : color_type == 4 ? 2
                                   : color_type == 6 ? 4
                                                     : 1;
    const std::uint64_t row_bytes = (claim.width * channels * bytes[24] + 7) / 8;
    claim.possible =
        claim.height == 0 || row_bytes <= kLargestPngRatio * bytes.size() / claim.height;
    return claim;
}

Claim jpeg_claim(const Bytes& bytes, const std::string& place)
{
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels))
        fail(place,
             std::string("is a JPEG without a readable header (") + stbi_failure_reason() + ")");
    Claim claim{std::uint64_t(width), std::uint64_t(height)};
    claim.possible = claim.width * claim.height <= kLargestJpegPixelsPerByte * bytes.size();
    return claim;
}

/// The decoder fills what is missing with grey; an end marker after the last scan proves the rest.
bool jpeg_is_complete(const Bytes& bytes)
{
    // Walk the segments to the first scan; only after it does FF D9 mean the end of this image.
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && bytes[at] == 0xFF && bytes[at + 1] != 0xDA) {
        if (bytes[at + 1] == 0xFF) {
            ++at;
            continue;
        }
        at += 2 + (std::size_t(bytes[at + 2]) << 8 | bytes[at + 3]);
    }
    if (at >= bytes.size())
        return false;
    constexpr std::uint8_t kEnd[] = {0xFF, 0xD9};
    return std::search(bytes.begin() + std::ptrdiff_t(at), bytes.end(), std::begin(kEnd),
                       std::end(kEnd)) != bytes.end();
}

}  // namespace

Texture decode_image(const Bytes& bytes, const std::string& place)
{
    const bool png = is_png(bytes);
    if (!png && !is_jpeg(bytes))
        fail(place, "is neither a PNG nor a JPEG image");
    if (bytes.size() > INT_MAX)
        fail(place, "is larger than 2 GiB");

    // Believe the claimed size only if it can be true, before any memory is taken for it.
    const Claim claim = png ? png_claim(bytes, place) : jpeg_claim(bytes, place);
    const std::string size = std::to_string(claim.width) + " x " + std::to_string(claim.height);
    if (claim.width == 0 || claim.height == 0)
        fail(place, "claims " + size + " pixels");
    if (claim.width > kLargestSide || claim.height > kLargestSide)
        fail(place, "claims " + size + " pixels; at most " + std::to_string(kLargestSide) +
                        " a side are read");
    if (!claim.possible)
        fail(place, "claims " + size + " pixels, more than its " + std::to_string(bytes.size()) +
                        " bytes can hold");
    if (!png && !jpeg_is_complete(bytes))
        fail(place, "is a JPEG image that is cut short");

    Texture texture;
    constexpr int kChannels = 4;
    int channels_in_file = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &texture.width, &texture.height,
                              &channels_in_file, kChannels),
        stbi_image_free);
    if (!pixels)
        fail(place, std::string("cannot be decoded as ") + (png ? "PNG" : "JPEG") + " (" +
                        stbi_failure_reason() + ")");
    const std::size_t count = std::size_t(texture.width) * std::size_t(texture.height) * kChannels;
    texture.rgba.assign(pixels.get(), pixels.get() + count);
    return texture;
}

}  // namespace lumel
