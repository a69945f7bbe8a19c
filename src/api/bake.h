#pragma once

#include "atlas/packing/atlas.h"
#include "lumel/lumel.h"
#include "methods/matrix/relightable.h"
#include "scene/values/scene.h"

namespace lumel::v0 {

/// A bake's light, separated by source, and the data to finish its maps.
struct RelightableBake {
    lumel::Relightable light;
    lumel::Scene scene;
    Atlas atlas;
    Lumels lumels;
};

}  // namespace lumel::v0
