#include "links/kept/link_changes.h"

#include <algorithm>
#include <limits>

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
    const std::vector<glm::vec2>& texcoords = primitive.texcoords[std::size_t(use.texcoord)];
    for (const std::uint32_t corner : primitive.indices)
        if (!texcoords.empty())
            print.add(texcoords[corner]);
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

/// True if rays pass some surface of an instance by chance: by random numbers of its own in each
/// set of instances that is traced.
bool blends(const Scene& scene, const Instance& instance)
{
    const std::vector<Primitive>& all = scene.meshes[std::size_t(instance.mesh)].primitives;
    return std::any_of(all.begin(), all.end(), [&](const Primitive& primitive) {
        const Material& material = scene.materials[std::size_t(primitive.material)];
        return may_be_transparent(material, primitive) && material.alpha_mode != AlphaMode::mask;
    });
}

bool blends(const Scene& scene)
{
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance) { return blends(scene, instance); });
}

/// Marks the lumels near a changed one on its instance, whose hits may now be looked up otherwise.
void mark_around(const Lumels& lumels, const std::vector<std::uint32_t>& by_side,
                 const Lumel& changed, std::vector<char>& lumels_hit)
{
    constexpr int kMarkedTexels =
        2 * kHitReach;  // from a hit's former lumel to one on its other side
    const int width = lumels.width, height = lumels.height;
    const int x0 = int(changed.texel) % width, y0 = int(changed.texel) / width;
    for (int y = std::max(y0 - kMarkedTexels, 0); y <= std::min(y0 + kMarkedTexels, height - 1);
         ++y)
        for (int x = std::max(x0 - kMarkedTexels, 0); x <= std::min(x0 + kMarkedTexels, width - 1);
             ++x)
            for (std::size_t side = 0; side < 2; ++side) {
                const std::size_t texel = std::size_t(y) * std::size_t(width) + std::size_t(x);
                const std::uint32_t i = by_side[2 * texel + side];
                if (i != kNoLumel && lumels.lumels[i].instance == changed.instance)
                    lumels_hit[i] = 1;
            }
}

/// Marks the lumels close to a box, which can be cut otherwise with and without what is in it.
void mark_close(const WorldLumels& world, const Box& box, std::vector<char>& lumels_hit)
{
    constexpr float kCloseSizes = 2.0f;  // a lumel is at most √2 wide, rays just above it
    for (std::size_t i = 0; i < world.size(); ++i) {
        const float reach = kCloseSizes * world[i].size;
        if (box.distance2(world[i].centre) <= reach * reach)
            lumels_hit[i] = 1;
    }
}

bool fits(const StoredLinks& kept, const SolveScene& scene, std::uint32_t seed)
{
    return kept.seed == seed && kept.ray_offset == scene.rays.ray_offset() &&
           kept.side == std::uint32_t(scene.lumels.width) &&
           kept.lumels.size() == scene.lumels.lumels.size() &&
           kept.instances.size() == scene.scene.instances.size();
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
            print.add(world[i].reach);
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

std::vector<Box> instance_boxes(const Scene& scene)
{
    std::vector<Box> boxes;
    for (const Instance& instance : scene.instances) {
        Box box{glm::vec3(std::numeric_limits<float>::max()),
                glm::vec3(std::numeric_limits<float>::lowest())};
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            for (const glm::vec3& position : primitive.positions) {
                const glm::vec3 at(instance.transform * glm::vec4(position, 1.0f));
                box = {glm::min(box.low, at), glm::max(box.high, at)};
            }
        boxes.push_back(box);
    }
    return boxes;
}

LinkChanges changes_since(const StoredLinks& kept, const SolveScene& scene,
                          const WorldLumels& world, std::uint32_t seed)
{
    LinkChanges changes;
    if (!fits(kept, scene, seed))
        return changes;
    const std::vector<Lumel>& lumels = scene.lumels.lumels;
    const std::vector<std::uint64_t> instances = instance_hashes(scene.scene);
    std::size_t moved = kept.gone.size();
    for (std::size_t i = 0; i < instances.size(); ++i)
        moved += instances[i] != kept.instances[i] ? 1 : 0;
    if (moved > kMaxMoved || (kept.reordered && blends(scene.scene)))
        return changes;
    const std::vector<std::uint64_t> prints = lumel_hashes(world, scene.lumels);
    const LinkNumbers numbers = kept.numbers();
    changes.starts.resize(lumels.size());
    changes.ends.resize(numbers.count());
    std::vector<char> lumels_hit(lumels.size(), 0);
    for (const Box& box : kept.gone)
        mark_close(world, box, lumels_hit);
    for (std::uint32_t i = 0; i < instances.size(); ++i)
        if (instances[i] != kept.instances[i]) {
            changes.ends[numbers.black_on(i)] = changes.ends[numbers.lost_on(i)] = 1;
            RayScene tree(scene.scene, std::span(&i, 1));
            const Box box{tree.low(), tree.high()};
            mark_close(world, box, lumels_hit);
            mark_close(world, kept.boxes[i], lumels_hit);
            changes.moved.push_back(
                {std::move(tree), box, blends(scene.scene, scene.scene.instances[i])});
        }
    const std::vector<std::uint32_t> by_side = lumels_by_side(scene.lumels);
    std::size_t starts = 0;
    for (std::size_t i = 0; i < lumels.size(); ++i) {
        const std::uint32_t instance = lumels[i].instance;
        if (prints[i] != kept.lumels[i]) {
            ++starts;
            changes.starts[i] = 1;
            changes.ends[numbers.black_on(instance)] = changes.ends[numbers.lost_on(instance)] = 1;
            mark_around(scene.lumels, by_side, lumels[i], lumels_hit);
        }
        if (instances[instance] != kept.instances[instance])
            lumels_hit[i] = 1;
    }
    std::copy(lumels_hit.begin(), lumels_hit.end(), changes.ends.begin() + numbers.of_part(0));
    changes.all = double(starts) > kMaxStarts * double(lumels.size());
    return changes;
}

}  // namespace lumel
