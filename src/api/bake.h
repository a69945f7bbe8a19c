#pragma once

#include "atlas/atlas.h"
#include "lumel/lumel.h"
#include "relight/relightable.h"
#include "scene/scene.h"

namespace lumel::v0 {

/// A bake's light with its sources apart, and what its maps are finished with.
struct Relightable {
    lumel::Relightable light;
    lumel::Scene scene;
    Atlas atlas;
    Lumels lumels;
};

}  // namespace lumel::v0
