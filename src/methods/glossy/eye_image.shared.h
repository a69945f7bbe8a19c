#ifndef LUMEL_METHODS_GLOSSY_EYE_IMAGE_SHARED_H
#define LUMEL_METHODS_GLOSSY_EYE_IMAGE_SHARED_H
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

/// A point seen by an eye, on a glossy surface.
struct EyePoint {
    vec3 position;    ///< [m], world
    vec3 normal;      ///< shading normal, unit, on the eye's side
    vec3 facing;      ///< normal of the triangle, unit, on the eye's side
    vec3 toward_eye;  ///< unit
    vec3 specular;    ///< ρ_s
    float shininess;  ///< n
};

/// Push constants of eye_image.receive.comp.
struct EyeParams {
    EyeViewLayout views;
    DispatchRange range;  ///< points of this dispatch
    uint shots;           ///< K
    float shooters;       ///< shooters that a point receives from in total
    float rays;           ///< rays along its lobe; 0: shooters alone
};

LUMEL_SHARED_END
#endif
