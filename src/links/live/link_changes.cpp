#include "links/live/link_changes.h"

#include <algorithm>

#include "atlas/cells/near_lumels.h"
#include "base/core/fingerprint.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Lumels per task.
constexpr std::size_t kComparedPerTask = 1024;
/// With more moved instances, or a larger fraction of changed lumels, all links are traced:
/// searching for changed links would take as long.
constexpr std::size_t kMaxMoved = 64;
constexpr double kMaxStarts = 0.5;

/// Adds the transmission of a material. Textures are hashed by content.
void add_passage(Fingerprint& print, const Scene& scene, const Primitive& primitive)
{
    const Material& material = scene.materials[std::size_t(primitive.material)];
    print.add(int(material.double_sided));
    const bool may_pass = may_be_transparent(material, primitive);
    print.add(int(may_pass));
    if (!may_pass)
        return;
    print.add(int(material.alpha_mode));
    print.add(material.alpha_cutoff);
    print.add(material.transmission);
    print.add(material.base_color);
    const TextureUse& use = material.base_color_texture;
    if (use.texture < 0)
        return;
    print.add(use.texcoord);
    print.add(use.transform);
    print.add(int(use.wrap_s));
    print.add(int(use.wrap_t));
    print.add(scene.textures[std::size_t(use.texture)].rgba);
}

/// By corner: vertices may have been split.
void add_triangles(Fingerprint& print, const Primitive& primitive)
{
    for (const std::uint32_t corner : primitive.indices) {
        print.add(primitive.positions[corner]);
        if (!primitive.colors.empty())
            print.add(primitive.colors[corner]);
    }
}

/// Marks the lumels near a changed one on its instance, whose hits may now be looked up otherwise.
void mark_around(const Lumels& lumels, const std::vector<std::uint32_t>& by_side,
                 const Lumel& changed, std::vector<char>& ends)
{
    const int width = lumels.width, height = lumels.height;
    const int x0 = int(changed.texel) % width, y0 = int(changed.texel) / width;
    for (int y = std::max(y0 - kHitReach, 0); y <= std::min(y0 + kHitReach, height - 1); ++y)
        for (int x = std::max(x0 - kHitReach, 0); x <= std::min(x0 + kHitReach, width - 1); ++x)
            for (std::size_t side = 0; side < 2; ++side) {
                const std::size_t texel = std::size_t(y) * std::size_t(width) + std::size_t(x);
                const std::uint32_t i = by_side[2 * texel + side];
                if (i != kNoLumel && lumels.lumels[i].instance == changed.instance)
                    ends[i] = 1;
            }
}

bool fits(const StoredLinks& kept, const LinkContext& place, std::uint32_t rays, std::uint32_t seed)
{
    return kept.rays == rays && kept.seed == seed && kept.ray_offset == place.rays.ray_offset() &&
           kept.side == std::uint32_t(place.scene.lumels.width) &&
           kept.lumels.size() == place.lumels().size() &&
           kept.instances.size() == place.scene.scene.instances.size();
}

}  // namespace

std::vector<std::uint64_t> lumel_hashes(const WorldLumels& world, const Lumels& lumels)
{
    std::vector<std::uint64_t> prints(lumels.lumels.size());
    parallel_for(prints.size(), kComparedPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Lumel& lumel = lumels.lumels[i];
            const auto pieces = world.pieces(world[i]);
            Fingerprint print;
            print.add(lumel.texel % std::uint32_t(lumels.width));
            print.add(lumel.texel / std::uint32_t(lumels.width));
            print.add(lumel.flags);
            print.add(world[i].centre);
            print.add(world[i].normal);
            print.add(world[i].size);
            print.add_bytes(pieces.data(), pieces.size_bytes());
            prints[i] = print.value();
        }
    });
    return prints;
}

std::vector<std::uint64_t> instance_hashes(const Scene& scene)
{
    std::vector<std::uint64_t> prints;
    for (const Instance& instance : scene.instances) {
        Fingerprint print;
        print.add(instance.transform);
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) {
            add_triangles(print, primitive);
            add_passage(print, scene, primitive);
        }
        prints.push_back(print.value());
    }
    return prints;
}

LinkChanges changes_since(const StoredLinks& kept, const LinkContext& place, std::uint32_t rays,
                          std::uint32_t seed)
{
    LinkChanges changes;
    if (!fits(kept, place, rays, seed))
        return changes;
    const std::vector<Lumel>& lumels = place.lumels();
    const std::vector<std::uint64_t> prints = lumel_hashes(place.world, place.scene.lumels);
    const std::vector<std::uint64_t> instances = instance_hashes(place.scene.scene);
    const std::size_t lost = lumels.size() + 2;  // absorbed on an instance
    changes.starts.resize(lumels.size());
    changes.ends.resize(kept.gone() + 1);
    changes.ends[kept.gone()] = 1;
    for (std::uint32_t i = 0; i < instances.size(); ++i)
        if (instances[i] != kept.instances[i]) {
            changes.ends[lost + i] = 1;
            RayScene tree(place.scene.scene, std::span(&i, 1));
            const Box box{tree.low(), tree.high()};
            changes.moved.push_back({std::move(tree), box});
        }
    const std::vector<std::uint32_t> by_side = lumels_by_side(place.scene.lumels);
    std::size_t starts = 0;
    for (std::size_t i = 0; i < lumels.size(); ++i) {
        const std::uint32_t instance = lumels[i].instance;
        if (prints[i] != kept.lumels[i]) {
            ++starts;
            changes.starts[i] = changes.ends[lost + instance] = 1;
            mark_around(place.scene.lumels, by_side, lumels[i], changes.ends);
        }
        if (instances[instance] != kept.instances[instance])
            changes.ends[i] = 1;
    }
    changes.all =
        changes.moved.size() > kMaxMoved || double(starts) > kMaxStarts * double(lumels.size());
    return changes;
}

}  // namespace lumel
