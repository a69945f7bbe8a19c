#include "scene/gltf/document.h"

#include <cstdint>
#include <cstdlib>
#include <utility>

#include "scene/gltf/accessor.h"
#include "scene/gltf/area_lights.h"
#include "scene/gltf/baked_lights.h"
#include "scene/gltf/baked_probes.h"
#include "scene/gltf/container.h"
#include "scene/gltf/draco.h"
#include "scene/gltf/extensions.h"
#include "scene/gltf/instancing.h"
#include "scene/gltf/meshopt.h"
#include "scene/gltf/page_parts.h"
#include "scene/gltf/split_sides.h"
#include "scene/gltf/webp.h"

namespace lumel {

namespace {

/// glTF's limits of the stride of interleaved elements.
constexpr std::int64_t kSmallestStride = 4;
constexpr std::int64_t kLargestStride = 252;
/// Larger than any real file; sums of two do not overflow.
constexpr std::int64_t kLargestSize = std::int64_t(1) << 50;

/// "major.minor" as two numbers.
std::pair<int, int> version_of(const JsonView& view)
{
    const std::string& text = view.string();
    char* rest = nullptr;
    const long major = std::strtol(text.c_str(), &rest, 10);
    const bool dot = rest != text.c_str() && *rest == '.';
    char* end = rest;
    const long minor = dot ? std::strtol(rest + 1, &end, 10) : 0;
    if (!dot || end == rest + 1 || *end != '\0' || major < 0 || minor < 0)
        view.fail("is not a version like \"2.0\"");
    return {static_cast<int>(major), static_cast<int>(minor)};
}

void check_asset(const JsonView& root)
{
    const JsonView asset = root.get("asset");
    const JsonView version = asset.get("version");
    if (version_of(version).first != 2)
        version.fail("is glTF " + quoted(version.string()) + ", but only glTF 2 is read");
    const auto minimum = asset.find("minVersion");
    if (minimum && version_of(*minimum) > std::pair(2, 0))
        minimum->fail("the file needs glTF " + quoted(minimum->string()) +
                      ", but only 2.0 is read");
}

/// Checks that the top-level lists are lists of objects.
void check_collections(const JsonView& root)
{
    for (const char* key : {"accessors", "buffers", "bufferViews", "cameras", "images", "materials",
                            "meshes", "nodes", "samplers", "scenes", "textures"})
        root.each(key, [](const JsonView& element, std::size_t) { element.as_object(); });
}

/// Checks all texture references of materials, even of unread ones: a written scene has them.
void check_texture_uses(const JsonView& object, std::size_t textures)
{
    for (const auto& [name, value] : object.json().items()) {
        if (!value.is_object())
            continue;
        const JsonView use = object.get(name.c_str());
        if (name.ends_with("Texture") || name == "MOZ_lightmap") {
            if (const auto index = use.find("index"))
                index->index(textures, "textures");
            if (const auto texcoord = use.find("texCoord"))
                texcoord->integer(0, INT32_MAX);
        }
        check_texture_uses(use, textures);
    }
}

Bytes load_buffer(const JsonView& view, const std::string& path, const Bytes* binary_chunk)
{
    const auto length = static_cast<std::size_t>(view.get("byteLength").integer(1, kLargestSize));
    Bytes bytes;
    if (const auto uri = view.find("uri")) {
        bytes = read_uri(*uri, path);
    } else if (binary_chunk) {
        bytes = *binary_chunk;
    } else if (is_fallback(view)) {
        return bytes;
    } else {
        view.fail("has no data: neither a uri nor a GLB chunk");
    }
    if (bytes.size() < length)
        view.fail("should hold " + std::to_string(length) + " bytes, but its data has only " +
                  std::to_string(bytes.size()));
    bytes.resize(length);
    return bytes;
}

void check_buffer_views(const GltfDocument& document)
{
    document.root().each("bufferViews", [&](const JsonView& view, std::size_t) {
        const std::size_t buffer = view.get("buffer").index(document.buffers.size(), "buffers");
        const auto size = static_cast<std::int64_t>(document.buffers[buffer].size());
        const auto offset = view.find("byteOffset");
        const std::int64_t start = offset ? offset->integer(0, kLargestSize) : 0;
        const std::int64_t length = view.get("byteLength").integer(1, kLargestSize);
        if (start + length > size)
            view.fail("reaches byte " + std::to_string(start + length) + " of buffer " +
                      std::to_string(buffer) + ", which has " + std::to_string(size) + " bytes");
        if (const auto stride = view.find("byteStride"))
            if (stride->integer(kSmallestStride, kLargestStride) % 4 != 0)
                stride->fail("must be a multiple of 4");
    });
}

}  // namespace

GltfDocument load_gltf_document(const std::string& path, BakeChanges changes)
{
    // Separates the JSON from the binary chunk.
    const Bytes file = read_file(path, path);
    GlbChunks chunks{0, file.size(), std::nullopt, 0};
    if (is_glb(file))
        chunks = split_glb(path, file);

    GltfDocument document;
    document.path = path;
    document.json = parse_json(path, file.data() + chunks.json_offset, chunks.json_size);
    if (document.json.is_object() && changes == BakeChanges::undone) {
        bring_back_lights(document.json);
        join_sides(document.json);
        join_pages(document.json);
        drop_light_probes(document.json);
    }
    const JsonView root = document.root();
    root.as_object();
    check_asset(root);
    check_collections(root);
    check_extensions(root);

    // Loads the data, then verifies that every view and accessor is inside it.
    Bytes binary_chunk;
    if (chunks.binary_offset)
        binary_chunk.assign(file.begin() + *chunks.binary_offset,
                            file.begin() + *chunks.binary_offset + chunks.binary_size);
    root.each("buffers", [&](const JsonView& view, std::size_t i) {
        const bool has_chunk = i == 0 && chunks.binary_offset.has_value();
        document.buffers.push_back(load_buffer(view, path, has_chunk ? &binary_chunk : nullptr));
    });
    root.each("materials", [&](const JsonView& material, std::size_t) {
        check_texture_uses(material, root.count("textures"));
    });
    decode_meshopt(document);
    check_buffer_views(document);
    decode_draco(document);
    check_accessors(document);
    expand_instances(document);
    expand_area_lights(document);
    name_webp_images(document);
    return document;
}

Bytes read_linked_bytes(const GltfDocument& document, const JsonView& view)
{
    const auto uri = view.find("uri");
    const auto buffer_view = view.find("bufferView");
    if (uri.has_value() == buffer_view.has_value())
        view.fail("must have either a uri or a bufferView");
    if (uri)
        return read_uri(*uri, document.path);
    return buffer_view_bytes(document, *buffer_view);
}

Bytes read_image_bytes(const GltfDocument& document, std::size_t image)
{
    return read_linked_bytes(document, document.root().get("images").at(image));
}

}  // namespace lumel
