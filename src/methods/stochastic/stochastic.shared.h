#ifndef LUMEL_METHODS_STOCHASTIC_STOCHASTIC_SHARED_H
#define LUMEL_METHODS_STOCHASTIC_STOCHASTIC_SHARED_H
#include "solve/shooting/shooters.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of stochastic.receive.comp.
struct ReceiveParams {
    EyeViewLayout views;
    DispatchRange range;  ///< lumels of this dispatch
    uint count;           ///< N
    uint shots;           ///< K
    uint emission_shots;  ///< the first of these are from E
    uint half_index;      ///< 0 or 1: which half-solution takes this batch
    uint iteration;       ///< index of the batch
    uint seed;
    uint centre;        ///< 1: receive at the centroid
    float near_radius;  ///< pairs closer than this × the larger size are in the near field
};

LUMEL_SHARED_END
#endif
