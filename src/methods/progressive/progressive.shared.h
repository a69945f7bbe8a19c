#ifndef LUMEL_METHODS_PROGRESSIVE_PROGRESSIVE_SHARED_H
#define LUMEL_METHODS_PROGRESSIVE_PROGRESSIVE_SHARED_H
#include "solve/transport/patch_shots.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kNoLevel = 0xffffffffu;  ///< chart that never shot

/// Next patch to shoot: patch `next` of a chart.
struct Cursor {
    uint chart;
    uint level;
    uint next;
    uint count;  ///< patches of the chart at that level; next == count: finished
    uint send;   ///< kSendUnshot or kSendBack
};

/// Light of a chart, or of all of them [lm].
struct ChartLight {
    float power;     ///< Σ A |𝓛| of the light sent next
    vec3 unshot;     ///< Σ A B^u
    vec3 shot;       ///< Σ A B^s
    vec3 arrived;    ///< Σ A H
    vec3 reflected;  ///< Σ A ρ H
};

/// Push constants of progressive.power.comp and progressive.select.comp.
struct ChooseParams {
    uint charts;
    uint batch;         ///< K
    uint finest;        ///< finest allowed level
    float patch_share;  ///< limit of a patch's light, relative to all light
    float area;         ///< Σ A [m²]
};

/// Push constants of progressive.receive.comp.
struct PatchReceiveParams {
    EyeViewLayout views;
    DispatchRange range;  ///< lumels of this dispatch
    uint shots;           ///< K
    float near_radius;    ///< pairs closer than this × the larger size are in the near field
};

LUMEL_SHARED_END
#endif
