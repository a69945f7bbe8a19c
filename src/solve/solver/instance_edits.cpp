#include "solve/solver/instance_edits.h"

#include <algorithm>
#include <string>
#include <utility>

#include "atlas/near/still_part.h"
#include "base/core/error.h"

namespace lumel {
namespace {

std::string name_of(std::uint32_t instance)
{
    return "instance " + std::to_string(instance);
}

std::vector<char> flags_of(const Scene& scene, const std::vector<std::uint32_t>& movers, bool still)
{
    if (still)
        return std::vector<char>(scene.instances.size(), 0);
    std::vector<char> flags(scene.instances.size(), char(movers.empty()));
    for (const std::uint32_t instance : movers) {
        if (instance >= flags.size())
            throw Error(ErrorKind::input, name_of(instance),
                        "cannot move: the scene has only " + std::to_string(flags.size()));
        flags[instance] = 1;
    }
    return flags;
}

void set_factor(std::vector<glm::vec3>& factors, std::uint32_t instance, const glm::vec3& factor)
{
    if (instance >= factors.size())
        throw Error(ErrorKind::input, name_of(instance), "is not in the scene");
    if (!glm::all(glm::greaterThanEqual(factor, glm::vec3(0.0f))))
        throw Error(ErrorKind::input, name_of(instance),
                    "cannot emit or reflect a negative amount of light");
    factors[instance] = factor;
}

}  // namespace

InstanceEdits::InstanceEdits(const Scene& scene, const std::vector<std::uint32_t>& movers,
                             bool still)
    : max_albedo_(scene.max_albedo),
      movers_(flags_of(scene, movers, still)),
      requested_(scene.instances.size()),
      emission_factor_(scene.instances.size(), glm::vec3(1.0f)),
      reflectance_factor_(scene.instances.size(), glm::vec3(1.0f))
{
}

void InstanceEdits::move(const Scene& scene, std::uint32_t instance, const glm::mat4& transform)
{
    if (instance >= movers_.size() || !movers_[instance])
        throw Error(ErrorKind::input, name_of(instance), "is not movable");
    if (!is_rigid(scene.instances[instance].transform, transform))
        throw Error(ErrorKind::input, name_of(instance),
                    "can be rotated and moved, but not stretched");
    requested_[instance] = transform;
}

bool InstanceEdits::is_move_requested() const
{
    return std::any_of(requested_.begin(), requested_.end(), [](auto& move) { return bool(move); });
}

std::optional<glm::mat4> InstanceEdits::take_move(const Scene& scene, std::uint32_t instance)
{
    const std::optional<glm::mat4> move = std::exchange(requested_[instance], {});
    return move != scene.instances[instance].transform ? move : std::nullopt;
}

void InstanceEdits::set_emission(std::uint32_t instance, const glm::vec3& factor)
{
    set_factor(emission_factor_, instance, factor);
}

void InstanceEdits::set_reflectance(std::uint32_t instance, const glm::vec3& factor)
{
    set_factor(reflectance_factor_, instance, factor);
}

Lumels InstanceEdits::scaled(Lumels lumels) const
{
    for (Lumel& lumel : lumels.lumels) {
        lumel.emission *= emission_factor_[lumel.instance];
        lumel.albedo = capped(lumel.albedo * reflectance_factor_[lumel.instance], max_albedo_);
    }
    return lumels;
}

}  // namespace lumel
