#include "scene/pack/draco_encode.h"

#include <array>
#include <charconv>
#include <limits>
#include <string>
#include <utility>

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include "base/core/error.h"

namespace lumel {

namespace {

/// Of Draco's 0 (smallest) to 10 (fastest).
constexpr int kSpeed = 1;

draco::DataType type_of(ComponentType type)
{
    switch (type) {
    case ComponentType::i8:
        return draco::DT_INT8;
    case ComponentType::u8:
        return draco::DT_UINT8;
    case ComponentType::i16:
        return draco::DT_INT16;
    case ComponentType::u16:
        return draco::DT_UINT16;
    case ComponentType::u32:
        return draco::DT_UINT32;
    case ComponentType::f32:
        break;
    }
    return draco::DT_FLOAT32;
}

draco::GeometryAttribute::Type kind_of(const DracoInput& input)
{
    switch (input.kind) {
    case DracoInput::Kind::position:
        return draco::GeometryAttribute::POSITION;
    case DracoInput::Kind::normal:
        // The library predicts normals as octahedral coordinates, which only floats become.
        if (input.normal_bits > 0)
            return draco::GeometryAttribute::NORMAL;
        break;
    case DracoInput::Kind::texcoord:
        return draco::GeometryAttribute::TEX_COORD;
    case DracoInput::Kind::color:
        return draco::GeometryAttribute::COLOR;
    case DracoInput::Kind::other:
        break;
    }
    return draco::GeometryAttribute::GENERIC;
}

void add_attribute(draco::Mesh& mesh, const DracoInput& input)
{
    const AccessorData& data = input.data;
    draco::GeometryAttribute attribute;
    attribute.Init(kind_of(input), nullptr, std::uint8_t(data.components),
                   type_of(data.component_type), data.normalized, std::int64_t(data.element_size),
                   0);
    const int id = mesh.AddAttribute(attribute, true, std::uint32_t(data.count));
    for (std::uint32_t i = 0; i < data.count; ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                              data.bytes.data() + i * data.element_size);
}

/// The shortest text that is read as this float: Draco's own setters keep six decimals.
std::string exact_text(float value)
{
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

draco::Options rounding_of(const DracoInput& input)
{
    draco::Options rounding;
    if (input.grid) {
        const DracoGrid& grid = *input.grid;
        std::string origin;
        for (const float value : grid.origin)
            origin += exact_text(value) + " ";
        rounding.SetInt("quantization_bits", grid.bits);
        rounding.SetString("quantization_origin", origin);
        rounding.SetString("quantization_range",
                           exact_text(grid.step * float((1u << grid.bits) - 1u)));
    } else if (input.normal_bits > 0) {
        rounding.SetInt("quantization_bits", input.normal_bits);
    }
    return rounding;
}

/// The mesh that a reader gets; empty if it cannot read the stream.
std::optional<DracoMesh> decoded(const Bytes& stream)
try {
    const std::string name;
    const Json place;
    std::size_t allowance = std::numeric_limits<std::size_t>::max();
    return decode_draco_stream(JsonView(name, place), stream, allowance);
} catch (const Error&) {
    return std::nullopt;
}

}  // namespace

std::optional<EncodedDraco> encode_draco(const std::vector<std::uint32_t>& indices,
                                         const std::vector<DracoInput>& attributes)
{
    draco::Mesh mesh;
    mesh.set_num_points(std::uint32_t(attributes.front().data.count));
    for (const DracoInput& input : attributes)
        add_attribute(mesh, input);
    for (std::size_t i = 0; i < indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(indices[i]), draco::PointIndex(indices[i + 1]),
                      draco::PointIndex(indices[i + 2])});
    // Vertices at borders of charts become one, so that Draco finds what they join.
    if (!mesh.DeduplicateAttributeValues())
        return std::nullopt;
    mesh.DeduplicatePointIds();

    draco::EncoderOptions options = draco::EncoderOptions::CreateDefaultOptions();
    options.SetSpeed(kSpeed, kSpeed);
    for (std::size_t i = 0; i < attributes.size(); ++i)
        options.SetAttributeOptions(std::int32_t(i), rounding_of(attributes[i]));
    draco::ExpertEncoder encoder(mesh);
    encoder.Reset(options);
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok())
        return std::nullopt;
    EncodedDraco encoded{.stream = {buffer.data(), buffer.data() + buffer.size()}, .mesh = {}};
    std::optional<DracoMesh> mesh_of_reader = decoded(encoded.stream);
    if (!mesh_of_reader)
        return std::nullopt;
    encoded.mesh = std::move(*mesh_of_reader);
    return encoded;
}

}  // namespace lumel
