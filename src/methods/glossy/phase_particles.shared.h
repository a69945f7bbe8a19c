#ifndef LUMEL_METHODS_GLOSSY_PHASE_PARTICLES_SHARED_H
#define LUMEL_METHODS_GLOSSY_PHASE_PARTICLES_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of phase_particles.add.comp.
struct PhaseParticlesParams {
    uint count;            ///< N
    uint half_index;       ///< 0 or 1: which half-solution takes this batch
    float emission_shots;  ///< K_E
    float source_shots;    ///< K_X; 0: no light of X
};

LUMEL_SHARED_END
#endif
