#ifndef LUMEL_RAYS_DEVICE_DEVICE_CASTER_SHARED_H
#define LUMEL_RAYS_DEVICE_DEVICE_CASTER_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

// Query modes.
LUMEL_CONST uint kNearest = 0u;
LUMEL_CONST uint kOccluder = 1u;  ///< any solid triangle; else any that may transmit light

LUMEL_CONST uint kNoTriangle = 0xffffffffu;

struct CastRay {
    vec3 origin;  ///< [m]
    float near;   ///< [m]
    vec3 direction;
    float far;  ///< [m]
};

struct CastHit {
    uint triangle;     ///< kNoTriangle: no hit. Transmitting triangles follow the solid ones.
    float distance;    ///< [m]
    vec2 barycentric;  ///< weights of its 2nd and 3rd vertex
};

/// Push constants of device_caster.*.comp.
struct CastParams {
    uint rays;
    uint wanted;
    uint solid;  ///< number of solid triangles
};

/// A box of a node and what is in it. As two vec4: each a corner, and a number's bits.
struct TreeBox {
    vec3 low;    ///< [m]
    uint first;  ///< its node, or the first of its triangles
    vec3 high;   ///< [m]
    uint count;  ///< triangles; 0: it is a node
};

/// The boxes of a node's two children: 64 bytes, half a cache line of a GPU.
struct TreeNode {
    TreeBox left;
    TreeBox right;
};

/// A triangle in the order of the tree. As three vec4.
struct TreeTriangle {
    vec3 a;  ///< [m]
    uint number;
    vec3 b;
    uint unused_b;
    vec3 c;
    uint unused_c;
};

/// Boxes on a path from the root, at most.
LUMEL_CONST uint kTreeDepth = 64u;

LUMEL_SHARED_END
#endif
