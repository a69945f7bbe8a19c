#include "results/files/gzip.h"

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
    stream.avail_in = uInt(bytes.size());
    stream.next_out = packed.data();
    stream.avail_out = uInt(packed.size());
    const int state = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (state != Z_STREAM_END)
        fail();
    return packed;
}

}  // namespace lumel
