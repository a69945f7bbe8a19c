#include "links/live/albedo_overrides.h"

#include <utility>

namespace lumel {
namespace {

/// [N] Albedos of the file's colours, without a cap: these are linear in the colours.
std::vector<glm::vec3> uncapped_albedos(Scene scene, const Atlas& atlas)
{
    scene.max_albedo = 1.0f;
    std::vector<glm::vec3> albedos;
    for (const Lumel& lumel : make_lumels(scene, atlas).lumels)
        albedos.push_back(lumel.albedo);
    return albedos;
}

}  // namespace

AlbedoOverrides::AlbedoOverrides(const Lumels& lumels)
{
    for (const Lumel& lumel : lumels.lumels)
        albedo_.push_back(lumel.albedo);
}

/// Computed from the difference of a white and a black material.
AlbedoOverrides::Coat AlbedoOverrides::coat_of(const Scene& scene, const Atlas& atlas,
                                               int material) const
{
    const auto albedos = [&](float grey) {
        Scene painted = scene;
        glm::vec4& base = painted.materials[std::size_t(material)].base_color;
        base = glm::vec4(glm::vec3(grey), base.a);
        return uncapped_albedos(std::move(painted), atlas);
    };
    const std::vector<glm::vec3> white = albedos(1.0f), black = albedos(0.0f);
    Coat coat{glm::vec3(scene.materials[std::size_t(material)].base_color), {}};
    for (std::uint32_t i = 0; i < albedo_.size(); ++i)
        if (white[i] != black[i])
            coat.shares.push_back({i, white[i] - black[i]});
    return coat;
}

void AlbedoOverrides::set(const Scene& scene, const Atlas& atlas, int material,
                          const glm::vec3& colour)
{
    if (uncapped_.empty())
        uncapped_ = uncapped_albedos(scene, atlas);
    auto found = coats_.find(material);
    if (found == coats_.end())
        found = coats_.emplace(material, coat_of(scene, atlas, material)).first;
    Coat& coat = found->second;
    for (const Share& share : coat.shares) {
        glm::vec3& albedo = uncapped_[share.lumel];
        albedo += share.per_colour * (colour - coat.colour);
        albedo_[share.lumel] = capped(glm::max(albedo, 0.0f), scene.max_albedo);
    }
    coat.colour = colour;
}

void AlbedoOverrides::paint(std::vector<Material>& materials) const
{
    for (const auto& [material, coat] : coats_) {
        glm::vec4& base = materials[std::size_t(material)].base_color;
        base = glm::vec4(coat.colour, base.a);
    }
}

}  // namespace lumel
