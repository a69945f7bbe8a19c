#pragma once
// What of a scene stays where it is, and where the rest is.

#include <vector>

#include "atlas/near/moved_box.shared.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// The scene with nothing in the places of what moves.
Scene without(const Scene& scene, const std::vector<char>& movers);

/// Lumels of a scene in which `movers` [instances] move. Static geometry buries static lumels that
/// lie under or inside it (atlas/near/buried.h). Throws Error{input} if there are no lumels.
Lumels make_lumels(const Scene& scene, const Atlas& atlas, const std::vector<char>& movers);

/// Where an instance's vertices are, under a transform [m].
MovedBox box_of(const Scene& scene, std::uint32_t instance, const glm::mat4& transform);

/// Around both: one box where it is no larger than the two, else both.
std::vector<MovedBox> around(const MovedBox& before, const MovedBox& after);

/// Does the instance's mesh have single-sided surfaces whose backs can be seen from outside: an
/// edge that does not join two triangles?
bool is_open(const Scene& scene, std::uint32_t instance);

/// Does one transform become the other without stretching and shearing?
bool is_rigid(const glm::mat4& from, const glm::mat4& to);

}  // namespace lumel
