#pragma once

#include "atlas/packing/atlas.h"
#include "lumel/lumel.h"
#include "methods/matrix/relightable.h"
#include "scene/values/scene.h"

namespace lumel::v0 {

/// A bake's light with its sources apart, and what its maps are finished with.
struct RelightableBake {
    lumel::Relightable light;
    lumel::Scene scene;
    Atlas atlas;
    Lumels lumels;
};

}  // namespace lumel::v0
