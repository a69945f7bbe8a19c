#include "scene/load/webp_image.h"

#include <cstring>

#include <webp/decode.h>

#include "base/core/error.h"

namespace lumel {
namespace {

/// Equal pixels take no bytes, so the size gives no bound: any file may have 4096 x 4096 pixels,
/// and larger images this number per byte. Lossy images take three bits per block of 16 x 16
/// pixels.
constexpr std::uint64_t kFreePixels = std::uint64_t(1) << 24;
constexpr std::uint64_t kPixelsPerByte = 1024;
constexpr std::size_t kRgba = 4;

[[noreturn]] void refuse_webp(const std::string& place, const std::string& what)
{
    throw Error(ErrorKind::input, place, what);
}

}  // namespace

bool is_webp(const Bytes& bytes)
{
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

Texture decode_webp(const Bytes& bytes, const std::string& place)
{
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
        refuse_webp(place, "is a WebP image without a readable header");
    if (features.has_animation)
        refuse_webp(place, "is an animated WebP image");
    const std::uint64_t pixels = std::uint64_t(features.width) * std::uint64_t(features.height);
    if (pixels > kFreePixels && pixels > kPixelsPerByte * bytes.size())
        refuse_webp(place, "claims " + std::to_string(features.width) + " x " +
                               std::to_string(features.height) + " pixels, far more than its " +
                               std::to_string(bytes.size()) + " bytes can be expected to hold");

    Texture texture{features.width, features.height, {}};
    texture.rgba.resize(std::size_t(pixels) * kRgba);
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), texture.rgba.data(), texture.rgba.size(),
                            int(std::size_t(texture.width) * kRgba)))
        refuse_webp(place, "cannot be decoded as WebP: it is broken or cut short");
    return texture;
}

std::string webp_version()
{
    const int version = WebPGetDecoderVersion();  // one byte each
    return std::to_string(version >> 16) + "." + std::to_string(version >> 8 & 0xff) + "." +
           std::to_string(version & 0xff);
}

}  // namespace lumel
