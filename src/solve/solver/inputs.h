#pragma once
// What solvers work on.

#include <span>

#include <glm/glm.hpp>

#include "atlas/near/near_field.h"
#include "raster/world/world.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/parts.h"

namespace lumel {

class LobeParticles;

/// A scene for methods that trace rays on the host.
struct HostScene {
    const Scene& scene;
    const RayScene& rays;
    const Atlas& atlas;
};

/// What a method works on. All must outlive it.
struct SolverInputs {
    const gpu::Device& device;
    const World* world;  ///< null for a method that is not on the device
    const Lumels& lumels;
    const NearField& near;  ///< may be empty for methods and schemes without a near field
    /// H [N] [lx] that lumels receive beside what the solver finds, or empty: the error it states
    /// is a part of both, but the noise of what is known is not in it.
    std::span<const glm::vec3> known = {};
    const LobeParticles* particles = nullptr;  ///< see GlossyIllumination
    /// E [N] [lm/m²] of surfaces whose direct light is a part of `known`, for indirect light alone:
    /// the lumels' own emission is then what they reflect diffusely of `known`, and lobes reflect
    /// the rest. Or empty.
    std::span<const glm::vec3> first_emission = {};
    /// For links, matrix and directions of Scheme::phased; only while they are made.
    const HostScene* host = nullptr;
    Parts parts = Parts::all;  ///< what is returned by methods that find lights or finds_emitted()
};

}  // namespace lumel
