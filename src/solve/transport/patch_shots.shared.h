#ifndef LUMEL_SOLVE_TRANSPORT_PATCH_SHOTS_SHARED_H
#define LUMEL_SOLVE_TRANSPORT_PATCH_SHOTS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
#include "solve/transport/patches.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kPatchGroup = 64u;     ///< kernels over patches and their lumels
LUMEL_CONST uint kMaxPatchBatch = 64u;  ///< K at most
LUMEL_CONST uint kNoPatch = 0xffffffffu;

/// The light that a patch sends.
LUMEL_CONST uint kSendUnshot = 0u;
LUMEL_CONST uint kSendBack = 1u;      ///< minus the shot light: undoes it
LUMEL_CONST uint kSendShot = 2u;      ///< the shot light again
LUMEL_CONST uint kSendCrossing = 3u;  ///< the shot light again, even if it is 0
LUMEL_CONST uint kSendBackSide = 4u;  ///< none, from the side without lumels
LUMEL_CONST uint kSendTotal = 5u;     ///< shot and unshot light, even if it is 0

struct ChosenPatch {
    uint chart;  ///< kNoPatch: empty entry of the batch
    uint level;
    uint index;  ///< among the chart's patches of that level
    uint send;   ///< kSend…
};

/// Energy of a shooter; its Eye has the geometry.
struct PatchShot {
    vec3 power;        ///< Σ ΔB_j A_j / π
    float size;        ///< diameter of the patch [m]
    float lumel_size;  ///< size of its largest lumel [m]
    uint first;        ///< first of its lumels
    uint count;        ///< 0: nothing is shot
    uint parts;        ///< number of points that share the patch's light
    uint number;       ///< index of the patch's point, the same whenever it shoots
    float facing;      ///< 1, or -1 for objects behind its lumels
};

/// Push constants of kernels over the patches of a batch.
struct TakeParams {
    uint batch;  ///< K
};

/// Push constants of patch_shots.take.comp.
struct TakeLightParams {
    uint batch;         ///< K
    uint first_number;  ///< added to the numbers of all points
};

LUMEL_SHARED_END
#endif
