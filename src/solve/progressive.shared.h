#ifndef LUMEL_SOLVE_PROGRESSIVE_SHARED_H
#define LUMEL_SOLVE_PROGRESSIVE_SHARED_H
#include "solve/patches.shared.h"
#include "visibility/eye_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kProgressiveGroup = 64u;
LUMEL_CONST uint kMostPatchBatch = 64u;  ///< K at most
LUMEL_CONST uint kNoPatch = 0xffffffffu;
LUMEL_CONST uint kNoLevel = 0xffffffffu;  ///< of a chart that never shot

/// What is shot of a patch.
LUMEL_CONST uint kSendUnshot = 0u;
LUMEL_CONST uint kSendBack = 1u;      ///< what was shot, negative: it is taken back
LUMEL_CONST uint kSendShot = 2u;      ///< what was shot, once more
LUMEL_CONST uint kSendCrossing = 3u;  ///< the same, also where that is nothing
LUMEL_CONST uint kSendBackSide = 4u;  ///< nothing, from the side that has no lumels

/// Where shooting goes on: patch `next` of a chart.
struct Cursor {
    uint chart;
    uint level;
    uint next;
    uint count;  ///< patches of the chart at that level; next == count: it is done
    uint send;   ///< kSendUnshot or kSendBack
};

/// A patch that is to shoot.
struct ChosenPatch {
    uint chart;  ///< kNoPatch: none, the place in the batch stays empty
    uint level;
    uint index;  ///< of the chart's patches of that level
    uint send;   ///< kSend…
};

/// Light of a chart, or of all of them [lm].
struct ChartLight {
    float power;     ///< Σ A |𝓛| of what is sent next
    vec3 unshot;     ///< Σ A B^u
    vec3 shot;       ///< Σ A B^s
    vec3 arrived;    ///< Σ A H
    vec3 reflected;  ///< Σ A ρ H
};

/// The energy side of a shooter; its Eye is the geometric side.
struct PatchShot {
    vec3 power;        ///< Σ ΔB_j A_j / π
    float size;        ///< diameter of the patch [m]
    float lumel_size;  ///< largest of its lumels [m]
    uint first;        ///< its lumels
    uint count;        ///< 0: nothing is shot
    uint parts;        ///< so many points share the patch's light
    uint number;       ///< of the patch's point, the same whenever it shoots
    float side_;       ///< 1, or -1 of what stands on the back of its lumels
};

/// Push constants of progressive.power.comp and progressive.select.comp.
struct ChooseParams {
    uint charts;
    uint batch;         ///< K
    uint finest;        ///< level at most
    float patch_share;  ///< a patch is to send no more than this part of all light
    float area;         ///< Σ A [m²]
};

/// Push constants of patch_shots.take.comp and progressive.settle.comp.
struct TakeParams {
    uint batch;  ///< K
};

/// Push constants of progressive.receive.comp.
struct PatchReceiveParams {
    EyeViewLayout views;
    uint first;  ///< lumels [first, last) of this dispatch
    uint last;
    uint shots;         ///< K
    float near_radius;  ///< pairs closer than this × the larger size belong to the near field
};

/// Push constants of progressive.residual.comp.
struct ResidualParams {
    uint count;
};

LUMEL_SHARED_END
#endif
