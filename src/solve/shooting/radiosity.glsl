#ifndef LUMEL_SHOOTING_RADIOSITY_GLSL
#define LUMEL_SHOOTING_RADIOSITY_GLSL

// Constants and functions shared by the shaders of all solvers.

const float kPi = 3.14159265358979;

// Luminance of linear Rec. 709 (CIE Y).
float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// cosθ_i cosθ_j / (r² + disc) for unit normals; `d` leads from j to i. 0 if either faces away.
// `disc` [m²]: A_j / π of a disc-shaped shooter, 0 for a point.
float point_factor(vec3 d, vec3 normal_j, vec3 normal_i, float disc)
{
    const float r2 = dot(d, d);
    const float cosines = max(dot(d, normal_j), 0.0) * max(-dot(d, normal_i), 0.0);
    return cosines > 0.0 ? cosines / (r2 * (r2 + disc)) : 0.0;
}

#endif
