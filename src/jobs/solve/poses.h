#pragma once
// What an animation may do to a scene whose lumels are kept.

#include "scene/values/animation.h"

namespace lumel {

/// start: the scene as the animation has it at 0 s. Throws Error{input} if in a frame something is
/// stretched, since lumels keep their areas, or too far out to be computed.
void check_poses(const Scene& start, const Animation& animation, int frames, double fps);

}  // namespace lumel
