#include "scene/load/gltf_mesh.h"

#include <cstddef>
#include <numeric>

#include "scene/gltf/accessor.h"
#include "scene/gltf/page_parts.h"
#include "scene/load/gltf_attributes.h"
#include "scene/values/geometry_checks.h"

namespace lumel {

namespace {

enum Mode { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

/// A small file can repeat the same data; larger scenes cannot be baked anyway.
constexpr std::size_t kLargestVertexTotal = std::size_t(1) << 28;

/// Reads an accessor of vertex indices.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, const JsonView& indices,
                                        std::size_t vertex_count)
{
    const JsonView root = document.root();
    const std::size_t accessor = indices.index(root.count("accessors"), "accessors");
    const AccessorData data = read_accessor(document, accessor);
    const bool is_unsigned = data.component_type == ComponentType::u8 ||
                             data.component_type == ComponentType::u16 ||
                             data.component_type == ComponentType::u32;
    if (data.type != "SCALAR" || !is_unsigned || data.normalized)
        indices.fail("must refer to an accessor of unsigned scalars");
    const auto buffer_view = root.get("accessors").at(accessor).find("bufferView");
    if (buffer_view)
        if (root.get("bufferViews")
                .at(std::size_t(buffer_view->integer(0, INT32_MAX)))
                .find("byteStride"))
            indices.fail("must not refer to a bufferView with a byteStride");

    // glTF forbids the largest value of the type ("primitive restart").
    const std::uint32_t restart = data.component_type == ComponentType::u8    ? 0xFFu
                                  : data.component_type == ComponentType::u16 ? 0xFFFFu
                                                                              : 0xFFFFFFFFu;
    std::vector<std::uint32_t> corners = to_unsigned(data);
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= vertex_count || corners[i] == restart)
            indices.fail("index " + std::to_string(i) + " is " + std::to_string(corners[i]) +
                         (corners[i] == restart
                              ? ", the primitive restart value, which glTF forbids"
                              : ", but there are " + std::to_string(vertex_count) + " vertices"));
    return corners;
}

/// The primitive's vertices in drawing order.
std::vector<std::uint32_t> read_corners(const GltfDocument& document, const JsonView& view,
                                        std::size_t vertex_count)
{
    if (const auto indices = view.find("indices"))
        return read_indices(document, *indices, vertex_count);
    std::vector<std::uint32_t> corners(vertex_count);
    std::iota(corners.begin(), corners.end(), 0u);
    return corners;
}

/// Vertices of a primitive that a bake divided among pages; sets the page of each vertex.
std::vector<std::uint32_t> read_joined(const GltfDocument& document, const JsonView& view,
                                       const JoinedParts& joined, Primitive& primitive)
{
    const std::size_t vertices = primitive.positions.size();
    primitive.lightmap_pages.assign(vertices, 0);
    std::vector<std::vector<std::uint32_t>> parts;
    for (std::size_t p = 0; p < joined.indices.size(); ++p) {
        parts.push_back(read_indices(document, joined.indices[p], vertices));
        for (const std::uint32_t vertex : parts.back())
            primitive.lightmap_pages[vertex] = joined.pages[p];
    }
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> taken(parts.size(), 0);
    for (const JoinedParts::Run& run : joined.runs) {
        const std::vector<std::uint32_t>& part = parts[run.part];
        std::size_t& first = taken[run.part];
        if (run.triangles > (part.size() - first) / 3)
            view.fail("has parts on pages of a lightmap that do not fit each other");
        const auto from = part.begin() + std::ptrdiff_t(first);
        corners.insert(corners.end(), from, from + std::ptrdiff_t(3 * run.triangles));
        first += 3 * run.triangles;
    }
    return corners;
}

/// Expands strips and fans to three corners per triangle, with glTF's winding.
std::vector<std::uint32_t> triangle_list(std::vector<std::uint32_t> corners, Mode mode,
                                         MeshNotes& notes)
{
    if (mode == kTriangles) {
        notes.stray_indices += corners.size() % 3;
        corners.resize(corners.size() / 3 * 3);
        return corners;
    }
    std::vector<std::uint32_t> list;
    if (corners.size() < 3) {
        notes.stray_indices += corners.size();
        return list;
    }
    list.reserve((corners.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == kTriangleStrip)
            list.insert(list.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
        else
            list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
    return list;
}

Primitive read_primitive(const GltfDocument& document, const JsonView& view, Mode mode,
                         const std::vector<float>& weights, MeshNotes& notes)
{
    Primitive primitive;
    read_attributes(document, view, weights, primitive);
    notes.vertices += primitive.positions.size();
    if (notes.vertices > kLargestVertexTotal)
        view.fail("the scene has more than " + std::to_string(kLargestVertexTotal) + " vertices");
    const JoinedParts joined = joined_parts(view);
    auto corners = joined.indices.empty() ? read_corners(document, view, primitive.positions.size())
                                          : read_joined(document, view, joined, primitive);
    primitive.indices = triangle_list(std::move(corners), mode, notes);
    notes.zero_area_triangles += drop_zero_area(primitive);
    notes.repaired_normals += repair_normals(primitive);
    return primitive;
}

}  // namespace

Mesh read_mesh(const GltfDocument& document, std::size_t mesh, int default_material,
               MeshNotes& notes)
{
    const JsonView root = document.root();
    const JsonView view = root.get("meshes").at(mesh);
    Mesh result;
    result.name = view.string_or("name", "mesh " + std::to_string(mesh));
    std::vector<float> weights(view.count("weights"));
    view.numbers("weights", weights.data(), weights.size());

    bool has_targets = false;
    view.get("primitives").each([&](const JsonView& primitive_view, std::size_t i) {
        const auto mode_view = primitive_view.find("mode");
        const auto mode = mode_view ? Mode(mode_view->integer(kPoints, kTriangleFan)) : kTriangles;
        if (mode < kTriangles) {
            ++notes.points_and_lines;
            return;
        }
        Primitive primitive = read_primitive(document, primitive_view, mode, weights, notes);
        const auto material = primitive_view.find("material");
        primitive.material = material ? int(material->index(root.count("materials"), "materials"))
                                      : default_material;
        primitive.source_primitive = int(i);
        has_targets |= primitive_view.find("targets").has_value();
        if (!primitive.indices.empty())
            result.primitives.push_back(std::move(primitive));
    });
    notes.morphed_meshes += has_targets;
    return result;
}

}  // namespace lumel
