#ifndef LUMEL_VISIBILITY_HEMICUBE_GLSL
#define LUMEL_VISIBILITY_HEMICUBE_GLSL

// The five faces of a hemicube [CG85].

#include "raster/eyes/eye_views.shared.h"

// Frame of a face: `axis` points to its centre, `right` and `up` span it. On side faces `up` is the
// normal, and only the half above the horizon exists.
struct Face {
    vec3 right;
    vec3 up;
    vec3 axis;
};

Face hemicube_face(Eye eye, uint face)
{
    switch (face) {
    case 0u: return Face(eye.tangent, eye.bitangent, eye.normal);
    case 1u: return Face(eye.bitangent, eye.normal, eye.tangent);
    case 2u: return Face(eye.bitangent, eye.normal, -eye.tangent);
    case 3u: return Face(eye.tangent, eye.normal, eye.bitangent);
    default: return Face(eye.tangent, eye.normal, -eye.bitangent);
    }
}

// True if the face's image is mirrored, so that fronts are clockwise.
bool is_mirrored(uint face)
{
    return face == 2u || face == 3u;
}

// Direction, of any length, to a pixel's centre in the eye's frame (t, b, n). `pixel`: in the
// hemicube's tile, see EyeViewLayout.
vec3 ray_to(uint side, uvec2 pixel)
{
    const bool right = pixel.x >= side, below = pixel.y >= side;
    const uint rows = below ? pixel.y - side : pixel.y;
    const bool second = below ? right : 2u * rows >= side;  // second face of the axis
    const float s = (float(right ? pixel.x - side : pixel.x) + 0.5) * (2.0 / float(side)) - 1.0;
    const float up = (float(rows) + 0.5) * (2.0 / float(side));
    if (!right && !below)
        return vec3(s, up - 1.0, 1.0);
    const float axis = second ? -1.0 : 1.0;
    return below ? vec3(s, axis, up) : vec3(axis, s, second ? up - 1.0 : up);
}

// Clip space of a face: 90° frustum, reversed z, infinite far plane. A side face has only 0 ≤ up /
// w ≤ 1.
vec4 through_face(Eye eye, uint index, float near, vec3 position)
{
    const Face face = hemicube_face(eye, index);
    const vec3 d = position - eye.position;
    const float w = dot(d, face.axis);
    const float up = dot(d, face.up);
    return vec4(dot(d, face.right), index == 0u ? up : 2.0 * up - w, near, w);
}

#endif
