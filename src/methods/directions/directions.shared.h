#ifndef LUMEL_METHODS_DIRECTIONS_DIRECTIONS_SHARED_H
#define LUMEL_METHODS_DIRECTIONS_DIRECTIONS_SHARED_H
#include "raster/parallel/illumination_maps.shared.h"
LUMEL_SHARED_BEGIN

/// A direction to gather light from.
struct GlobalDirection {
    vec3 toward;  ///< d: unit, from receivers to the surfaces they see
    vec3 sky;     ///< radiance of the sky [cd/m²]
};

/// Correction of a lumel's light, over all directions so far. A map shows the world along d only
/// where one of its rays hits the lumel, with a probability P known approximately; Σ sought / Σ
/// found corrects P.
struct SeenLight {
    float sought;  ///< Σ cosθ
    float found;   ///< Σ cosθ/P where the map has a ray
};

/// Push constants of directions.gather.comp.
struct GatherParams {
    ParallelLayout tiling;
    DispatchRange range;  ///< lumels of this dispatch
    uint count;           ///< N
    uint first_view;      ///< views [first_view, first_view + views) in tiles 0, 1, …
    uint views;           ///< K
    uint half_index;      ///< 0 or 1: which half-solution takes this batch
    uint first_point;     ///< index of a lumel's receiving point
    uint seed;
    uint centre;         ///< 1: receive at the centroid
    uint neighbours;     ///< lookups to each side of a pixel: 0, 1 or 2
    uint by_planes;      ///< 1: LookupTest::planes
    uint with_emission;  ///< 0: the source holds the emission, as in the paper
    uint with_source;    ///< 0: the source is still 0
    uint layer;          ///< peeled: number of layers in front of the map's
    uint keep;           ///< peeled: 1: only store what the layer shows; 0: add what was stored
    uint slabs;          ///< S, see IlluminationMaps
    uint maps;           ///< maps per direction
};

LUMEL_SHARED_END
#endif
