#version 460
#include "results/directional/directional.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "results/directional/directional.glsl"

// The mean of all shots, plus the light of near pairs: F_ij X_j / cosθ_i is the radiance times the
// solid angle of lumel j. Its direction is sampled between points of both lumels, each with its
// weight in F_ij,
//
//     w = cosθ_i cosθ_j / (r² + s_j² / 4π),   s_j the size of j,
//
// or is that between their centres if the lumels are farther apart.
//
// Few points, as Mesa's software Vulkan ends all loops of an invocation after 65,535 rounds in
// total.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { DirectionalNearParams p; };
layout(scalar) readonly buffer First { uint first[]; };
layout(scalar) readonly buffer Column { uint column[]; };
layout(scalar) readonly buffer Factor { float factor[]; };
layout(scalar) readonly buffer Source { vec3 source[]; };

// Pairs closer than this, in sizes of the larger lumel, are sampled by kPoints points.
const float kClose = 4.0;
const uint kPoints = 8u;
// Minimum height of a sender above the receiver's horizon, relative to its size: the horizon can
// cut lower ones, and F_ij can include parts that the points miss.
const float kMinHeight = 0.25;

// Point k of additive recurrences in four dimensions; the steps are 1/g, 1/g², … for g⁵ = g + 1.
vec4 recurrence(uint k)
{
    return fract(0.5 + float(k) * vec4(0.8566749, 0.7338919, 0.6287067, 0.5385973));
}

struct Way {
    vec3 from;     // unit, toward the sender
    float cosine;  // at the receiver's normal
    float weight;
};

Way way_between(Lumel receiver, Lumel sender, uint k)
{
    const vec4 u = recurrence(k);
    const LumelPoint x = point_on(receiver, u.x, u.y), y = point_on(sender, u.z, u.w);
    const vec3 d = y.position - x.position;
    const float r2 = max(dot(d, d), 1e-30);
    const vec3 from = d * inversesqrt(r2);
    const float cosine = dot(from, x.normal);
    const float weight = max(cosine, 0.0) * max(-dot(from, y.normal), 0.0) /
                         (r2 + sender.size * sender.size * (0.25 / kPi));
    return Way(from, cosine, weight);
}

// `light`: irradiance of the pair. Returns false if no points see each other.
bool add_between_points(Lumel receiver, Lumel sender, vec3 light)
{
    float sum = 0.0, solid = 0.0;
    float shape[9] = float[9](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint k = 0u; k < kPoints; ++k) {
        const Way way = way_between(receiver, sender, k);
        if (way.weight <= 0.0)
            continue;
        const float angle = way.weight / way.cosine;
        sum += way.weight;
        solid += angle;
        float c[9];
        coefficients_of(way.from, receiver.normal, p.order, c);
        shape[0] += angle * c[0];
        shape[1] += angle * c[1];
        shape[2] += angle * c[2];
        shape[3] += angle * c[3];
        if (p.order < 2u)
            continue;
        shape[4] += angle * c[4];
        shape[5] += angle * c[5];
        shape[6] += angle * c[6];
        shape[7] += angle * c[7];
        shape[8] += angle * c[8];
    }
    if (sum <= 0.0)
        return false;
    const float least = kMinHeight * sender.size / distance(sender.position, receiver.position);
    add_light(shape, light * min(1.0 / sum, 1.0 / (solid * least)), p.order);
    return true;
}

void add_between_centres(Lumel receiver, Lumel sender, vec3 light)
{
    const vec3 d = sender.position - receiver.position;
    const float height = dot(d, receiver.normal);
    const float raised = max(height, kMinHeight * sender.size);
    const vec3 from = normalize(d + (raised - height) * receiver.normal);
    float c[9];
    coefficients_of(from, receiver.normal, p.order, c);
    add_light(c, light / dot(from, receiver.normal), p.order);
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    load_sums(i, p.count, p.order);
    scale_sums(1.0 / p.shots);
    for (uint k = first[i]; k < first[i + 1u]; ++k) {
        const Lumel sender = lumels[column[k]];
        const vec3 light = factor[k] * source[column[k]];
        const vec3 between = sender.position - lumel.position;
        const float close = kClose * max(lumel.size, sender.size);
        if (dot(between, between) > close * close || !add_between_points(lumel, sender, light))
            add_between_centres(lumel, sender, light);
    }
    store_sums(i, p.count, p.order);
}
