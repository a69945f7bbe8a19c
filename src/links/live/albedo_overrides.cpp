#include "links/live/albedo_overrides.h"

#include <algorithm>

namespace lumel {

AlbedoOverrides::AlbedoOverrides(const Lumels& lumels)
{
    for (const Lumel& lumel : lumels.lumels)
        unclamped_.push_back(lumel.albedo);
    albedo_ = unclamped_;
}

/// Computed from the difference of a white and a black material.
AlbedoOverrides::Coat AlbedoOverrides::coat_of(const Scene& scene, const Atlas& atlas,
                                               int material) const
{
    const auto albedos = [&](float grey) {
        Scene painted = scene;
        glm::vec4& base = painted.materials[std::size_t(material)].base_color;
        base = glm::vec4(glm::vec3(grey), base.a);
        return make_lumels(painted, atlas).lumels;
    };
    const std::vector<Lumel> white = albedos(1.0f), black = albedos(0.0f);
    Coat coat{glm::vec3(scene.materials[std::size_t(material)].base_color), {}};
    for (std::uint32_t i = 0; i < albedo_.size(); ++i)
        if (white[i].albedo != black[i].albedo)
            coat.shares.push_back({i, white[i].albedo - black[i].albedo});
    return coat;
}

void AlbedoOverrides::set(const Scene& scene, const Atlas& atlas, int material,
                          const glm::vec3& colour)
{
    auto found = coats_.find(material);
    if (found == coats_.end())
        found = coats_.emplace(material, coat_of(scene, atlas, material)).first;
    Coat& coat = found->second;
    for (const Share& share : coat.shares) {
        unclamped_[share.lumel] += share.per_colour * (colour - coat.colour);
        albedo_[share.lumel] = glm::clamp(unclamped_[share.lumel], 0.0f, 1.0f);
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
