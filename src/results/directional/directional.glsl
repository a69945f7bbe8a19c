#ifndef LUMEL_DIRECTIONAL_DIRECTIONAL_GLSL
#define LUMEL_DIRECTIONAL_DIRECTIONAL_GLSL

// Sums of spherical harmonics for one lumel. Declares the bands that store them, and `fit`.

#include "results/directional/directional.shared.h"

layout(scalar) readonly buffer Fit { FitRow fit[]; };
layout(scalar) buffer Band0 { vec3 band0[]; };  // [2l + 1][N] each
layout(scalar) buffer Band1 { vec3 band1[]; };
layout(scalar) buffer Band2 { vec3 band2[]; };

vec3 sums[9];

FitRow fit_row(float z)
{
    const float at = clamp(0.5 * z + 0.5, 0.0, 1.0) * float(kElevations - 1u);
    const uint row = min(uint(at), kElevations - 2u);
    const float f = at - float(row);
    const FitRow a = fit[row], b = fit[row + 1u];
    return FitRow(mix(a.zero, b.zero, f), mix(a.along, b.along, f), mix(a.across, b.across, f),
                  mix(a.axial, b.axial, f), mix(a.skew, b.skew, f), mix(a.planar, b.planar, f));
}

// Coefficients of a lumel of normal n for radiance × solid angle 1 from unit direction `from`; see
// FitRow.
void coefficients_of(vec3 from, vec3 n, uint order, out float c[9])
{
    const float z = dot(n, from);
    const vec3 t = from - z * n;
    const FitRow row = fit_row(z);
    const vec3 u = row.along * n + row.across * t;
    c[0] = row.zero;
    c[1] = u.y;
    c[2] = u.z;
    c[3] = u.x;
    if (order < 2u)
        return;
    const float even = 0.5 * row.planar * dot(t, t);
    const vec3 square = (row.axial + even) * n * n + 2.0 * row.skew * n * t + row.planar * t * t -
                        (row.axial / 3.0 + even);
    const vec3 a = (row.axial + even) * n + row.skew * t, b = row.skew * n + row.planar * t;
    const vec3 product = a * n.yzx + b * t.yzx;  // xy, yz, zx
    c[4] = kY2 * product.x;
    c[5] = kY2 * product.y;
    c[6] = 3.0 * kY20 * square.z;
    c[7] = kY2 * product.z;
    c[8] = kY22 * (square.x - square.y);
}

// Unrolled, so that arrays stay in registers.
void add_light(float c[9], vec3 light, uint order)
{
    sums[0] += light * c[0];
    sums[1] += light * c[1];
    sums[2] += light * c[2];
    sums[3] += light * c[3];
    if (order < 2u)
        return;
    sums[4] += light * c[4];
    sums[5] += light * c[5];
    sums[6] += light * c[6];
    sums[7] += light * c[7];
    sums[8] += light * c[8];
}

void load_sums(uint i, uint count, uint order)
{
    sums[0] = band0[i];
    sums[1] = band1[i];
    sums[2] = band1[count + i];
    sums[3] = band1[2u * count + i];
    if (order < 2u)
        return;
    sums[4] = band2[i];
    sums[5] = band2[count + i];
    sums[6] = band2[2u * count + i];
    sums[7] = band2[3u * count + i];
    sums[8] = band2[4u * count + i];
}

void store_sums(uint i, uint count, uint order)
{
    band0[i] = sums[0];
    band1[i] = sums[1];
    band1[count + i] = sums[2];
    band1[2u * count + i] = sums[3];
    if (order < 2u)
        return;
    band2[i] = sums[4];
    band2[count + i] = sums[5];
    band2[2u * count + i] = sums[6];
    band2[3u * count + i] = sums[7];
    band2[4u * count + i] = sums[8];
}

void scale_sums(float by)
{
    sums[0] *= by;
    sums[1] *= by;
    sums[2] *= by;
    sums[3] *= by;
    sums[4] *= by;
    sums[5] *= by;
    sums[6] *= by;
    sums[7] *= by;
    sums[8] *= by;
}

#endif
