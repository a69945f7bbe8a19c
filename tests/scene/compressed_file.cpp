#include "compressed_file.h"

#include <cmath>

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <webp/encode.h>

namespace lumel::test {

RayBatch::RayBatch()
{
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::vec2 at(float(x) / (kSide - 1), float(y) / (kSide - 1));
            positions.emplace_back(at.x, 0.3f * std::sin(5.0f * at.x) * at.y, at.y);
            normals.push_back(glm::normalize(glm::vec3(-1.5f * std::cos(5.0f * at.x) * at.y, 1.0f,
                                                       -0.3f * std::sin(5.0f * at.x))));
            texcoords.push_back(at * 0.5f);
        }
    for (int y = 0; y + 1 < kSide; ++y)
        for (int x = 0; x + 1 < kSide; ++x) {
            const int first = y * kSide + x;
            for (const int corner :
                 {first, first + kSide, first + 1, first + 1, first + kSide, first + kSide + 1})
                indices.push_back(std::uint16_t(corner));
        }
}

Json wave_primitive()
{
    return {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}, {"indices", 3}};
}

GltfBuilder RayBatch::plain() const
{
    GltfBuilder builder;
    builder.add_positions(positions);
    builder.add_accessor(normals, "VEC3", 5126, normals.size());
    builder.add_accessor(texcoords, "VEC2", 5126, texcoords.size());
    builder.add_accessor(indices, "SCALAR", 5123, indices.size());
    builder.show(wave_primitive());
    return builder;
}

namespace {

template <class Vector>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type,
                  const std::vector<Vector>& values)
{
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, sizeof(Vector) / sizeof(float), draco::DT_FLOAT32, false,
                   sizeof(Vector), 0);
    const int id = mesh.AddAttribute(attribute, true, std::uint32_t(values.size()));
    for (std::uint32_t i = 0; i < values.size(); ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
    return id;
}

Bytes draco_stream(const RayBatch& wave, const DracoWay& way)
{
    draco::Mesh mesh;
    mesh.set_num_points(std::uint32_t(wave.positions.size()));
    const int position = add_attribute(mesh, draco::GeometryAttribute::POSITION, wave.positions);
    const int normal = add_attribute(mesh, draco::GeometryAttribute::NORMAL, wave.normals);
    add_attribute(mesh, draco::GeometryAttribute::TEX_COORD, wave.texcoords);
    for (std::size_t i = 0; i < wave.indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(wave.indices[i]), draco::PointIndex(wave.indices[i + 1]),
                      draco::PointIndex(wave.indices[i + 2])});
    draco::ExpertEncoder encoder(mesh);
    encoder.SetEncodingMethod(way.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                              : draco::MESH_SEQUENTIAL_ENCODING);
    if (way.position_bits > 0)
        encoder.SetAttributeQuantization(position, way.position_bits);
    if (way.normal_bits > 0)
        encoder.SetAttributeQuantization(normal, way.normal_bits);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok())
        return {};
    return {buffer.data(), buffer.data() + buffer.size()};
}

}  // namespace

GltfBuilder draco_wave(const DracoWay& way)
{
    const RayBatch wave;
    GltfBuilder builder = wave.plain();
    builder.buffer.clear();
    builder.json.erase("bufferViews");
    for (Json& accessor : builder.json["accessors"])
        accessor.erase("bufferView");
    const Bytes stream = draco_stream(wave, way);
    const int view = builder.add_view(stream.data(), stream.size());
    constexpr const char* kDraco = "KHR_draco_mesh_compression";
    builder.json["meshes"][0]["primitives"][0]["extensions"][kDraco] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}};
    builder.json["extensionsUsed"] = {kDraco};
    builder.json["extensionsRequired"] = {kDraco};
    return builder;
}

Bytes make_webp(int width, int height, const Bytes& rgba)
{
    std::uint8_t* file = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &file);
    Bytes bytes(file, file + size);
    WebPFree(file);
    return bytes;
}

}  // namespace lumel::test
