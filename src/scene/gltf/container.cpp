#include "scene/gltf/container.h"

#include <cstring>

#include "base/core/error.h"

namespace lumel {

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;
constexpr std::uint32_t kVersion = 2;

std::uint32_t read_u32(const Bytes& bytes, std::size_t offset)
{
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

[[noreturn]] void refuse_container(const std::string& path, const std::string& what)
{
    throw Error(ErrorKind::input, path, what);
}

/// Checks the 12-byte header; returns the size of the container [bytes].
std::size_t container_size(const std::string& path, const Bytes& bytes)
{
    if (bytes.size() < kHeaderSize)
        refuse_container(path, "is cut short: the GLB header is not complete");
    const std::uint32_t version = read_u32(bytes, 4);
    if (version != kVersion)
        refuse_container(path, "is GLB version " + std::to_string(version) +
                                   ", but only version 2 is read");
    const std::size_t length = read_u32(bytes, 8);
    if (length > bytes.size())
        refuse_container(path, "is cut short: its GLB header states " + std::to_string(length) +
                                   " bytes, but the file has " + std::to_string(bytes.size()));
    if (length < kHeaderSize + kChunkHeaderSize)
        refuse_container(path,
                         "has a GLB header with the impossible length " + std::to_string(length));
    return length;
}

}  // namespace

bool is_glb(const Bytes& bytes)
{
    return bytes.size() >= 4 && read_u32(bytes, 0) == kMagic;
}

GlbChunks split_glb(const std::string& path, const Bytes& bytes)
{
    const std::size_t end = container_size(path, bytes);
    GlbChunks chunks;
    std::size_t offset = kHeaderSize;
    for (int chunk = 0; offset < end; ++chunk) {
        const std::string name = "GLB chunk " + std::to_string(chunk);
        if (end - offset < kChunkHeaderSize)
            refuse_container(path, "is cut short inside the header of " + name);
        const std::size_t size = read_u32(bytes, offset);
        const std::uint32_t type = read_u32(bytes, offset + 4);
        offset += kChunkHeaderSize;
        if (size > end - offset)
            refuse_container(path, name + " has a stated length of " + std::to_string(size) +
                                       " bytes, but only " + std::to_string(end - offset) +
                                       " are there");
        if (size % 4 != 0)
            refuse_container(path, name + " has a length that is not a multiple of 4");

        if ((chunk == 0) != (type == kJsonChunk))
            refuse_container(path, chunk == 0 ? "its first GLB chunk is not JSON"
                                              : "it has more than one JSON chunk");
        if (chunk == 0) {
            chunks.json_offset = offset;
            chunks.json_size = size;
        } else if (type == kBinaryChunk) {
            if (chunk != 1)
                refuse_container(path, "its BIN chunk is not the second one");
            chunks.binary_offset = offset;
            chunks.binary_size = size;
        }
        offset += size;
    }
    return chunks;
}

}  // namespace lumel
