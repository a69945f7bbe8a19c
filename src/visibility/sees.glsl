// Does an eye see a point? Needs hemicube.shared.h and `sampler2D hemicubes` declared.

// Relative slack of the depth comparison: stored depths are interpolated in float, and a
// receiver's pieces approximate the drawn surface.
const float kDepthSlack = 2e-4;
// A curved receiver's neighbouring facets fall behind its plane by this much at most, relative.
const float kPlaneSlack = 2e-3;
// Planes that come nearer by more than this many pixel widths per pixel are seen edge-on: such a
// plane meets many others, and being on it says nothing.
const float kMostSlope = 8.0;

// V between the eye of tile `tile` and the point at eye + (t, b, n)·local on a surface whose
// normal is `facing` (any length) in the eye's frame.
//
// The pixel that holds the point stores near / z of the nearest surface along the pixel's
// centre. The receiver's plane is met by that same centre ray at
//
//     z_plane = (facing · local) / (facing · q),      q = ray with axis component 1,
//
// and if that is what is stored, the pixel shows the receiver's own surface: it is seen, whatever
// its slope. Otherwise the point's own z decides, as in any shadow map. Only equality counts for
// the plane: it may well run in front of an occluder that hides the point itself.
bool sees(HemicubeLayout layout_, uint tile, vec3 local, vec3 facing)
{
    const vec3 size = abs(local);
    const float side = float(layout_.side);
    const bool front = local.z >= max(size.x, size.y);
    const bool along_t = size.x >= size.y;

    // Coordinates in the face: a to the right, c up, z along the axis.
    const float z = front ? local.z : (along_t ? size.x : size.y);
    const float a = front ? local.x : (along_t ? local.y : local.x);
    const float c = front ? local.y : local.z;
    const bool negative = (along_t ? local.x : local.y) < 0.0;

    const float per_z = 1.0 / z;
    const float half_side = 0.5 * side;
    const float row_scale = half_side;
    float column = clamp(floor((a * per_z + 1.0) * half_side), 0.0, side - 1.0);
    float row = front ? clamp(floor((c * per_z + 1.0) * row_scale), 0.0, side - 1.0)
                      : clamp(floor(c * per_z * row_scale), 0.0, half_side - 1.0);
    // Through the pixel's centre.
    const float qa = (column + 0.5) / half_side - 1.0;
    const float qc = front ? (row + 0.5) / half_side - 1.0 : (row + 0.5) / half_side;

    const vec2 corner = front ? vec2(0.0) : (along_t ? vec2(side, 0.0) : vec2(0.0, side)) ;
    const vec2 second = front || !negative ? vec2(0.0)
                                           : (along_t ? vec2(0.0, half_side) : vec2(side, 0.0));
    const uvec2 origin = uvec2(tile % layout_.columns * 2u * layout_.side,
                               tile / layout_.columns * (3u * layout_.side / 2u));
    const ivec2 pixel = ivec2(origin) + ivec2(corner + second + vec2(column, row));
    const float stored = texelFetch(hemicubes, pixel, 0).r;

    const float axis_sign = !front && negative ? -1.0 : 1.0;
    const vec3 q = front ? vec3(qa, qc, 1.0)
                         : (along_t ? vec3(axis_sign, qa, qc) : vec3(qa, axis_sign, qc));
    const float slack = layout_.near * (1.0 + kDepthSlack);
    const bool by_point = stored * z <= slack;
    const float toward_pixel = -dot(facing, q), toward_point = -dot(facing, local);
    const float plane = toward_pixel * layout_.near;
    const float found = toward_point * stored;
    const bool steep = toward_point < (1.0 - kMostSlope / side) * z * toward_pixel;
    const bool own_surface = found <= plane * (1.0 + kDepthSlack) &&
                             found >= plane * (1.0 - kPlaneSlack) && !steep;
    return by_point || own_surface;
}
