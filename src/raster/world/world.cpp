#include "raster/world/world.h"

#include <limits>

namespace lumel {
namespace {

gpu::Address address_of(Wrap wrap)
{
    return wrap == Wrap::repeat     ? gpu::Address::repeat
           : wrap == Wrap::mirrored ? gpu::Address::mirrored
                                    : gpu::Address::clamp;
}

/// The material's base colour texture, or one white texel.
gpu::Target upload_texture(const gpu::Device& device, const Scene& scene, const TextureUse& use)
{
    if (use.texture < 0) {
        gpu::Target white(device, gpu::Pixel::srgba8, 1, 1, 1, 1, "white texel");
        const std::uint32_t texel = 0xffffffffu;
        white.upload(&texel);
        return white;
    }
    const Texture& texture = scene.textures[use.texture];
    gpu::Target target(device, gpu::Pixel::srgba8, std::uint32_t(texture.width),
                       std::uint32_t(texture.height), 1, 1,
                       "cut-out texture " + std::to_string(use.texture));
    target.upload(texture.rgba.data());
    return target;
}

/// Cutoff as in Passage; opaque surfaces are covered for any alpha.
float cutoff_of(const Material& material)
{
    switch (material.alpha_mode) {
    case AlphaMode::mask:
        return material.alpha_cutoff;
    case AlphaMode::blend:
        return -1.0f;
    default:
        return 0.0f;
    }
}

CutOutDraw make_draw(const gpu::Device& device, const Scene& scene, const CutOut& cut_out)
{
    const Material& material = scene.materials[cut_out.material];
    const TextureUse& use = material.base_color_texture;
    CutOutDraw draw;
    draw.range = cut_out.range;
    draw.color = std::make_unique<gpu::Target>(upload_texture(device, scene, use));
    draw.sampler = std::make_unique<gpu::Sampler>(device, gpu::Filter::linear,
                                                  address_of(use.wrap_s), address_of(use.wrap_t));
    draw.passage = {.cutoff = cutoff_of(material),
                    .transmission = material.transmission,
                    .color = glm::vec3(material.base_color)};
    return draw;
}

std::vector<Placement> placements_of(const Scene& scene)
{
    std::vector<Placement> placements;
    for (const Instance& instance : scene.instances)
        placements.push_back({instance.transform, instance.transform});
    return placements;
}

/// Bounds of an instance's vertices; inverted if it has none.
Box box_of(const Scene& scene, const Instance& instance)
{
    Box box{glm::vec3(std::numeric_limits<float>::max()),
            glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Primitive& primitive : scene.meshes[instance.mesh].primitives)
        for (const glm::vec3& p : primitive.positions) {
            const glm::vec3 world(instance.transform * glm::vec4(p, 1.0f));
            box.low = glm::min(box.low, world);
            box.high = glm::max(box.high, world);
        }
    return box;
}

}  // namespace

World::World(const gpu::Device& device, const Scene& scene, const Lumels& lumels,
             const Atlas* atlas, const std::vector<char>& movers)
    : World(device, scene, lumels, find_occluders(scene, movers, atlas))
{
}

World::World(const gpu::Device& device, const Scene& scene, const Lumels& lumels,
             const Occluders& occluders)
    : device_(&device),
      sky_(&scene.sky),
      placements_(placements_of(scene)),
      placement_array_(device, std::span<const Placement>(placements_)),
      local_lumels_(device, std::span<const Lumel>(lumels.lumels)),
      lumels_(device, lumels.lumels.size()),
      local_pieces_(device, std::span<const Piece>(lumels.pieces)),
      pieces_(device, lumels.pieces.size()),
      local_vertices_(device, std::span<const glm::vec3>(occluders.positions)),
      vertices_(device, occluders.positions.size()),
      vertex_instances_(device, std::span<const std::uint32_t>(occluders.instances)),
      looks_(device, std::span<const glm::vec3>(occluders.look)),
      places_(device, std::span<const glm::vec2>(occluders.place)),
      charts_(device, std::span<const glm::vec4>(occluders.chart)),
      indices_(device, std::span<const std::uint32_t>(occluders.indices)),
      opaque_(occluders.opaque),
      place_lumels_(device),
      place_vertices_(device)
{
    bound(scene);
    for (const CutOut& cut_out : occluders.cut_outs) {
        cut_outs_.push_back(make_draw(device, scene, cut_out));
        coloured_glass_ |= is_coloured_glass(scene.materials[cut_out.material]);
    }
    std::vector<glm::mat4> transforms;
    for (const Instance& instance : scene.instances)
        transforms.push_back(instance.transform);
    place(transforms);
}

void World::place(std::span<const glm::mat4> transforms)
{
    for (std::size_t i = 0; i < placements_.size(); ++i)
        placements_[i] = {transforms[i], placements_[i].now};
    placement_array_.upload(placements_);
    gpu::Commands commands(*device_);
    commands.stage("place");
    commands.dispatch(place_lumels_,
                      {.placements = placement_array_,
                       .local_lumels = local_lumels_,
                       .local_pieces = local_pieces_,
                       .lumels = lumels_,
                       .pieces = pieces_},
                      CountParams{std::uint32_t(lumels_.size())}, lumels_.size());
    commands.dispatch(place_vertices_,
                      {.placements = placement_array_,
                       .local_vertices = local_vertices_,
                       .instances = vertex_instances_,
                       .vertices = vertices_},
                      CountParams{std::uint32_t(vertices_.size())}, vertices_.size());
    commands.run();
}

void World::bound(const Scene& scene)
{
    bounded_.resize(scene.instances.size());
    Box all{glm::vec3(std::numeric_limits<float>::max()),
            glm::vec3(std::numeric_limits<float>::lowest())};
    for (std::size_t i = 0; i < bounded_.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!bounded_[i] || bounded_[i]->transform != instance.transform)
            bounded_[i] = {instance.transform, box_of(scene, instance)};
        all.low = glm::min(all.low, bounded_[i]->box.low);
        all.high = glm::max(all.high, bounded_[i]->box.high);
    }
    const bool empty = all.low.x > all.high.x;
    low_ = empty ? glm::vec3(0.0f) : all.low;
    high_ = empty ? glm::vec3(0.0f) : all.high;
}

std::uint64_t World::device_bytes(const Lumels& lumels, const Atlas& atlas)
{
    std::size_t vertices = 0, indices = 0;
    for (const Surface& surface : atlas.surfaces) {
        vertices += surface.texcoord.size();
        indices += surface.indices.size();
    }
    // Lumels, pieces and vertices, both in their instance's frame and in the world; of a vertex
    // also its instance, look, place and chart (see Occluders).
    return lumels.lumels.size() * 2 * sizeof(Lumel) + lumels.pieces.size() * 2 * sizeof(Piece) +
           vertices * (2 * sizeof(glm::vec3) + sizeof(std::uint32_t) + sizeof(glm::vec3) +
                       sizeof(glm::vec2) + sizeof(glm::vec4)) +
           indices * sizeof(std::uint32_t);
}

}  // namespace lumel
