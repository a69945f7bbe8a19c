#include "scene/gltf/draco_stream.h"

#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/draco_version.h>
#include <draco/core/varint_decoding.h>

#include "scene/gltf/unpackers.h"

namespace lumel {

namespace {

/// Faces allowed for any file, and per byte. A flat grid of two million triangles takes one byte
/// per 38 of them; ordinary meshes take one byte per triangle.
constexpr std::size_t kFreeFaces = std::size_t(1) << 20;
constexpr std::size_t kFacesPerByte = 256;
/// Attribute values allowed per face.
constexpr std::size_t kNumbersPerFace = 8;
/// glTF requires this bitstream; earlier ones use other encodings.
constexpr std::pair<int, int> kOldestVersion = {2, 2};

constexpr std::array<std::pair<draco::DataType, ComponentType>, 6> kTypes = {{
    {draco::DT_INT8, ComponentType::i8},
    {draco::DT_UINT8, ComponentType::u8},
    {draco::DT_INT16, ComponentType::i16},
    {draco::DT_UINT16, ComponentType::u16},
    {draco::DT_UINT32, ComponentType::u32},
    {draco::DT_FLOAT32, ComponentType::f32},
}};

/// Limit of faces that a stream may decode, and whether it was exceeded.
struct Bound {
    std::size_t faces = 0;
    bool exceeded = false;

    /// Subtracts `wanted`. Returns false if it exceeds the rest.
    bool take(std::uint64_t wanted)
    {
        exceeded = wanted > faces;
        if (!exceeded)
            faces -= std::size_t(wanted);
        return !exceeded;
    }
};

/// Faces that a stream is about to decode, counted once more for every attribute set with its own
/// connectivity. nullopt if the stream ends early.
std::optional<std::uint64_t> claimed_faces(const draco::DecoderBuffer& buffer, bool edgebreaker)
{
    draco::DecoderBuffer ahead;
    ahead.Init(buffer.data_head(), std::size_t(buffer.remaining_size()),
               buffer.bitstream_version());
    std::uint32_t vertices = 0, faces = 0;
    std::uint8_t sets = 0;
    if (edgebreaker && !draco::DecodeVarint(&vertices, &ahead))
        return std::nullopt;
    if (!draco::DecodeVarint(&faces, &ahead) || (edgebreaker && !ahead.Decode(&sets)))
        return std::nullopt;
    return std::uint64_t(faces) * (1u + sets);
}

/// A decoder of the library that checks sizes before allocating memory.
template <class Decoder, bool kEdgebreaker>
class BoundedDecoder : public Decoder {
public:
    explicit BoundedDecoder(Bound& bound) : bound_(bound) {}

protected:
    bool DecodeConnectivity() override
    {
        const auto faces = claimed_faces(*this->buffer(), kEdgebreaker);
        return faces && bound_.take(*faces) && Decoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override
    {
        const draco::PointCloud& cloud = *this->point_cloud();
        std::uint64_t numbers = 0;
        for (std::int32_t i = 0; i < cloud.num_attributes(); ++i)
            numbers += cloud.attribute(i)->num_components();
        return bound_.take(numbers * cloud.num_points() / kNumbersPerFace) &&
               Decoder::DecodeAllAttributes();
    }

private:
    Bound& bound_;
};

using EdgebreakerDecoder = BoundedDecoder<draco::MeshEdgebreakerDecoder, true>;
using SequentialDecoder = BoundedDecoder<draco::MeshSequentialDecoder, false>;

std::unique_ptr<draco::MeshDecoder> decoder_for(std::uint8_t method, Bound& bound)
{
    if (method == draco::MESH_EDGEBREAKER_ENCODING)
        return std::make_unique<EdgebreakerDecoder>(bound);
    if (method == draco::MESH_SEQUENTIAL_ENCODING)
        return std::make_unique<SequentialDecoder>(bound);
    return nullptr;
}

/// Returns false if the stream is broken.
bool decode(std::span<const std::uint8_t> stream, std::uint8_t method, Bound& bound,
            draco::Mesh& mesh)
try {
    const std::unique_ptr<draco::MeshDecoder> decoder = decoder_for(method, bound);
    if (!decoder)
        return false;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    const draco::DecoderOptions options;
    return decoder->Decode(options, &buffer, &mesh).ok() && mesh.num_points() > 0 &&
           mesh.num_faces() > 0;
} catch (const std::bad_alloc&) {
    throw;
} catch (const std::exception&) {
    return false;  // the library requested an impossible container size
}

/// Reads the values of all points in order. Returns false if the stream lacks some.
bool read_values(const draco::PointAttribute& from, std::size_t points, Bytes& bytes)
{
    if (!from.is_mapping_identity() && from.indices_map_size() < points)
        return false;
    const auto size = std::size_t(from.byte_stride());
    bytes.resize(points * size);
    for (std::size_t point = 0; point < points; ++point) {
        const draco::AttributeValueIndex index =
            from.mapped_index(draco::PointIndex(std::uint32_t(point)));
        if (index.value() >= from.size() ||
            (std::size_t(index.value()) + 1) * size > std::size_t(from.buffer()->data_size()))
            return false;
        std::memcpy(bytes.data() + point * size, from.GetAddress(index), size);
    }
    return true;
}

std::optional<ComponentType> type_of(draco::DataType type)
{
    for (const auto& [stored, known] : kTypes)
        if (stored == type)
            return known;
    return std::nullopt;
}

std::uint8_t method_of(const JsonView& place, std::span<const std::uint8_t> stream)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
        place.fail("is no Draco data");
    if (header.encoder_type != draco::TRIANGULAR_MESH)
        place.fail("holds Draco data that is no mesh");
    if (std::pair<int, int>(header.version_major, header.version_minor) < kOldestVersion)
        place.fail("holds Draco data of version " + std::to_string(header.version_major) + "." +
                   std::to_string(header.version_minor) + ", but only 2.2 is read");
    return header.encoder_method;
}

}  // namespace

std::size_t draco_allowance(std::size_t bytes)
{
    return kFreeFaces + kFacesPerByte * bytes;
}

DracoMesh decode_draco_stream(const JsonView& place, std::span<const std::uint8_t> stream,
                              std::size_t& allowance)
{
    const auto fail = [&] { place.fail("holds Draco data that is broken"); };
    draco::Mesh mesh;
    Bound bound{allowance};
    const bool decoded = decode(stream, method_of(place, stream), bound, mesh);
    allowance = bound.faces;
    if (bound.exceeded)
        place.fail("holds Draco data that claims far more triangles than its " +
                   std::to_string(stream.size()) + " bytes can be expected to hold");
    if (!decoded)
        fail();

    DracoMesh result;
    result.points = mesh.num_points();
    for (std::uint32_t face = 0; face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(face)))
            result.indices.push_back(corner.value());
    for (std::int32_t i = 0; i < mesh.num_attributes(); ++i) {
        const draco::PointAttribute& from = *mesh.attribute(i);
        DracoAttribute& attribute = result.attributes.emplace_back();
        attribute.id = from.unique_id();
        attribute.type = type_of(from.data_type());
        attribute.components = from.num_components();
        if (!read_values(from, result.points, attribute.bytes))
            fail();
    }
    return result;
}

std::string draco_version()
{
    return draco::kDracoVersion;
}

}  // namespace lumel
