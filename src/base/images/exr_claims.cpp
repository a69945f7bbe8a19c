// The layout of OpenEXR files: four bytes of magic, four of version and flags, then for each part
// attributes (name, type, size, value) up to an empty name; files of several parts end with an
// empty header.

#include "base/images/exr_claims.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr std::int64_t kMaxTexels = std::int64_t(1) << 28;  // 16384², 4 GiB as floats
constexpr std::int64_t kMaxSide = std::int64_t(1) << 24;
constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kSeveralParts = 0x1000;

// Maximum compression ratio per method. Deflate's limit is 1032; run-length and Huffman codes stay
// below; DWA applies a cosine transform first. Methods 0 … 9: none, RLE, ZIPS, ZIP, PIZ, PXR24,
// B44, B44A, DWAA, DWAB.
constexpr std::int64_t kDeflateRatio = 1 << 11, kDwaRatio = 1 << 17;
constexpr std::uint8_t kFirstDwa = 8;
constexpr std::int64_t kMaxLinesOfChunk = 256;                // lines per chunk of DWAB
constexpr std::int64_t kAlwaysTaken = std::int64_t(1) << 20;  // [bytes] allowed for any file
constexpr std::int64_t kOffsetBytes = 8;                      // table entry of a chunk

/// Values of a file, in their order.
class Values {
public:
    Values(std::span<const std::uint8_t> bytes, const std::string& path)
        : left_(bytes),
          path_(&path)
    {
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error(ErrorKind::input, *path_, what);
    }
    bool ended() const { return left_.empty(); }

    template <class T>
    T value()
    {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::string_view text()
    {
        const auto end = std::find(left_.begin(), left_.end(), std::uint8_t(0));
        if (end == left_.end())
            fail("cannot be read as EXR: its header is cut short");
        const auto text = take(std::size_t(end - left_.begin()) + 1);
        return {reinterpret_cast<const char*>(text.data()), text.size() - 1};
    }
    Values part(std::int64_t size)
    {
        if (size < 0)
            fail("cannot be read as EXR: an attribute has a negative size");
        return {take(std::size_t(size)), *path_};
    }

private:
    std::span<const std::uint8_t> take(std::size_t size)
    {
        if (size > left_.size())
            fail("cannot be read as EXR: its header is cut short");
        const auto taken = left_.first(size);
        left_ = left_.subspan(size);
        return taken;
    }

    std::span<const std::uint8_t> left_;
    const std::string* path_;
};

/// Claims of one part.
struct Claims {
    std::int64_t width = 1, height = 1;            ///< [texels]
    std::int64_t tile_width = 0, tile_height = 0;  ///< 0: no tiles
    std::int64_t texel_bytes = 1;                  ///< all channels, uncompressed
    std::int64_t chunks = 0;                       ///< as stated; 0: not stated
    std::int64_t ratio = kDeflateRatio;
};

struct FixedType {
    std::string_view name;
    std::int64_t bytes;
};

/// Types whose values the reader assumes to have their nominal size, whatever the file states.
constexpr FixedType kFixedTypes[] = {
    {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
    {"compression", 1}, {"double", 8},   {"envmap", 1},
    {"float", 4},       {"int", 4},      {"keycode", 28},
    {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
    {"m44f", 64},       {"m44d", 128},   {"rational", 8},
    {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
    {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
    {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1},
};

std::int64_t bytes_per_texel(Values channels)
{
    constexpr std::int64_t kPadding = 4, kSamplings = 8;
    constexpr std::uint32_t kHalf = 1;
    std::int64_t bytes = 0;
    while (!channels.text().empty()) {
        bytes += channels.value<std::uint32_t>() == kHalf ? 2 : 4;
        channels.part(kPadding + kSamplings);
    }
    if (!channels.ended())
        channels.fail("cannot be read as EXR: its list of channels is damaged");
    return std::max(bytes, std::int64_t(1));
}

/// Number of texels of a window's side.
std::int64_t side(std::int32_t first, std::int32_t last)
{
    return std::int64_t(last) - first + 1;
}

void read_window(Values value, Claims& claims)
{
    const auto left = value.value<std::int32_t>(), top = value.value<std::int32_t>(),
               right = value.value<std::int32_t>(), bottom = value.value<std::int32_t>();
    claims.width = side(left, right);
    claims.height = side(top, bottom);
    if (claims.width <= 0 || claims.height <= 0 || claims.width > kMaxSide ||
        claims.height > kMaxSide || claims.width * claims.height > kMaxTexels)
        value.fail("has a header with an impossible size");
}

void check_preview(Values value, std::int64_t size)
{
    constexpr std::int64_t kSides = 8, kPixel = 4;  // [bytes]
    const std::int64_t width = value.value<std::uint32_t>(), height = value.value<std::uint32_t>();
    if (width > size || height > size || kSides + kPixel * width * height != size)
        value.fail("cannot be read as EXR: its preview is damaged");
}

void read_attribute(std::string_view name, std::string_view type, std::int64_t size, Values value,
                    Claims& claims)
{
    for (const FixedType& fixed : kFixedTypes)
        if (type == fixed.name && size != fixed.bytes)
            value.fail("cannot be read as EXR: an attribute has a wrong size");
    if (type == "preview")
        check_preview(value, size);
    if (type == "chlist")
        claims.texel_bytes = bytes_per_texel(value);
    if (name == "dataWindow") {
        read_window(value, claims);
    } else if (name == "compression") {
        claims.ratio = value.value<std::uint8_t>() >= kFirstDwa ? kDwaRatio : kDeflateRatio;
    } else if (name == "chunkCount") {
        claims.chunks = value.value<std::int32_t>();
    } else if (name == "tiles") {
        claims.tile_width = value.value<std::uint32_t>();
        claims.tile_height = value.value<std::uint32_t>();
    }
}

/// Reads one header. Returns false if it is empty.
bool read_header(Values& file, Claims& claims)
{
    bool any = false;
    for (std::string_view name = file.text(); !name.empty(); name = file.text()) {
        any = true;
        const std::string_view type = file.text();
        const std::int64_t size = file.value<std::int32_t>();
        read_attribute(name, type, size, file.part(size), claims);
    }
    return any;
}

/// Minimum number of chunk offsets in the file.
std::int64_t fewest_chunks(const Claims& claims)
{
    const auto parts = [](std::int64_t size, std::int64_t of) { return (size + of - 1) / of; };
    const std::int64_t chunks =
        claims.tile_width > 0 && claims.tile_height > 0
            ? parts(claims.width, claims.tile_width) * parts(claims.height, claims.tile_height)
            : parts(claims.height, kMaxLinesOfChunk);
    return std::max(chunks, claims.chunks);
}

bool is_possible(const Claims& claims, std::int64_t bytes)
{
    if (fewest_chunks(claims) > bytes / kOffsetBytes)
        return false;
    // The reader allocates all texels and one chunk: a tile, or a row of tiles.
    const std::int64_t most = std::max(claims.ratio * bytes, kAlwaysTaken) / claims.texel_bytes;
    const std::int64_t lines = claims.tile_height > 0 ? claims.tile_height : kMaxLinesOfChunk;
    return claims.width * claims.height <= most && lines <= most / claims.width &&
           (claims.tile_width == 0 || lines <= most / claims.tile_width);
}

}  // namespace

void check_exr_claims(const Bytes& bytes, const std::string& path)
{
    Values file(bytes, path);
    if (file.value<std::uint32_t>() != kMagic)
        file.fail("cannot be read as EXR: it does not begin as one");
    const bool several = (file.value<std::uint32_t>() & kSeveralParts) != 0;
    do {
        Claims claims;
        if (!read_header(file, claims))
            return;
        if (!is_possible(claims, std::int64_t(bytes.size())))
            file.fail("claims to hold more texels than its bytes can; it is damaged");
    } while (several);
}

}  // namespace lumel
