#include "jobs/solve/host_memory.h"

#include <algorithm>
#include <filesystem>

#include "atlas/finish/fine_radiance.h"
#include "atlas/finish/finish.h"
#include "base/core/bytes.h"
#include "base/core/spherical_harmonics.h"
#include "lights/light_sources.h"
#include "links/trace/links.h"
#include "methods/glossy/glossy.h"
#include "methods/matrix/relight_solver.h"
#include "methods/methods.h"
#include "results/preview/preview.h"

namespace lumel {
namespace {

/// The program, its libraries and an open device, before a scene is read: resident size with Mesa's
/// software device, including 20 MiB for validation layers [bytes].
constexpr std::uint64_t kProgramBytes = 98u << 20;
/// Memory of Mesa's compiler and code for the preview's shaders, on a CPU device, as measured
/// [bytes].
constexpr std::uint64_t kCompilerBytes = 60u << 20;
/// Memory per lumel of the matrix method, as measured [bytes].
constexpr std::uint64_t kMatrixLumelBytes = 380;
/// Floats for each pair of patches while a matrix is stored as BC1: form factors, three channels of
/// reflections, and of their logarithms, decoded as codes and as entries.
constexpr std::uint64_t kMatrixFloats = 1 + 3 + 3 + 3 + 3;
/// Memory per triangle for BVHs and charts, as measured [bytes].
constexpr std::uint64_t kTreeBytes = 130, kChartedBytes = 90;
/// A JSON value in memory, and the number of values per written primitive with its accessors.
constexpr std::uint64_t kJsonValueBytes = 100, kJsonValues = 30;
/// A written vertex: position, normal, two texture coordinates; an index.
constexpr std::uint64_t kWrittenVertexBytes = 40, kWrittenIndexBytes = sizeof(std::uint32_t);
/// Compressing a float image needs about its size again; 8-bit images have three channels.
constexpr std::uint64_t kOfTexel = sizeof(glm::vec4), kOfRgb = sizeof(glm::vec3), kOfPng = 3;
/// Layers of solution.exr, the main image among them.
constexpr std::uint64_t kSolutionLayers = 5;
/// Maximum image size assumed before the view is known.
constexpr int kMaxPictureSide = 1 << 14;

/// Sizes of all parts.
struct Sizes {
    std::uint64_t lumels = 0, pieces = 0, texels = 0, page_texels = 0;
    std::uint64_t written = 0;        ///< bytes of a written glTF, without its maps
    std::uint64_t document = 0;       ///< its additional bytes in memory
    std::uint64_t finish = 0;         ///< see finish_bytes
    std::uint64_t texture_scale = 1;  ///< side of scene-baked.glb's texture relative to the map
    PreviewMemory preview;
    std::uint64_t picture = 0;  ///< bytes
    std::uint64_t lamps = 0;    ///< kept apart
};

std::uint64_t bytes_of_scene(const Scene& scene)
{
    std::uint64_t bytes = 0;
    for (const Texture& texture : scene.textures)
        bytes += bytes_of(texture.rgba);
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            bytes += bytes_of(primitive.positions) + bytes_of(primitive.normals) +
                     bytes_of(primitive.colors) + bytes_of(primitive.indices);
            for (const auto& texcoords : primitive.texcoords)
                bytes += bytes_of(texcoords);
        }
    return bytes + scene.instances.size() * sizeof(Instance);
}

std::uint64_t bytes_of_atlas(const Atlas& atlas)
{
    std::uint64_t bytes = atlas.surfaces.size() * sizeof(Surface) + bytes_of(atlas.back_shift);
    for (const Surface& surface : atlas.surfaces)
        bytes += bytes_of(surface.source_vertex) + bytes_of(surface.texcoord) +
                 bytes_of(surface.indices) + bytes_of(surface.chart);
    return bytes;
}

std::uint64_t bytes_of_lumels(const Sizes& sizes)
{
    constexpr std::uint64_t kOfLumel = sizeof(Lumel) + sizeof(Gloss) + sizeof(float);
    return sizes.lumels * kOfLumel + sizes.pieces * sizeof(Piece) + sizes.texels * sizeof(float);
}

/// Size of the scene's file, which is read again for writing.
std::uint64_t bytes_of_file(const Scene& scene)
{
    std::error_code none;
    const auto bytes = std::filesystem::file_size(scene.path, none);
    return none ? 0 : std::uint64_t(bytes);
}

std::uint64_t layers_of(const BakeOptions& options)
{
    return options.directional == Directional::none  ? 0
           : options.directional == Directional::sh1 ? std::uint64_t(coefficient_count(1))
                                                     : std::uint64_t(coefficient_count(2));
}

/// Memory to write files one after another, without the maps.
std::uint64_t writing_bytes(const Sizes& sizes, std::uint64_t layers)
{
    const std::uint64_t map = sizes.page_texels * kOfTexel * (2 + layers);
    const std::uint64_t solution = (kSolutionLayers + 1) * sizes.texels * kOfTexel;
    const std::uint64_t gltf = 2 * sizes.written + sizes.document;
    const std::uint64_t scene =
        gltf + sizes.page_texels * (kOfTexel + kOfRgb + kOfTexel / 2 + 2 * kOfPng);
    const std::uint64_t finer = sizes.texture_scale * sizes.texture_scale;
    const std::uint64_t toning = 2 * finer * sizes.texels * kOfTexel;
    const std::uint64_t baked =
        gltf +
        finer * (sizes.texels * kOfTexel + sizes.page_texels * (kOfTexel + kOfRgb + 2 * kOfPng));
    return std::max({map, solution, scene, toning, baked});
}

/// Lumels whose links are in memory.
std::size_t linked_lumels(const Sizes& sizes, const BakeOptions& options)
{
    return gathers_links(options) ? sizes.lumels
                                  : LinkRadiosity::lumels_per_rank(sizes.lumels, options.ranks);
}

std::uint64_t bytes_of_links(const Sizes& sizes, const BakeOptions& options)
{
    const std::uint32_t even = std::get<LinksOptions>(options.solver.method).even_rays;
    const std::size_t lumels = linked_lumels(sizes, options);
    return even > 0 ? LinkRadiosity::first_bytes(lumels, even, sizes.lamps)
                    : LinkRadiosity::likely_bytes(lumels, options.solver.max_shots, sizes.lamps);
}

/// Copies of all links while they are written: as StoredLinks, packed, and twice in a stream.
std::uint64_t kept_bytes(const Sizes& sizes, const BakeOptions& options)
{
    constexpr std::uint64_t kCopies = 4;
    return options.keep_links ? kCopies * bytes_of_links(sizes, options) : 0;
}

/// Memory of the largest stage, in addition to permanent data.
std::uint64_t working_bytes(const Sizes& sizes, const BakeOptions& options, bool shared)
{
    const std::uint64_t layers = layers_of(options);
    const std::uint64_t maps = (2 + layers + sizes.lamps) * sizes.texels * kOfTexel +
                               (1 + layers + 2 * sizes.lamps) * sizes.lumels * sizeof(glm::vec3);
    const std::uint64_t solving =
        uses_links(options) ? std::max(LinkRadiosity::sweep_bytes(sizes.lumels),
                                       LinkRadiosity::lamp_bytes(sizes.lumels, sizes.lamps))
                            : 0;
    const std::uint64_t drawing =
        options.preview_width > 0
            ? sizes.preview.host + (shared ? sizes.preview.device + kCompilerBytes : 0)
            : 0;
    const std::uint64_t writing =
        sizes.picture + writing_bytes(sizes, layers) + sizes.lamps * sizes.texels * kOfTexel;
    return std::max(
        {solving, maps + std::max({sizes.finish, drawing, writing}), kept_bytes(sizes, options)});
}

void add_solver(HostMemory& memory, const Sizes& sizes, const BakeOptions& options)
{
    const std::uint64_t lumels = sizes.lumels;
    if (const auto* matrix = std::get_if<MatrixOptions>(&options.solver.method)) {
        memory.patches = std::min<std::uint64_t>(lumels, matrix->transport.patches);
        memory.matrices = kMatrixFloats * sizeof(float) * memory.patches * memory.patches;
        memory.solver =
            kMatrixLumelBytes * lumels + LumelRowsBuilder::host_bytes(lumels, memory.patches);
    }
    if (const auto* glossy = std::get_if<GlossyOptions>(&options.solver.method))
        memory.solver = GlossyIllumination::host_bytes(lumels, *glossy);
    if (!uses_links(options))
        return;
    memory.solver = LinkRadiosity::host_bytes(lumels, sizes.pieces, sizes.texels, sizes.lamps);
    memory.links = bytes_of_links(sizes, options);
    memory.first_links = LinkRadiosity::first_bytes(
        linked_lumels(sizes, options), std::get<LinksOptions>(options.solver.method).even_rays,
        sizes.lamps);
}

/// The sizes that do not depend on the map's side.
Sizes without_map(Sizes sizes)
{
    const std::uint64_t map = sizes.texels * kOfTexel;
    sizes.preview.device -= std::min(sizes.preview.device, map);
    sizes.lumels = sizes.pieces = sizes.texels = sizes.page_texels = 0;
    return sizes;
}

HostMemory finished(HostMemory memory, const Sizes& sizes, const BakeOptions& options, bool shared)
{
    memory.program = kProgramBytes;
    memory.lumels = bytes_of_lumels(sizes);
    memory.working = working_bytes(sizes, options, shared);
    add_solver(memory, sizes, options);
    memory.fixed = memory.program + memory.scene + memory.trees + memory.atlas +
                   working_bytes(without_map(sizes), options, shared);
    return memory;
}

glm::ivec2 picture_of(const BakeOptions& options, const View& view)
{
    return {options.preview_width,
            picture_height(options.preview_width, view.aspect, kMaxPictureSide)};
}

std::uint64_t picture_bytes(const glm::ivec2& size)
{
    return std::uint64_t(size.x) * std::uint64_t(size.y) * kOfTexel;
}

/// Lamps kept apart. Throws Error{input} as find_lamps() does.
std::uint64_t lamp_count(const SolveScene& prepared, const BakeOptions& options)
{
    if (!keeps_lamps_apart(options))
        return 0;
    const LightSources sources(prepared.scene, prepared.surfaces, prepared.extent());
    return find_lamps(prepared.scene, prepared.lumels, sources,
                      std::get<LinksOptions>(options.solver.method).groups)
        .all.size();
}

/// A lower bound, before it is known which surfaces shine.
std::uint64_t least_lamp_count(const Scene& scene, const BakeOptions& options)
{
    if (!keeps_lamps_apart(options))
        return 0;
    if (!std::get<LinksOptions>(options.solver.method).groups.empty())
        return 1;
    return std::clamp<std::uint64_t>(light_sources(scene, std::vector<std::uint32_t>{}).size(), 1,
                                     kMaxLamps);
}

}  // namespace

std::uint64_t triangle_count(const Scene& scene)
{
    std::uint64_t count = 0;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            count += primitive.indices.size() / 3;
    return count;
}

HostMemory host_memory(const SolveScene& prepared, const BakeOptions& options, bool shared)
{
    const Atlas& atlas = prepared.atlas;
    const auto side = std::uint64_t(atlas.width), page = std::uint64_t(atlas.pages.side);
    Sizes sizes{.lumels = prepared.lumels.lumels.size(),
                .pieces = prepared.lumels.pieces.size(),
                .texels = side * side,
                .page_texels = page * page,
                .document = 2 * bytes_of_file(prepared.scene),
                .finish = finish_bytes(atlas),
                .lamps = lamp_count(prepared, options)};
    for (const Surface& surface : atlas.surfaces)
        sizes.written += surface.texcoord.size() * kWrittenVertexBytes +
                         surface.indices.size() * kWrittenIndexBytes;
    sizes.document += atlas.surfaces.size() * kJsonValues * kJsonValueBytes;
    sizes.texture_scale = std::uint64_t(std::clamp(options.baked_size / atlas.pages.side, 1,
                                                   texture_density(prepared.scene, atlas)));
    if (options.preview_width > 0) {
        const glm::ivec2 picture = picture_of(options, choose_view(prepared.scene, prepared.rays));
        sizes.preview = preview_memory(prepared.scene, atlas, picture);
        sizes.picture = picture_bytes(picture);
    }
    return finished({.scene = bytes_of_scene(prepared.scene),
                     .trees = prepared.rays.bytes(),
                     .atlas = bytes_of_atlas(atlas)},
                    sizes, options, shared);
}

HostMemory host_memory(const Scene& scene, std::size_t lumels, const BakeOptions& options,
                       bool shared)
{
    const auto side = std::uint64_t(fixed_side(options.atlas));
    const std::uint64_t triangles = triangle_count(scene);
    Sizes sizes{.lumels = lumels,
                .pieces = lumels,
                .texels = side * side * std::uint64_t(options.atlas.pages),
                .page_texels = side * side,
                .lamps = least_lamp_count(scene, options)};
    if (options.preview_width > 0) {
        Atlas map;
        map.width = map.height = fixed_side(options.atlas);
        const glm::ivec2 picture =
            picture_of(options, scene.cameras.empty() ? View{} : view_of(scene.cameras.front()));
        sizes.preview = preview_memory(scene, map, picture);
        sizes.picture = picture_bytes(picture);
    }
    return finished({.scene = bytes_of_scene(scene),
                     .trees = kTreeBytes * triangles,
                     .atlas = kChartedBytes * triangles},
                    sizes, options, shared);
}

}  // namespace lumel
