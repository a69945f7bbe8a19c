#ifndef LUMEL_RESULTS_DIRECTIONAL_DIRECTIONAL_SHARED_H
#define LUMEL_RESULTS_DIRECTIONAL_DIRECTIONAL_SHARED_H
#include "base/core/harmonics.shared.h"
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kElevations = 129u;  ///< rows of the fit's table, z = -1…1

/// Coefficients of a lumel of normal n for radiance × solid angle 1 from ω, with z = n·ω and t = ω
/// - z n:
///     band 0   zero
///     band 1   u = along n + across t,                      (y, z, x) of u
///     band 2   M = axial (n nᵀ - I/3) + skew (n tᵀ + t nᵀ) + planar (t tᵀ - t·t (I - n nᵀ) / 2),
///              kY2 (M_xy, M_yz), 3 kY20 M_zz, kY2 M_xz, kY22 (M_xx - M_yy)
struct FitRow {
    float zero;
    float along, across;
    float axial, skew, planar;
};

/// Push constants of directional.receive.comp.
struct DirectionalReceiveParams {
    EyeViewLayout views;
    DispatchRange range;  ///< lumels of this dispatch
    uint count;           ///< N
    uint shots;           ///< K
    uint iteration;
    uint seed;
    uint centre;        ///< 1: receive at the centroid
    uint order;         ///< 1 or 2
    float near_radius;  ///< pairs closer than this × the larger size are in the near field
};

/// Push constants of directional.near.comp.
struct DirectionalNearParams {
    DispatchRange range;  ///< lumels of this dispatch
    uint count;
    uint order;
    float shots;  ///< number of shots in the bands' sums
};

LUMEL_SHARED_END
#endif
