#include "scene/gltf/draco.h"

#include <array>
#include <cstring>
#include <map>
#include <utility>

#include "scene/gltf/accessor.h"
#include "scene/gltf/draco_stream.h"
#include "scene/gltf/extensions.h"

namespace lumel {

namespace {

constexpr std::int64_t kTriangles = 4, kTriangleStrip = 5;
constexpr std::size_t kAlignment = 4;  // alignment of vertices
constexpr std::array<const char*, 4> kTypeNames = {"SCALAR", "VEC2", "VEC3", "VEC4"};

/// Location of a primitive in the document.
struct DracoPlace {
    std::size_t mesh = 0;
    std::size_t primitive = 0;
};

/// An accessor of a primitive, and its new bufferView.
struct Filled {
    DracoPlace place;
    std::string attribute;  ///< empty: the indices
    std::size_t view = 0;
    std::size_t count = 0;
};

bool has_data(const JsonView& root, const JsonView& reference)
{
    const JsonView accessor =
        root.get("accessors").at(reference.index(root.count("accessors"), "accessors"));
    return accessor.find("bufferView") || accessor.find("sparse");
}

/// True if the primitive also has all its data in plain accessors.
bool has_plain_data(const JsonView& root, const JsonView& primitive)
{
    const auto indices = primitive.find("indices");
    if (indices && !has_data(root, *indices))
        return false;
    const JsonView attributes = primitive.get("attributes");
    const JsonView compressed = primitive.extension(kDracoExtension)->get("attributes").as_object();
    for (const auto& [name, id] : compressed.json().items())
        if (!has_data(root, attributes.get(name.c_str())))
            return false;
    return true;
}

void check_mode(const JsonView& primitive)
{
    const auto mode = primitive.find("mode");
    if (!mode)
        return;
    const std::int64_t value = mode->integer(0, INT32_MAX);
    if (value != kTriangles && value != kTriangleStrip)
        mode->fail("is " + std::to_string(value) + ", but Draco only holds triangles");
}

/// Pads vertices to glTF's alignment.
Bytes aligned(const Bytes& packed, std::size_t count, std::size_t stride)
{
    const std::size_t size = packed.size() / count;
    if (size == stride)
        return packed;
    Bytes bytes(count * stride);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(bytes.data() + i * stride, packed.data() + i * size, size);
    return bytes;
}

class Unpacker {
public:
    explicit Unpacker(GltfDocument& document) : document_(document), root_(document.root())
    {
        std::size_t bytes = 0;
        for (const Bytes& buffer : document.buffers)
            bytes += buffer.size();
        allowance_ = draco_allowance(bytes);
    }

    void unpack()
    {
        // JsonViews refer to locations in the JSON, so it changes only after all streams are
        // decoded.
        std::map<std::size_t, std::vector<DracoPlace>> streams;
        root_.each("meshes", [&](const JsonView& mesh, std::size_t m) {
            mesh.each("primitives", [&](const JsonView& primitive, std::size_t p) {
                const auto extension = primitive.extension(kDracoExtension);
                if (!extension || has_plain_data(root_, primitive))
                    return;
                check_mode(primitive);
                const JsonView view = extension->get("bufferView");
                streams[view.index(root_.count("bufferViews"), "bufferViews")].push_back({m, p});
            });
        });
        next_view_ = root_.count("bufferViews");
        for (const auto& [view, places] : streams)
            decode(view, places);
        for (auto& [view, stored] : stored_)
            store(view, std::move(stored.first), stored.second);
        for (const Filled& filled : filled_)
            fill(filled);
    }

private:
    JsonView primitive_at(const DracoPlace& place) const
    {
        return root_.get("meshes").at(place.mesh).get("primitives").at(place.primitive);
    }

    void decode(std::size_t view, const std::vector<DracoPlace>& places)
    {
        const JsonView index =
            primitive_at(places[0]).extension(kDracoExtension)->get("bufferView");
        const Bytes stream = buffer_view_bytes(document_, index);
        const DracoMesh mesh = decode_draco_stream(index, stream, allowance_);

        // The indices replace the stream, which is no longer referenced.
        Bytes indices(mesh.indices.size() * sizeof(std::uint32_t));
        std::memcpy(indices.data(), mesh.indices.data(), indices.size());
        stored_[view] = {std::move(indices), 0};
        std::map<std::uint32_t, std::size_t> views;  // view of each attribute id
        for (const DracoPlace& place : places) {
            filled_.push_back({place, {}, view, mesh.indices.size()});
            const JsonView names =
                primitive_at(place).extension(kDracoExtension)->get("attributes");
            for (const auto& [name, id] : names.as_object().json().items()) {
                const DracoAttribute& attribute =
                    attribute_of(place, name, names.get(name.c_str()), mesh);
                const auto [known, is_new] = views.try_emplace(attribute.id, next_view_);
                if (is_new) {
                    const std::size_t size = attribute.bytes.size() / mesh.points;
                    const std::size_t stride = (size + kAlignment - 1) / kAlignment * kAlignment;
                    stored_[next_view_++] = {aligned(attribute.bytes, mesh.points, stride), stride};
                }
                filled_.push_back({place, name, known->second, mesh.points});
            }
        }
    }

    /// The attribute `id` of the stream; checks that it matches the accessor.
    const DracoAttribute& attribute_of(const DracoPlace& place, const std::string& name,
                                       const JsonView& id, const DracoMesh& mesh) const
    {
        const std::int64_t wanted = id.integer(0, UINT32_MAX);
        const JsonView reference = primitive_at(place).get("attributes").get(name.c_str());
        const JsonView accessor =
            root_.get("accessors").at(reference.index(root_.count("accessors"), "accessors"));
        for (const DracoAttribute& attribute : mesh.attributes) {
            if (attribute.id != wanted)
                continue;
            if (!attribute.type || accessor.get("componentType").integer(0, INT32_MAX) !=
                                       std::int64_t(*attribute.type))
                accessor.get("componentType").fail("is not that of its Draco data");
            if (attribute.components > kTypeNames.size() ||
                accessor.get("type").string() != kTypeNames[attribute.components - 1])
                accessor.get("type").fail("is not that of its Draco data");
            return attribute;
        }
        id.fail("is " + std::to_string(wanted) + ", but its Draco data has no such attribute");
    }

    void store(std::size_t view, Bytes bytes, std::size_t stride)
    {
        Json& views = document_.json["bufferViews"];
        Json json = {{"buffer", document_.buffers.size()}, {"byteLength", bytes.size()}};
        if (stride > 0)
            json["byteStride"] = stride;
        if (view < views.size())
            views[view] = std::move(json);
        else
            views.push_back(std::move(json));
        document_.json["buffers"].push_back({{"byteLength", bytes.size()}});
        document_.buffers.push_back(std::move(bytes));
    }

    void fill(const Filled& filled)
    {
        Json& accessors = document_.json["accessors"];
        Json& primitive =
            document_.json["meshes"][filled.place.mesh]["primitives"][filled.place.primitive];
        const bool is_index = filled.attribute.empty();
        if (is_index)
            primitive.erase("mode");  // strips are now lists
        Json& reference =
            is_index ? primitive["indices"] : primitive["attributes"][filled.attribute];
        if (reference.is_null()) {
            reference = accessors.size();
            accessors.push_back(Json::object());
        }
        std::size_t index = index_of(reference);
        const auto [known, is_new] = view_of_.try_emplace(index, filled.view);
        const bool has_other =
            is_new ? accessors.at(index).contains("bufferView") : known->second != filled.view;
        if (has_other) {  // other primitives share the accessor
            Json copy = accessors[index];
            index = accessors.size();
            reference = index;
            accessors.push_back(std::move(copy));
            view_of_[index] = filled.view;
        }
        Json& accessor = accessors[index];
        for (const char* key : {"byteOffset", "sparse"})
            accessor.erase(key);
        accessor["bufferView"] = filled.view;
        accessor["count"] = filled.count;
        if (is_index) {
            accessor["componentType"] = int(ComponentType::u32);
            accessor["type"] = "SCALAR";
        }
    }

    GltfDocument& document_;
    JsonView root_;
    std::size_t allowance_ = 0;
    std::size_t next_view_ = 0;
    std::map<std::size_t, std::pair<Bytes, std::size_t>> stored_;  ///< by view: bytes, stride
    std::vector<Filled> filled_;
    std::map<std::size_t, std::size_t> view_of_;  ///< view of each filled accessor
};

}  // namespace

void decode_draco(GltfDocument& document)
{
    Unpacker(document).unpack();
    if (document.json.contains("meshes"))
        for (Json& mesh : document.json["meshes"])
            if (mesh.contains("primitives"))
                for (Json& primitive : mesh["primitives"])
                    erase_extension(primitive, kDracoExtension);
    forget_extension(document.json, kDracoExtension);
}

}  // namespace lumel
