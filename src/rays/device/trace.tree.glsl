// Closest and any hits in a tree of boxes, by one thread a ray.
//
//   [WBW13] S. Woop, C. Benthin, I. Wald. Watertight Ray/Triangle Intersection. JCGT 2(1), 2013.
//   [Ize13] T. Ize. Robust BVH Ray Traversal. JCGT 2(2), 2013.

layout(std430) readonly buffer Nodes { vec4 nodes[]; };          // TreeNode
layout(std430) readonly buffer Triangles { vec4 triangles[]; };  // TreeTriangle

const uint kVectorsOfNode = 4u;
const uint kVectorsOfTriangle = 3u;
const float kMissed = 3.4e38;
/// Rounding of both ends of a box [Ize13, 3]: 2 γ(3), and twice the 2.5 ulp of Vulkan's division.
const float kRobust = 1.0 + 16.0 * 6e-8;

/// A ray as both tests need it.
struct Prepared {
    vec3 origin, inverse;
    vec3 shear;  ///< Sx, Sy, Sz [WBW13, 3.2]
    uint axis;   ///< kz: in which the direction is longest
};

/// Moves the longest axis to z; keeps the handedness.
vec3 turned(vec3 v, uint axis)
{
    return axis == 0u ? v.yzx : axis == 1u ? v.zxy : v;
}

Prepared prepared(CastRay ray)
{
    const vec3 size = abs(ray.direction);
    const uint axis = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
    const vec3 d = turned(ray.direction, axis);
    const float tiny = 1e-30;  // in place of 0, whose inverse would be infinite
    const vec3 nonzero = mix(ray.direction, vec3(tiny), lessThan(size, vec3(tiny)));
    return Prepared(ray.origin, 1.0 / nonzero, vec3(d.xy, 1.0) / d.z, axis);
}

/// Distance at which a ray enters a box [m]; kMissed if it does not before `far`.
float entry(Prepared ray, float near, float far, vec3 low, vec3 high)
{
    const vec3 to_low = (low - ray.origin) * ray.inverse;
    const vec3 to_high = (high - ray.origin) * ray.inverse;
    const vec3 first = min(to_low, to_high), last = max(to_low, to_high);
    const float enters = max(max(first.x, first.y), max(first.z, near));
    const float leaves = kRobust * min(min(last.x, last.y), min(last.z, far));
    return enters <= leaves ? enters : kMissed;
}

/// True if the ray meets a triangle from `near` to `far`.
bool meets(Prepared ray, float near, float far, uint at, out CastHit hit)
{
    const vec4 first = triangles[kVectorsOfTriangle * at];
    const vec3 a = turned(first.xyz - ray.origin, ray.axis);
    const vec3 b = turned(triangles[kVectorsOfTriangle * at + 1u].xyz - ray.origin, ray.axis);
    const vec3 c = turned(triangles[kVectorsOfTriangle * at + 2u].xyz - ray.origin, ray.axis);
    // Neighbours get the same numbers of opposite signs at their edge, so no ray passes between.
    precise const vec2 pa = a.xy - ray.shear.xy * a.z;
    precise const vec2 pb = b.xy - ray.shear.xy * b.z;
    precise const vec2 pc = c.xy - ray.shear.xy * c.z;
    precise const float u = pc.x * pb.y - pc.y * pb.x;
    precise const float v = pa.x * pc.y - pa.y * pc.x;
    precise const float w = pb.x * pa.y - pb.y * pa.x;
    if (min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0)
        return false;
    const float sum = u + v + w;
    if (sum == 0.0)
        return false;
    hit = CastHit(floatBitsToUint(first.w), ray.shear.z * (u * a.z + v * b.z + w * c.z) / sum,
                  vec2(v, w) / sum);
    return hit.distance >= near && hit.distance <= far;
}

CastHit trace(CastRay given, uint wanted, uint solid)
{
    const Prepared ray = prepared(given);
    CastHit best = CastHit(kNoTriangle, given.far, vec2(0.0));
    uint waiting[kTreeDepth];
    uint count = 0u, node = 0u;
    while (true) {
        const vec4 low[2] = {nodes[kVectorsOfNode * node], nodes[kVectorsOfNode * node + 2u]};
        const vec4 high[2] = {nodes[kVectorsOfNode * node + 1u],
                              nodes[kVectorsOfNode * node + 3u]};
        float enters[2];
        for (uint k = 0u; k < 2u; ++k) {
            enters[k] = entry(ray, given.near, best.distance, low[k].xyz, high[k].xyz);
            const uint size = floatBitsToUint(high[k].w);
            if (size == 0u || enters[k] == kMissed)
                continue;
            const uint first = floatBitsToUint(low[k].w);
            for (uint t = first; t < first + size; ++t) {
                CastHit hit;
                if (!meets(ray, given.near, best.distance, t, hit))
                    continue;
                if (wanted == kOccluder) {
                    if (hit.triangle < solid)
                        return hit;
                    best.triangle = hit.triangle;
                } else if (hit.distance < best.distance || hit.triangle < best.triangle)
                    best = hit;  // of equal distances the lower number
            }
            enters[k] = kMissed;
        }
        const bool left = enters[0] != kMissed, right = enters[1] != kMissed;
        if (left && right) {
            const bool first = enters[0] <= enters[1];
            waiting[count++] = floatBitsToUint(first ? low[1].w : low[0].w);
            node = floatBitsToUint(first ? low[0].w : low[1].w);
        } else if (left || right) {
            node = floatBitsToUint(left ? low[0].w : low[1].w);
        } else {
            if (count == 0u)
                return best;
            node = waiting[--count];
        }
    }
}
