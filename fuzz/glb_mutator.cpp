// Changes a .glb by its chunks, and states their sizes anew; a .gltf as JSON.

#include <algorithm>

#include "base/core/error.h"
#include "mutate.h"
#include "scene/gltf/container.h"

namespace lumel::fuzz {
namespace {

constexpr std::size_t kHeads = 12 + 8 + 8;  ///< of the file and of two chunks [bytes]
constexpr unsigned kWhole = 16;             ///< one in this many changes is to any byte

void put(Bytes& to, std::uint32_t value)
{
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    to.insert(to.end(), bytes, bytes + sizeof value);
}

void put_chunk(Bytes& to, const char* type, Bytes chunk, std::uint8_t filler)
{
    chunk.resize((chunk.size() + 3) / 4 * 4, filler);
    put(to, std::uint32_t(chunk.size()));
    to.insert(to.end(), type, type + 4);
    to.insert(to.end(), chunk.begin(), chunk.end());
}

Bytes changed_glb(const Bytes& file, std::size_t room, Random& random)
{
    const GlbChunks chunks = split_glb("", file);
    const auto part = [&](std::size_t offset, std::size_t size) {
        return Bytes(file.begin() + std::ptrdiff_t(offset),
                     file.begin() + std::ptrdiff_t(offset + size));
    };
    Bytes json = part(chunks.json_offset, chunks.json_size);
    Bytes binary = part(chunks.binary_offset.value_or(0), chunks.binary_size);
    const std::size_t padded = json.size() + binary.size() + kHeads + 8;
    const std::size_t spare = room > padded ? room - padded : 0;
    if (binary.empty() || random() % 4 != 0)
        mutate_json(json, json.size() + spare, random);
    else
        mutate(binary, binary.size() + spare);
    Bytes content;
    put_chunk(content, "JSON", json, ' ');
    if (chunks.binary_offset)
        put_chunk(content, "BIN\0", binary, 0);
    Bytes result = {'g', 'l', 'T', 'F', 2, 0, 0, 0};
    put(result, std::uint32_t(12 + content.size()));
    result.insert(result.end(), content.begin(), content.end());
    return result;
}

}  // namespace

Bytes changed(const Bytes& file, std::size_t room, Random& random)
{
    try {
        if (is_glb(file) && random() % kWhole != 0)
            return changed_glb(file, room, random);
    } catch (const Error&) {
        // a container that is broken already
    }
    Bytes result = file;
    if (is_glb(file))
        mutate(result, room);
    else
        mutate_json(result, room, random);
    return result;
}

}  // namespace lumel::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t room, unsigned seed)
{
    lumel::fuzz::Random random(seed);
    const lumel::Bytes result = lumel::fuzz::changed({data, data + size}, room, random);
    if (result.size() > room)
        return size;
    std::copy(result.begin(), result.end(), data);
    return result.size();
}
