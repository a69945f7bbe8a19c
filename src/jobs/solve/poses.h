#pragma once
// Limits on animations of scenes whose lumels are kept.

#include "scene/values/animation.h"

namespace lumel {

/// start: the scene at 0 s of the animation. Throws Error{input} if a frame stretches an object,
/// since lumels keep their areas, or moves it too far away to be computed.
void check_poses(const Scene& start, const Animation& animation, int frames, double fps);

}  // namespace lumel
