#version 460
#include "solve/stochastic.shared.h"
#include "atlas/lumel.shared.h"
#include "core/hash.glsl"
#include "solve/radiosity.glsl"
#include "solve/power_pyramid.glsl"

// Draws the shooters of one batch: p(y) ∝ power ([BSS05] section 4.1, [BJ04] section 3.1), the
// point y uniform on lumel j, the hemicube turned at random about the normal.

layout(local_size_x = kSelectGroup) in;
layout(push_constant, scalar) uniform Params { SelectParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Emission { vec3 emission[]; };
layout(binding = 3, scalar) readonly buffer Source { vec3 source[]; };
layout(binding = 4, scalar) readonly buffer EmissionPower { float emission_power[]; };
layout(binding = 5, scalar) readonly buffer SourcePower { float source_power[]; };
layout(binding = 6, scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(binding = 7, scalar) writeonly buffer Shots { Shot shots[]; };

#include "world/lumel.glsl"
#include "solve/shooter.glsl"

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.count)
        return;
    const bool emits = k < p.emission_count;
    const uint index = emits ? p.emission_index + k : p.source_index + k - p.emission_count;
    const vec3 u = draw_point(index, emits ? 0u : 1u, p.seed, p.random != 0u);

    const PyramidLayout layout_ = p.layout_;
    Drawn drawn;
    if (emits)
        DRAW_FROM(emission_power, u.x)
    else
        DRAW_FROM(source_power, u.x)

    const uint j = drawn.lumel;
    const Lumel lumel = lumels[j];
    const float area = lumel.area;
    LumelPoint y = point_on(lumel, u.y, u.z);
    if (p.centre != 0u) {
        y.position = lumel.position;
        y.normal = lumel.normal;
    }
    eyes[k] = make_eye(y.position, y.normal, hash(hash(index ^ hash(p.seed)) + (emits ? 1u : 2u)));

    const vec3 radiosity = emits ? emission[j] : source[j];
    const float scale = drawn.probability > 0.0 ? area / (kPi * drawn.probability) : 0.0;
    shots[k] = Shot(radiosity * scale, lumel.position, lumel.size,
                    p.disc != 0u ? area / kPi : 0.0, j);
}
