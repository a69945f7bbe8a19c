#include "results/page/packed_text.h"

#include <vector>

#include <zlib.h>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr int kGzip = 16 + MAX_WBITS;  // window bits for gzip in deflateInit2()
constexpr int kMemoryLevel = 8;        // zlib's own default
// Images are compressed already, and geometry hardly shrinks beyond this.
constexpr int kLevel = 6;

std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes)
{
    z_stream stream{};
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
        throw Error(ErrorKind::output, "", "a page cannot be compressed");
    std::vector<std::uint8_t> packed(deflateBound(&stream, uLong(bytes.size())));
    stream.next_in = const_cast<Bytef*>(bytes.data());  // zlib only reads it
    stream.avail_in = uInt(bytes.size());
    stream.next_out = packed.data();
    stream.avail_out = uInt(packed.size());
    const int state = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (state != Z_STREAM_END)
        throw Error(ErrorKind::output, "", "a page cannot be compressed");
    return packed;
}

std::string base64(std::span<const std::uint8_t> bytes)
{
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr int kBits = 6;  // per digit
    constexpr std::uint32_t kMask = (1u << kBits) - 1;
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
        std::uint32_t group = 0;
        for (std::size_t byte = 0; byte < 3; ++byte)
            group = group << 8 | (byte < left ? bytes[i + byte] : 0u);
        for (std::size_t digit = 0; digit < 4; ++digit)
            text += digit <= left ? kDigits[group >> (kBits * int(3 - digit)) & kMask] : '=';
    }
    return text;
}

}  // namespace

std::string packed_text(std::span<const std::uint8_t> bytes)
{
    return base64(gzip(bytes));
}

}  // namespace lumel
