#ifndef LUMEL_SOLVE_TRANSPORT_PATCH_SHOTS_SHARED_H
#define LUMEL_SOLVE_TRANSPORT_PATCH_SHOTS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
#include "solve/transport/patches.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kPatchGroup = 64u;     ///< of kernels over patches and their lumels
LUMEL_CONST uint kMaxPatchBatch = 64u;  ///< K at most
LUMEL_CONST uint kNoPatch = 0xffffffffu;

/// What is shot of a patch.
LUMEL_CONST uint kSendUnshot = 0u;
LUMEL_CONST uint kSendBack = 1u;      ///< what was shot, negative: it is taken back
LUMEL_CONST uint kSendShot = 2u;      ///< what was shot, once more
LUMEL_CONST uint kSendCrossing = 3u;  ///< the same, also where that is nothing
LUMEL_CONST uint kSendBackSide = 4u;  ///< nothing, from the side that has no lumels

/// A patch that is to shoot.
struct ChosenPatch {
    uint chart;  ///< kNoPatch: none, the place in the batch stays empty
    uint level;
    uint index;  ///< of the chart's patches of that level
    uint send;   ///< kSend…
};

/// The energy side of a shooter; its Eye is the geometric side.
struct PatchShot {
    vec3 power;        ///< Σ ΔB_j A_j / π
    float size;        ///< diameter of the patch [m]
    float lumel_size;  ///< largest of its lumels [m]
    uint first;        ///< its lumels
    uint count;        ///< 0: nothing is shot
    uint parts;        ///< number of points that share the patch's light
    uint number;       ///< of the patch's point, the same whenever it shoots
    float facing;      ///< 1, or -1 of what stands on the back of its lumels
};

/// Push constants of kernels over the patches of a batch.
struct TakeParams {
    uint batch;  ///< K
};

LUMEL_SHARED_END
#endif
