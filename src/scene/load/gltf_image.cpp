#include "scene/load/gltf_image.h"

#include <algorithm>
#include <climits>
#include <cstring>
#include <memory>
#include <optional>

#include <stb/stb_image.h>

#include "base/core/error.h"
#include "scene/load/webp_image.h"

namespace lumel {

namespace {

/// Common GPUs do not support larger textures.
constexpr int kLargestSide = 16384;
/// Deflate's maximum ratio is 1032 : 1; a shorter PNG has a false size.
constexpr std::uint64_t kLargestPngRatio = 1032;
/// A Huffman-coded JPEG has at least one bit per block of 8 × 8 pixels.
constexpr std::uint64_t kLargestJpegPixelsPerByte = 8 * 64;

constexpr std::uint8_t kPngSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

[[noreturn]] void refuse_image(const std::string& place, const std::string& what)
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
    bool possible = true;  ///< the file has enough bytes for that size
};

Claim png_claim(const Bytes& bytes, const std::string& place)
{
    constexpr std::size_t kHeaderEnd = 29;  // signature, then IHDR up to its interlace method
    if (bytes.size() < kHeaderEnd || std::memcmp(bytes.data() + 12, "IHDR", 4) != 0)
        refuse_image(place, "is a PNG without a header");
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

/// True if every chunk has its stated length. The decoder allocates by it.
bool png_is_complete(const Bytes& bytes)
{
    constexpr std::size_t kFrame = 12;  // length, type and checksum
    for (std::size_t at = sizeof kPngSignature; at < bytes.size();) {
        const std::size_t left = bytes.size() - at;
        if (left < kFrame || big_endian(bytes, at) > left - kFrame)
            return false;
        if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0)
            return true;
        at += kFrame + big_endian(bytes, at);
    }
    return false;
}

/// Reason of the last failure according to stb, if it has one; may quote the file.
std::string why_not()
{
    const char* reason = stbi_failure_reason();
    std::string text = reason ? reason : "damaged data";
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

Claim jpeg_claim(const Bytes& bytes, const std::string& place)
{
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels))
        refuse_image(place, std::string("is a JPEG without a readable header (") + why_not() + ")");
    Claim claim{std::uint64_t(width), std::uint64_t(height)};
    claim.possible = claim.width * claim.height <= kLargestJpegPixelsPerByte * bytes.size();
    return claim;
}

/// Offset of the texels of a Radiance image, after the size line.
std::size_t hdr_data_begin(const Bytes& bytes)
{
    constexpr std::uint8_t kBlankLine[] = {'\n', '\n'};
    const auto blank =
        std::search(bytes.begin(), bytes.end(), std::begin(kBlankLine), std::end(kBlankLine));
    if (blank == bytes.end())
        return bytes.size();
    const auto size_line = std::find(blank + 2, bytes.end(), '\n');
    return std::size_t(size_line - bytes.begin()) + (size_line != bytes.end());
}

/// End of a run-length coded row of a Radiance image; nullopt if it is broken or truncated. The
/// decoder would loop forever on runs of length 0.
std::optional<std::size_t> hdr_row_end(const Bytes& bytes, std::size_t at, int width)
{
    constexpr int kChannels = 4;
    constexpr int kLongestDump = 128;  // larger counts are runs
    if (at + 4 > bytes.size() || bytes[at] != 2 || bytes[at + 1] != 2 ||
        (bytes[at + 2] << 8 | bytes[at + 3]) != width)
        return std::nullopt;
    at += 4;
    for (int channel = 0; channel < kChannels; ++channel)
        for (int left = width; left > 0;) {
            const int count = at < bytes.size() ? bytes[at] : 0;
            const bool run = count > kLongestDump;
            const int length = run ? count - kLongestDump : count;
            at += std::size_t(1) + std::size_t(run ? 1 : length);
            left -= length;
            if (length == 0 || left < 0 || at > bytes.size())
                return std::nullopt;
        }
    return at;
}

/// Rows of 8 to 32767 texels that begin with 2 2 are run-length coded by channel; others take four
/// bytes per texel.
Claim hdr_claim(const Bytes& bytes, const std::string& place)
{
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_is_hdr_from_memory(bytes.data(), int(bytes.size())) ||
        !stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels))
        refuse_image(place, "is not a readable Radiance image");
    Claim claim{std::uint64_t(width), std::uint64_t(height)};
    std::optional<std::size_t> at = hdr_data_begin(bytes);
    const bool packed = width >= 8 && width < 32768 && *at + 2 < bytes.size() && bytes[*at] == 2 &&
                        bytes[*at + 1] == 2 && bytes[*at + 2] < 128;
    if (packed)
        for (int row = 0; row < height && at; ++row)
            at = hdr_row_end(bytes, *at, width);
    else
        claim.possible = 4 * claim.width * claim.height <= bytes.size() - *at;
    if (!at)
        refuse_image(place, "is a Radiance image that is broken or cut short");
    return claim;
}

/// Throws if a claimed size is impossible.
void check_claim(const Claim& claim, std::size_t bytes, const std::string& place)
{
    const std::string size = std::to_string(claim.width) + " x " + std::to_string(claim.height);
    if (claim.width == 0 || claim.height == 0)
        refuse_image(place, "claims " + size + " pixels");
    if (claim.width > kLargestSide || claim.height > kLargestSide)
        refuse_image(place, "claims " + size + " pixels; at most " + std::to_string(kLargestSide) +
                                " a side are read");
    if (!claim.possible)
        refuse_image(place, "claims " + size + " pixels, more than its " + std::to_string(bytes) +
                                " bytes can hold");
}

/// Looks for an end marker after the last scan: the decoder fills missing data with grey.
bool jpeg_is_complete(const Bytes& bytes)
{
    // FF D9 is the end of this image only after the first scan, so segments are skipped up to it.
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
    if (!png && !is_jpeg(bytes) && !is_webp(bytes))
        refuse_image(place, "is neither a PNG nor a JPEG nor a WebP image");
    if (bytes.size() > INT_MAX)
        refuse_image(place, "is larger than 2 GiB");
    if (is_webp(bytes))
        return decode_webp(bytes, place);

    // Verifies the claimed size before memory is allocated for it.
    const Claim claim = png ? png_claim(bytes, place) : jpeg_claim(bytes, place);
    check_claim(claim, bytes.size(), place);
    if (png ? !png_is_complete(bytes) : !jpeg_is_complete(bytes))
        refuse_image(place,
                     std::string("is a ") + (png ? "PNG" : "JPEG") + " image that is cut short");

    Texture texture;
    constexpr int kChannels = 4;
    int channels_in_file = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &texture.width, &texture.height,
                              &channels_in_file, kChannels),
        stbi_image_free);
    if (!pixels)
        refuse_image(place, std::string("cannot be decoded as ") + (png ? "PNG" : "JPEG") + " (" +
                                why_not() + ")");
    const std::size_t count = std::size_t(texture.width) * std::size_t(texture.height) * kChannels;
    texture.rgba.assign(pixels.get(), pixels.get() + count);
    return texture;
}

Image decode_hdr(const Bytes& bytes, const std::string& place)
{
    if (bytes.size() > INT_MAX)
        refuse_image(place, "is larger than 2 GiB");
    check_claim(hdr_claim(bytes, place), bytes.size(), place);

    Image image;
    image.channels = 3;
    int channels_in_file = 0;
    const std::unique_ptr<float, void (*)(void*)> pixels(
        stbi_loadf_from_memory(bytes.data(), int(bytes.size()), &image.width, &image.height,
                               &channels_in_file, image.channels),
        stbi_image_free);
    if (!pixels)
        refuse_image(place, std::string("cannot be decoded as Radiance image (") + why_not() + ")");
    const std::size_t count =
        std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels);
    image.values.assign(pixels.get(), pixels.get() + count);
    return image;
}

}  // namespace lumel
