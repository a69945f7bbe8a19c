#pragma once
// Static part of a scene, and bounds of the rest.

#include <vector>

#include "atlas/near/moved_box.shared.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// The scene with movable instances emptied.
Scene without(const Scene& scene, const std::vector<char>& movers);

/// Lumels of a scene in which `movers` [instances] move. Static geometry buries static lumels that
/// lie under or inside it (atlas/near/buried.h). Throws Error{input} if there are no lumels.
Lumels make_lumels(const Scene& scene, const Atlas& atlas, const std::vector<char>& movers);

/// Bounds of an instance's vertices under a transform [m].
MovedBox box_of(const Scene& scene, std::uint32_t instance, const glm::mat4& transform);

/// Bounds of both boxes: one box if it is no larger than the two, else both.
std::vector<MovedBox> around(const MovedBox& before, const MovedBox& after);

/// True if the backs of the mesh's single-sided surfaces are visible from outside, i.e. an edge
/// does not join two triangles.
bool is_open(const Scene& scene, std::uint32_t instance);

/// True if the change between two transforms has no stretch or shear.
bool is_rigid(const glm::mat4& from, const glm::mat4& to);

}  // namespace lumel
