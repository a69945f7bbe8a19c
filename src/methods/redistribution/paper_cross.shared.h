#ifndef LUMEL_METHODS_REDISTRIBUTION_PAPER_CROSS_SHARED_H
#define LUMEL_METHODS_REDISTRIBUTION_PAPER_CROSS_SHARED_H
#include "methods/redistribution/cross.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kPaperGatherGroup = 256u;  ///< group of paper_cross.gather.comp; a power of two

/// Triangle of a movable object, world space [m].
struct MoverTriangle {
    vec3 a, b, c;
};

/// Push constants of paper_cross.gather.comp.
struct PaperGatherParams {
    EyeViewLayout views;
    uint samples;  ///< samples per pixel
};

/// Push constants of paper_cross.receive.comp.
struct PaperReceiveParams {
    EyeViewLayout views;
    BackLayout back;
    DispatchRange range;  ///< lumels of this dispatch
    uint shots;           ///< K
    float sign_factor;    ///< -1: takes the patches out of their old position, 1: puts them in
    uint triangles;       ///< of movable objects in their other position; 0: no ray is culled
    uint reprojects;      ///< 0: rays end in their own direction from the back eye, figure 4.5.3
};

LUMEL_SHARED_END
#endif
