#include "scene/gltf/meshopt.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>

#include <meshoptimizer.h>

#include "scene/gltf/extensions.h"
#include "scene/gltf/unpackers.h"

namespace lumel {

namespace {

constexpr std::array<const char*, 2> kNames = {kMeshoptExtension, "KHR_meshopt_compression"};
constexpr std::int64_t kLargestCodedStride = 256;
constexpr std::int64_t kLargestCodedCount = std::int64_t(1) << 40;
constexpr std::int64_t kLargestCodedSize = std::int64_t(1) << 50;
constexpr std::size_t kCornersOfTriangle = 3;
/// Upper bounds of the compression: one byte per component of 64 vertices, per triangle and per
/// index.
constexpr std::size_t kVerticesPerByte = 64;
/// First byte of vertices in the newer bitstream of KHR_meshopt_compression.
constexpr std::uint8_t kNewerVertices = 0xA1;
/// Bitstreams of EXT_meshopt_compression; the library's defaults differ by its version.
constexpr int kVertexVersion = 0, kIndexVersion = 1;

enum class CodingMode { attributes, triangles, indices };
enum class Filter { none, octahedral, quaternion, exponential };

/// Parameters of an encoded bufferView.
struct Coded {
    const std::uint8_t* bytes = nullptr;
    std::size_t size = 0;
    CodingMode mode = CodingMode::attributes;
    Filter filter = Filter::none;
    std::size_t stride = 0;
    std::size_t count = 0;
};

std::optional<JsonView> extension_of(const JsonView& view)
{
    for (const char* name : kNames)
        if (const auto extension = view.extension(name))
            return extension;
    return std::nullopt;
}

constexpr Named<CodingMode> kModes[] = {{"ATTRIBUTES", CodingMode::attributes},
                                        {"TRIANGLES", CodingMode::triangles},
                                        {"INDICES", CodingMode::indices}};

Filter filter_of(const JsonView& extension)
{
    const std::string filter = extension.string_or("filter", "NONE");
    if (filter == "NONE")
        return Filter::none;
    if (filter == "OCTAHEDRAL")
        return Filter::octahedral;
    if (filter == "QUATERNION")
        return Filter::quaternion;
    if (filter == "EXPONENTIAL")
        return Filter::exponential;
    extension.get("filter").fail("is " + quoted(filter) + ", which is not read");
}

/// True for strides that the decoders and filters support.
bool fits(CodingMode mode, Filter filter, std::size_t stride)
{
    if (mode != CodingMode::attributes)
        return stride == 2 || stride == 4;
    switch (filter) {
    case Filter::octahedral:
        return stride == 4 || stride == 8;
    case Filter::quaternion:
        return stride == 8;
    case Filter::none:
    case Filter::exponential:
        break;
    }
    return stride % 4 == 0;
}

/// Throws if the encoded bytes are too few for the stated count.
void check_claim(const JsonView& extension, const Coded& coded)
{
    const std::size_t most = coded.mode == CodingMode::attributes  ? coded.size * kVerticesPerByte
                             : coded.mode == CodingMode::triangles ? coded.size * kCornersOfTriangle
                                                                   : coded.size;
    const std::size_t components = coded.mode == CodingMode::attributes ? coded.stride : 1;
    if (coded.count > most / components)
        extension.get("count").fail("is " + std::to_string(coded.count) + ", more than its " +
                                    std::to_string(coded.size) + " bytes can hold");
}

/// The encoded range of a buffer.
std::pair<const std::uint8_t*, std::size_t> stretch_of(const GltfDocument& document,
                                                       const JsonView& extension)
{
    const std::size_t buffer = extension.get("buffer").index(document.buffers.size(), "buffers");
    const Bytes& bytes = document.buffers[buffer];
    const auto offset_view = extension.find("byteOffset");
    const std::int64_t offset = offset_view ? offset_view->integer(0, kLargestCodedSize) : 0;
    const std::int64_t length = extension.get("byteLength").integer(1, kLargestCodedSize);
    if (offset + length > std::int64_t(bytes.size()))
        extension.fail("reaches byte " + std::to_string(offset + length) + " of buffer " +
                       std::to_string(buffer) + ", which has " + std::to_string(bytes.size()) +
                       " bytes");
    return {bytes.data() + offset, std::size_t(length)};
}

Coded read_coded(const GltfDocument& document, const JsonView& view, const JsonView& extension)
{
    Coded coded;
    coded.mode = named_by(extension.get("mode"), kModes);
    coded.filter = filter_of(extension);
    const JsonView stride = extension.get("byteStride");
    coded.stride = std::size_t(stride.integer(1, kLargestCodedStride));
    if (!fits(coded.mode, coded.filter, coded.stride))
        stride.fail("is " + std::to_string(coded.stride) +
                    ", which this mode and filter cannot have");
    if (coded.mode != CodingMode::attributes && coded.filter != Filter::none)
        extension.get("filter").fail("is only for attributes");
    const JsonView count = extension.get("count");
    coded.count = std::size_t(count.integer(1, kLargestCodedCount));
    if (coded.mode == CodingMode::triangles && coded.count % kCornersOfTriangle != 0)
        count.fail("is " + std::to_string(coded.count) + ", which makes no whole triangles");
    std::tie(coded.bytes, coded.size) = stretch_of(document, extension);
    check_claim(extension, coded);
    const JsonView length = view.get("byteLength");
    if (std::size_t(length.integer(1, kLargestCodedSize)) != coded.count * coded.stride)
        length.fail("must be count times byteStride of its compressed data, " +
                    std::to_string(coded.count * coded.stride));
    return coded;
}

/// Returns false if the data is broken.
bool decode(const Coded& coded, Bytes& plain)
{
    switch (coded.mode) {
    case CodingMode::attributes:
        return meshopt_decodeVertexBuffer(plain.data(), coded.count, coded.stride, coded.bytes,
                                          coded.size) == 0;
    case CodingMode::triangles:
        return meshopt_decodeIndexBuffer(plain.data(), coded.count, coded.stride, coded.bytes,
                                         coded.size) == 0;
    case CodingMode::indices:
        break;
    }
    return meshopt_decodeIndexSequence(plain.data(), coded.count, coded.stride, coded.bytes,
                                       coded.size) == 0;
}

void unfilter(const Coded& coded, Bytes& plain)
{
    switch (coded.filter) {
    case Filter::none:
        return;
    case Filter::octahedral:
        return meshopt_decodeFilterOct(plain.data(), coded.count, coded.stride);
    case Filter::quaternion:
        return meshopt_decodeFilterQuat(plain.data(), coded.count, coded.stride);
    case Filter::exponential:
        return meshopt_decodeFilterExp(plain.data(), coded.count, coded.stride);
    }
}

Bytes decoded(const GltfDocument& document, const JsonView& view, const JsonView& extension)
{
    const Coded coded = read_coded(document, view, extension);
    if (coded.mode == CodingMode::attributes && coded.bytes[0] == kNewerVertices)
        extension.fail("holds vertices of version 1, but only version 0 is read");
    Bytes plain(coded.count * coded.stride);
    if (!decode(coded, plain))
        extension.fail("holds compressed data that is broken");
    unfilter(coded, plain);
    return plain;
}

template <class Index>
std::vector<std::uint32_t> wide_indices(std::span<const std::uint8_t> bytes)
{
    std::vector<std::uint32_t> indices(bytes.size() / sizeof(Index));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        Index index;
        std::memcpy(&index, bytes.data() + i * sizeof(Index), sizeof(Index));
        indices[i] = index;
    }
    return indices;
}

/// Encoded as a sequence: coding triangles may rotate their corners.
Bytes encoded_indices(const PlainView& view)
{
    const std::vector<std::uint32_t> indices = view.stride == sizeof(std::uint16_t)
                                                   ? wide_indices<std::uint16_t>(view.bytes)
                                                   : wide_indices<std::uint32_t>(view.bytes);
    const std::size_t vertices = std::size_t(*std::ranges::max_element(indices)) + 1;
    meshopt_encodeIndexVersion(kIndexVersion);
    Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
    bytes.resize(
        meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

Bytes encoded_vertices(const PlainView& view)
{
    const std::size_t count = view.bytes.size() / view.stride;
    meshopt_encodeVertexVersion(kVertexVersion);
    Bytes bytes(meshopt_encodeVertexBufferBound(count, view.stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), view.bytes.data(), count,
                                            view.stride));
    return bytes;
}

bool has_plain_data(const GltfDocument& document, const JsonView& view)
{
    const std::size_t buffer = view.get("buffer").index(document.buffers.size(), "buffers");
    return !document.buffers[buffer].empty();
}

}  // namespace

bool is_fallback(const JsonView& buffer)
{
    const auto extension = extension_of(buffer);
    return extension && extension->boolean_or("fallback", false);
}

void decode_meshopt(GltfDocument& document)
{
    // JsonViews refer to locations in the JSON, so it changes only after all views are decoded.
    std::vector<std::pair<std::size_t, Bytes>> views;
    document.root().each("bufferViews", [&](const JsonView& view, std::size_t i) {
        const auto extension = extension_of(view);
        if (extension && !has_plain_data(document, view))
            views.emplace_back(i, decoded(document, view, *extension));
    });
    for (auto& [index, bytes] : views) {
        Json& view = document.json["bufferViews"][index];
        view["buffer"] = document.buffers.size();
        view.erase("byteOffset");
        document.json["buffers"].push_back({{"byteLength", bytes.size()}});
        document.buffers.push_back(std::move(bytes));
    }
    for (const char* name : kNames) {
        for (const char* list : {"buffers", "bufferViews"})
            if (document.json.contains(list))
                for (Json& part : document.json[list])
                    erase_extension(part, name);
        forget_extension(document.json, name);
    }
}

bool is_encodable(const PlainView& view)
{
    return !view.bytes.empty() && view.stride > 0 && view.bytes.size() % view.stride == 0 &&
           std::int64_t(view.stride) <= kLargestCodedStride &&
           fits(view.is_indices ? CodingMode::indices : CodingMode::attributes, Filter::none,
                view.stride);
}

EncodedView encode_meshopt(const PlainView& view)
{
    EncodedView encoded{.extension = {{"byteStride", view.stride},
                                      {"count", view.bytes.size() / view.stride},
                                      {"mode", view.is_indices ? "INDICES" : "ATTRIBUTES"}},
                        .bytes = view.is_indices ? encoded_indices(view) : encoded_vertices(view)};
    encoded.extension["byteLength"] = encoded.bytes.size();
    return encoded;
}

std::string meshoptimizer_version()
{
    constexpr int kMajor = 1000, kMinor = 10;  // factors of the header's version number
    return std::to_string(MESHOPTIMIZER_VERSION / kMajor) + "." +
           std::to_string(MESHOPTIMIZER_VERSION % kMajor / kMinor) + "." +
           std::to_string(MESHOPTIMIZER_VERSION % kMinor);
}

}  // namespace lumel
