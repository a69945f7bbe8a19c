#pragma once
// Inputs of solvers.

#include <span>

#include <glm/glm.hpp>

#include "atlas/near/near_field.h"
#include "atlas/prepare/solve_scene.h"
#include "base/ranks/ranks.h"
#include "raster/world/world.h"
#include "scene/values/parts.h"

namespace lumel {

class LobeParticles;

/// Inputs of a method. All must outlive it.
struct SolverInputs {
    const gpu::Device* device;  ///< null only for methods that run on the CPU, if there is none
    const World* world;         ///< null for methods that run on the CPU
    const Lumels& lumels;
    const NearField& near;  ///< may be empty for methods and schemes that use no near field
    /// Given irradiance H [N] [lx] in addition to the solver's, or empty. The estimated error is
    /// relative to the sum of both; noise of the given part is not in it.
    std::span<const glm::vec3> known = {};
    const LobeParticles* particles = nullptr;  ///< see GlossyIllumination
    /// E [N] [lm/m²] of surfaces whose direct light is part of `known`, to solve for indirect light
    /// only; or empty. The emission of `lumels` is then the diffuse reflection of `known`, and
    /// lobes reflect the rest.
    std::span<const glm::vec3> first_emission = {};
    /// For methods that trace rays on the CPU: links, matrix, and directions of Scheme::phased.
    const SolveScene* scene = nullptr;
    Parts parts = Parts::all;  ///< results of methods that find lights or finds_emitted()
    Ranks* ranks = nullptr;    ///< that share the work of links; null: none
};

}  // namespace lumel
