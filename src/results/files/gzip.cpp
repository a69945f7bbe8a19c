#include "results/files/gzip.h"

#include <algorithm>
#include <limits>

#include <zlib.h>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr int kGzip = 16 + MAX_WBITS;  // window bits for gzip in deflateInit2()
constexpr int kMemoryLevel = 8;        // zlib's own default
// Images are compressed already, and geometry hardly shrinks beyond this.
constexpr int kLevel = 6;

}  // namespace

std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes)
{
    const auto fail = [] { throw Error(ErrorKind::output, "", "data cannot be compressed"); };
    z_stream stream{};
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
        fail();
    std::vector<std::uint8_t> packed(deflateBound(&stream, uLong(bytes.size())));
    stream.next_in = const_cast<Bytef*>(bytes.data());  // zlib only reads it
    stream.next_out = packed.data();
    // zlib counts what it is given at once in 32 bits.
    constexpr std::size_t kMostAtOnce = std::numeric_limits<uInt>::max();
    std::size_t in_left = bytes.size(), out_left = packed.size();
    int state = Z_OK;
    while (state == Z_OK) {
        const auto in = uInt(std::min(in_left, kMostAtOnce)),
                   out = uInt(std::min(out_left, kMostAtOnce));
        stream.avail_in = in;
        stream.avail_out = out;
        state = deflate(&stream, in == in_left ? Z_FINISH : Z_NO_FLUSH);
        in_left -= in - stream.avail_in;
        out_left -= out - stream.avail_out;
    }
    packed.resize(packed.size() - out_left);
    deflateEnd(&stream);
    if (state != Z_STREAM_END)
        fail();
    return packed;
}

}  // namespace lumel
