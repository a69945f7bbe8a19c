#ifndef LUMEL_ATLAS_PACKING_LUMEL_SHARED_H
#define LUMEL_ATLAS_PACKING_LUMEL_SHARED_H
#include "scene/values/shininess.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kLumelBack = 1u;    ///< flag: the back side of a double-sided surface
LUMEL_CONST uint kLumelBuried = 2u;  ///< flag: under other geometry, without light
LUMEL_CONST uint kLumelMoving =
    4u;  ///< flag: lit only by cross redistribution, see methods/redistribution/cross.cpp

LUMEL_CONST uint kNoLumel = 0xffffffffu;  ///< no lumel at a texel

/// A lightmap texel as a patch of the radiosity equation. Lengths and directions are in the
/// frame of its instance, areas and sizes in world space.
struct Lumel {
    vec3 position;  ///< x  [m]     point of the covered part nearest its centroid, instance frame
    vec3 normal;    ///< n  [1]     unit, mean over the covered part, instance frame
    float area;     ///< A  [m²]    covered area × opacity, world
    float size;     ///<    [m]     larger of √A and the covered part's diameter / √2, world
    vec3 albedo;    ///< ρ  [1]     mean over the covered part, 0…1
    vec3 emission;  ///< E  [lm/m²] π × mean emitted luminance
    uint instance;  ///< index into Scene::instances
    uint chart;     ///< index of its chart
    uint texel;     ///< y * atlas width + x
    uint first_piece;  ///< its pieces are [first_piece, first_piece + piece_count)
    uint piece_count;  ///< ≥ 1
    uint flags;        ///< kLumelBack | kLumelBuried | kLumelMoving
};

/// Reflection for glossy methods: [NNS99]'s model, see methods/glossy/phong.glsl.
struct Gloss {
    vec3 diffuse;     ///< ρ_d [1] diffuse reflectance
    vec3 specular;    ///< ρ_s [1] specular reflectance; ρ_d + ρ_s ≤ 1
    float shininess;  ///< n   [1] exponent, 1…kMaxShininess
};

/// A flat part of a lumel: the texel's square, clipped to a triangle and divided into triangles or
/// parallelograms. Its points are origin + u edge_u + v edge_v; in a triangle u + v ≤ 1.
struct Piece {
    vec3 origin;  ///< [m] instance frame
    vec3 edge_u;  ///< [m]
    vec3 edge_v;  ///< [m] cross(edge_u, edge_v) points to the lumel's side (before mirroring)
    vec3 normal;  ///< [1] unit, interpolated vertex normal at the piece's centre
    float share;  ///< running sum of area shares within the lumel, up to 1
    uint parallelogram;  ///< 1: u, v in 0…1; 0: triangle
};

LUMEL_SHARED_END
#endif
