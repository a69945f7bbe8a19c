#include "rays/cast/ray_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "rays/cast/embree_trees.h"

namespace lumel {

namespace {

/// Ray offset relative to the reach of its surface: far above the rounding error of a hit's
/// position (about 1e-7), far below visible distances.
constexpr float kLift = 1e-5f;

/// Coloured glass on a ray.
struct PassedGlass {
    std::uint32_t ray = 0;  ///< of its packet
    std::uint32_t part = 0, triangle = 0;
    float distance = 0.0f;
    glm::vec3 tint{1.0f};
};

/// Embree's query context with the data that cut-outs need.
struct QueryContext {
    EmbreeContext embree;             // first, so that Embree's pointer is also ours
    const std::uint32_t* seeds;       ///< [rays] by Embree's ID of a ray
    std::vector<PassedGlass> passed;  ///< in any order, possibly beyond the hit

    /// Embree may test a triangle more than once.
    void pass(const PassedGlass& glass)
    {
        const auto same = [&](const PassedGlass& other) {
            return other.ray == glass.ray && other.part == glass.part &&
                   other.triangle == glass.triangle;
        };
        if (std::none_of(passed.begin(), passed.end(), same))
            passed.push_back(glass);
    }

    /// After the query. The order of hits depends on the BVHs.
    void sort_by_part()
    {
        std::sort(passed.begin(), passed.end(), [](const PassedGlass& a, const PassedGlass& b) {
            return std::pair(a.part, a.triangle) < std::pair(b.part, b.triangle);
        });
    }

    /// Multiplies in the order of the parts.
    glm::vec3 tint_before(float distance, std::uint32_t ray = 0) const
    {
        glm::vec3 tint(1.0f);
        for (const PassedGlass& glass : passed)
            if (glass.ray == ray && glass.distance < distance)
                tint *= glass.tint;
        return tint;
    }
};

/// Hash of three integers, in [0, 1).
float hash_to_unit(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    std::uint32_t state = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu ^ c * 0xc2b2ae35u;
    state = (state ^ (state >> 16)) * 0x7feb352du;
    state = (state ^ (state >> 15)) * 0x846ca68bu;
    state ^= state >> 16;
    return float(state >> 8) * 0x1p-24f;
}

/// Material of a surface at a point of one of its triangles.
MaterialSample look_at(const TracedPart& part, std::uint32_t triangle, float u, float v)
{
    const Primitive& source = *part.source;
    const std::uint32_t* corner = source.indices.data() + std::size_t(triangle) * 3;
    const auto blend = [&](const auto& values) {
        return values[corner[0]] * (1.0f - u - v) + values[corner[1]] * u + values[corner[2]] * v;
    };
    glm::vec2 texcoord[kTexcoordSets]{};
    for (int set = 0; set < kTexcoordSets; ++set)
        if (!source.texcoords[set].empty())
            texcoord[set] = blend(source.texcoords[set]);
    const glm::vec4 color = source.colors.empty() ? glm::vec4(1.0f) : blend(source.colors);
    return sample_material(*part.scene, source.material, texcoord, color);
}

/// Tint of light that passes a triangle; nullopt if a ray of this seed hits it.
std::optional<glm::vec3> tint_through(const TracedPart& part, std::uint32_t triangle,
                                      const glm::vec2& barycentric, std::uint32_t seed)
{
    const MaterialSample look = look_at(part, triangle, barycentric.x, barycentric.y);
    if (look.opacity >= 1.0f || hash_to_unit(seed, part.number, triangle) < look.opacity)
        return std::nullopt;
    return look.tint;
}

/// Embree's filter: rejects candidate hits that the ray passes.
void pass_through_cut_outs(const RTCFilterFunctionNArguments* candidate)
{
    const TracedPart& part = *static_cast<const TracedPart*>(candidate->geometryUserPtr);
    auto& context = *reinterpret_cast<QueryContext*>(candidate->context);
    const unsigned int count = candidate->N;
    for (unsigned int n = 0; n < count; ++n) {
        if (candidate->valid[n] != -1)
            continue;
        const std::uint32_t triangle = RTCHitN_primID(candidate->hit, count, n);
        const std::uint32_t ray = RTCRayN_id(candidate->ray, count, n);
        const std::optional<glm::vec3> tint =
            tint_through(part, triangle,
                         {RTCHitN_u(candidate->hit, count, n), RTCHitN_v(candidate->hit, count, n)},
                         context.seeds[ray]);
        if (!tint)
            continue;
        candidate->valid[n] = 0;
        if (*tint != glm::vec3(1.0f))
            context.pass(
                {ray, part.number, triangle, RTCRayN_tfar(candidate->ray, count, n), *tint});
    }
}

/// seeds: must outlive the context.
QueryContext query_context(const std::uint32_t* seeds)
{
    QueryContext context{};
    start_query(context.embree);
    context.seeds = seeds;
    return context;
}

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float near, float far)
{
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = near;
    ray.tfar = far;
    ray.mask = ~0u;
    return ray;
}

std::vector<std::uint32_t> all_instances(const Scene& scene)
{
    std::vector<std::uint32_t> all(scene.instances.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

/// Transmittance along the ray.
glm::vec3 tint_along(RTCScene tree, RTCRay&& ray, std::uint32_t seed)
{
    QueryContext context = query_context(&seed);
    find_occluder(tree, context.embree, ray);
    context.sort_by_part();
    const bool clear = ray.tfar >= 0.0f;  // Embree marks an occluded ray by -infinity
    return clear ? context.tint_before(std::numeric_limits<float>::infinity()) : glm::vec3(0.0f);
}

/// Corners, world [m].
using Triangle = std::array<glm::vec3, 3>;

/// True if a triangle has a point within a distance of `point`.
bool is_within(Triangle corner, const glm::vec3& point, float distance)
{
    // From the nearest corner: the plane of a long sliver is known least from afar.
    const auto nearest = std::ranges::min_element(
        corner, {}, [&](const glm::vec3& at) { return glm::distance(at, point); });
    std::rotate(corner.begin(), nearest, corner.end());
    const glm::vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], at = point - corner[0],
                    across = glm::cross(u, v);
    const float square = glm::dot(across, across), off = glm::dot(at, across);
    if (off * off > distance * distance * square)
        return false;
    const float s = glm::dot(glm::cross(at, v), across), t = glm::dot(glm::cross(u, at), across);
    if (square > 0.0f && s >= 0.0f && t >= 0.0f && s + t <= square)
        return true;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 edge = corner[(k + 1) % 3] - corner[k], from = point - corner[k];
        const float along =
            std::clamp(glm::dot(from, edge) / std::max(glm::dot(edge, edge), 1e-30f), 0.0f, 1.0f);
        if (glm::distance(from, along * edge) <= distance)
            return true;
    }
    return false;
}

/// Sets what follows from Embree's hit; the tint remains.
void set_hit(const TracedPart& part, const RTCHit& found, float distance, const glm::vec3& origin,
             const glm::vec3& direction, RayHit& hit)
{
    hit.instance = part.instance;
    hit.primitive = part.primitive;
    hit.triangle = found.primID;
    hit.barycentric = {found.u, found.v};
    hit.distance = distance;
    hit.normal = part.winding * glm::normalize(glm::vec3(found.Ng_x, found.Ng_y, found.Ng_z));
    hit.front = glm::dot(hit.normal, direction) < 0.0f;
    hit.ray_offset = ray_offset_for(std::max({largest_coordinate(origin + distance * direction),
                                              distance, part.longest_edge[hit.triangle]}));
}

/// Up to kEmbreePacket rays as Embree takes them.
struct Packet {
    alignas(64) std::array<int, kEmbreePacket> valid{};
    std::array<std::uint32_t, kEmbreePacket> seeds{};

    /// Fills Embree's rays. Those without a ray, and empty ones, end before they begin: without
    /// AVX-512 Embree 3 ignores `valid`.
    Packet(std::span<const RaySpan> from, RTCRay16& rays)
    {
        constexpr RaySpan none{.direction = {0.0f, 0.0f, 1.0f}};
        for (std::size_t n = 0; n < kEmbreePacket; ++n) {
            const bool is_cast = n < from.size() && from[n].far > from[n].near;
            const RaySpan& ray = is_cast ? from[n] : none;
            valid[n] = is_cast ? -1 : 0;
            seeds[n] = ray.seed;
            rays.org_x[n] = ray.origin.x;
            rays.org_y[n] = ray.origin.y;
            rays.org_z[n] = ray.origin.z;
            rays.dir_x[n] = ray.direction.x;
            rays.dir_y[n] = ray.direction.y;
            rays.dir_z[n] = ray.direction.z;
            rays.tnear[n] = ray.near;
            rays.tfar[n] = is_cast ? ray.far : -std::numeric_limits<float>::infinity();
            rays.time[n] = 0.0f;
            rays.mask[n] = ~0u;
            rays.id[n] = std::uint32_t(n);
            rays.flags[n] = 0;
        }
    }
};

/// Casts up to kEmbreePacket rays.
void transmittance_of_packet(const EmbreeTrees& trees, std::span<const RaySpan> rays,
                             std::span<glm::vec3> transmittance)
{
    RTCRay16 query;
    const Packet packet(rays, query);
    QueryContext context = query_context(packet.seeds.data());
    find_occluder(trees.top(), context.embree, packet.valid.data(), query);
    context.sort_by_part();
    for (std::size_t n = 0; n < rays.size(); ++n) {
        const bool clear = packet.valid[n] == 0 || query.tfar[n] >= 0.0f;
        transmittance[n] =
            clear ? context.tint_before(std::numeric_limits<float>::infinity(), std::uint32_t(n))
                  : glm::vec3(0.0f);
    }
}

/// Casts up to kEmbreePacket rays.
void closest_of_packet(const EmbreeTrees& trees, std::span<const RaySpan> rays,
                       std::span<RayHit> hits)
{
    RTCRayHit16 query;
    const Packet packet(rays, query.ray);
    for (std::size_t n = 0; n < kEmbreePacket; ++n)
        query.hit.geomID[n] = query.hit.instID[0][n] = RTC_INVALID_GEOMETRY_ID;
    QueryContext context = query_context(packet.seeds.data());
    find_closest(trees.top(), context.embree, packet.valid.data(), query);
    context.sort_by_part();
    for (std::size_t n = 0; n < rays.size(); ++n) {
        hits[n].tint = context.tint_before(query.ray.tfar[n], std::uint32_t(n));
        if (query.hit.geomID[n] == RTC_INVALID_GEOMETRY_ID) {
            hits[n].distance = std::numeric_limits<float>::infinity();
            continue;
        }
        const RTCHit found =
            rtcGetHitFromHitN(reinterpret_cast<RTCHitN*>(&query.hit), kEmbreePacket, unsigned(n));
        set_hit(trees.part(found), found, query.ray.tfar[n], rays[n].origin, rays[n].direction,
                hits[n]);
    }
}

}  // namespace

RayScene::RayScene(const Scene& scene) : RayScene(scene, all_instances(scene), {}) {}

RayScene::RayScene(const Scene& scene, std::span<const std::uint32_t> instances)
    : RayScene(scene, instances, {})
{
}

RayScene::RayScene(const Scene& scene, const std::vector<char>& movers)
    : RayScene(scene, all_instances(scene), movers)
{
}

RayScene::RayScene(const Scene& scene, std::span<const std::uint32_t> instances,
                   const std::vector<char>& movers)
    : trees_(std::make_unique<EmbreeTrees>(scene, instances, movers, pass_through_cut_outs))
{
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::place(std::span<const std::uint32_t> instances)
{
    trees_->place(instances);
}

RaySpan ray_between(const glm::vec3& from, const glm::vec3& to, float offset, std::uint32_t seed)
{
    const glm::vec3 path = to - from;
    const float distance = glm::length(path);
    if (distance <= 2.0f * offset)
        return {.origin = from, .seed = seed};
    return {from, offset, path / distance, distance - offset, seed};
}

float ray_offset_for(float reach)
{
    return kLift * reach;
}

float largest_coordinate(const glm::vec3& position)
{
    const glm::vec3 size = glm::abs(position);
    return std::max({size.x, size.y, size.z});
}

float longest_edge(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    return std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
}

RaySpan ray_out(const glm::vec3& from, const glm::vec3& direction, std::uint32_t seed)
{
    return {from, 0.0f, direction, std::numeric_limits<float>::max(), seed};
}

glm::vec3 RayScene::transmittance(const RaySpan& ray) const
{
    if (!(ray.far > ray.near))
        return glm::vec3(1.0f);
    return tint_along(trees_->top(), make_ray(ray.origin, ray.direction, ray.near, ray.far),
                      ray.seed);
}

void RayScene::transmittance(std::span<const RaySpan> rays,
                             std::span<glm::vec3> transmittance) const
{
    for (std::size_t first = 0; first < rays.size(); first += kEmbreePacket) {
        const std::size_t count = std::min(rays.size() - first, kEmbreePacket);
        transmittance_of_packet(*trees_, rays.subspan(first, count),
                                transmittance.subspan(first, count));
    }
}

glm::vec3 RayScene::transmittance(const glm::vec3& from, const glm::vec3& to, float offset,
                                  std::uint32_t seed) const
{
    return transmittance(ray_between(from, to, offset, seed));
}

glm::vec3 RayScene::transmittance_out(const glm::vec3& from, const glm::vec3& direction,
                                      std::uint32_t seed) const
{
    return transmittance(ray_out(from, direction, seed));
}

bool RayScene::sees(const glm::vec3& from, const glm::vec3& to, float offset,
                    std::uint32_t seed) const
{
    return transmittance(from, to, offset, seed) != glm::vec3(0.0f);
}

bool RayScene::sees_out(const glm::vec3& from, const glm::vec3& direction, std::uint32_t seed) const
{
    return transmittance_out(from, direction, seed) != glm::vec3(0.0f);
}

bool RayScene::closest(const glm::vec3& origin, const glm::vec3& direction, float near, float far,
                       std::uint32_t seed, RayHit& hit) const
{
    // Constructed in place: a copy would stall on the preceding stores.
    RTCRayHit query{.ray = make_ray(origin, direction, near, far), .hit = {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    QueryContext context = query_context(&seed);
    find_closest(trees_->top(), context.embree, query);
    context.sort_by_part();
    hit.tint = context.tint_before(query.ray.tfar);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    set_hit(trees_->part(query.hit), query.hit, query.ray.tfar, origin, direction, hit);
    return true;
}

void RayScene::closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const
{
    for (std::size_t first = 0; first < rays.size(); first += kEmbreePacket) {
        const std::size_t count = std::min(rays.size() - first, kEmbreePacket);
        if (count > 1)
            closest_of_packet(*trees_, rays.subspan(first, count), hits.subspan(first, count));
        else if (!closest(rays[first], hits[first]))  // a packet of one is slower
            hits[first].distance = std::numeric_limits<float>::infinity();
    }
}

bool RayScene::is_clear_above(const glm::vec3& point, const glm::vec3& normal, float radius,
                              float height) const
{
    return !trees_->any_triangle(
        point, radius, [&](const TracedPart& part, std::uint32_t triangle) {
            const Triangle corner = part.triangle(triangle);
            const auto rises = [&](const glm::vec3& at) {
                return glm::dot(normal, at - point) > height;
            };
            return std::ranges::any_of(corner, rises) && is_within(corner, point, radius);
        });
}

bool RayScene::any_at(const glm::vec3& point, float radius, const glm::vec3& direction,
                      const std::function<bool(const RayHit& hit)>& is_one) const
{
    return trees_->any_triangle(point, radius, [&](const TracedPart& part, std::uint32_t triangle) {
        const Triangle corner = part.triangle(triangle);
        const glm::vec3 across =
            part.winding * glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        return is_one({.instance = part.instance,
                       .primitive = part.primitive,
                       .triangle = triangle,
                       .front = glm::dot(across, direction) < 0.0f}) &&
               is_within(corner, point, radius);
    });
}

float RayScene::ray_offset(const glm::vec3& position, const glm::vec3& normal) const
{
    // The surface that the point lies on, if any: no further than the offset of the largest one.
    const float most = ray_offset();
    RayHit hit;
    if (closest(position + most * normal, -normal, 0.0f, 2.0f * most, 0, hit))
        return std::max(hit.ray_offset, ray_offset_for(largest_coordinate(position)));
    return ray_offset_for(largest_coordinate(position));
}

std::size_t RayScene::parts() const
{
    return trees_->parts().size();
}

std::vector<glm::vec3> RayScene::positions(std::size_t part) const
{
    const TracedPart& from = trees_->parts()[part];
    std::vector<glm::vec3> positions;
    positions.reserve(from.source->positions.size());
    for (const glm::vec3& position : from.source->positions)
        positions.push_back(from.to_world(position));
    return positions;
}

std::span<const std::uint32_t> RayScene::corners(std::size_t part) const
{
    return trees_->parts()[part].source->indices;
}

bool RayScene::may_let_pass(std::size_t part) const
{
    const TracedPart& from = trees_->parts()[part];
    return may_be_transparent(from.scene->materials[from.source->material], *from.source);
}

RayHit RayScene::hit(std::size_t number, std::uint32_t triangle, const glm::vec2& barycentric,
                     float distance, const glm::vec3& direction) const
{
    const TracedPart& part = trees_->parts()[number];
    const Triangle corner = part.triangle(triangle);
    const glm::vec3 normal =
        part.winding * glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    return {.instance = part.instance,
            .primitive = part.primitive,
            .triangle = triangle,
            .barycentric = barycentric,
            .distance = distance,
            .normal = normal,
            .front = glm::dot(normal, direction) < 0.0f,
            .ray_offset = ray_offset_for(
                std::max({largest_coordinate(corner[0]), largest_coordinate(corner[1]),
                          largest_coordinate(corner[2]), distance, part.longest_edge[triangle]}))};
}

std::uint64_t RayScene::bytes() const
{
    return trees_->bytes();
}

glm::vec3 RayScene::low() const
{
    return trees_->low();
}

glm::vec3 RayScene::high() const
{
    return trees_->high();
}

float RayScene::ray_offset() const
{
    const glm::vec3 reach = glm::max(glm::abs(low()), glm::abs(high()));
    return kLift * std::max({reach.x, reach.y, reach.z, glm::length(high() - low())});
}

std::string embree_version()
{
    return RTC_VERSION_STRING;
}

}  // namespace lumel
