// The GPU only has triangles. The CPU decides about surfaces that may transmit light, by the rule
// and the random numbers of RayScene, so that both casters agree. A transmitted ray continues just
// behind its hit.

#include "rays/device/query_caster.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "gpu/commands.h"
#include "gpu/triangle_tree.h"
#include "rays/cast/device_triangles.h"
#include "rays/cast/ray_caster.h"
#include "rays/device/query_caster.cast.comp.h"

namespace lumel {
namespace {

/// Enough work to hide the start-up cost of a dispatch.
constexpr std::size_t kQueryBatch = std::size_t(1) << 15;
/// Maximum rays per dispatch.
constexpr std::size_t kMaxQueries = 4 * kQueryBatch;
constexpr float kFar = std::numeric_limits<float>::max();

gpu::TriangleTree make_tree(const gpu::Device& device, const RayScene& rays,
                            const DeviceTriangles& triangles)
{
    if (!device.can_query_rays())
        throw Error(ErrorKind::device, "--rays query",
                    device.info().name +
                        " has no ray queries (VK_KHR_ray_query); use --rays host, or choose a "
                        "device that has them with --device");
    const DeviceTriangles::Mesh mesh = triangles.mesh(rays);
    const std::span<const std::uint32_t> all(mesh.corners);
    const std::size_t solid = 3 * std::size_t(triangles.solid());
    const gpu::TriangleTree::Triangles lists[] = {{.corners = all.first(solid), .opaque = true},
                                                  {.corners = all.subspan(solid), .opaque = false}};
    return {device, mesh.positions, lists};
}

/// Unfinished rays of a longer list.
struct Going {
    std::vector<CastRay> rays;
    std::vector<std::uint32_t> which;  ///< [rays] in that list

    void add(std::uint32_t i, const RaySpan& ray, float near)
    {
        if (!(ray.far > near))
            return;
        // Hits at the very end of a ray count, as on the CPU.
        rays.push_back({ray.origin, near, ray.direction, std::min(kBehind * ray.far, kFar)});
        which.push_back(i);
    }
};

class QueryCaster final : public RayCaster {
public:
    QueryCaster(const gpu::Device& device, const RayScene& rays)
        : rays_(rays),
          triangles_(rays),
          tree_(make_tree(device, rays, triangles_)),
          cast_(device),
          commands_(device, gpu::Timing::off),
          sent_(device, kMaxQueries, gpu::Buffer::Place::host, "rays to cast"),
          asked_(device, kMaxQueries, "rays being cast"),
          found_(device, kMaxQueries, "hits of rays"),
          returned_(device, kMaxQueries, gpu::Buffer::Place::host, "hits that return")
    {
    }

    void closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const override;
    void transmittance(std::span<const RaySpan> rays,
                       std::span<glm::vec3> transmittance) const override;
    std::size_t batch() const override { return kQueryBatch; }
    const char* name() const override { return "query"; }

private:
    bool has_passable() const { return triangles_.solid() < triangles_.count(); }
    /// The tint of transmitted light; nullopt if the ray ends here.
    std::optional<glm::vec3> transmittance(const CastHit& hit, std::uint32_t seed) const
    {
        const auto [part, triangle] = triangles_.place(hit.triangle);
        return rays_.transmittance(part, triangle, hit.barycentric, seed);
    }
    std::vector<CastHit> cast(std::span<const CastRay> rays, std::uint32_t wanted) const;
    void cast_at_once(std::span<const CastRay> rays, std::uint32_t wanted,
                      std::span<CastHit> hits) const;

    const RayScene& rays_;
    DeviceTriangles triangles_;
    gpu::TriangleTree tree_;
    gpu::Kernel<shaders::QueryCasterCast> cast_;
    mutable std::mutex mutex_;  ///< protects the following members and the device
    mutable gpu::Commands commands_;
    mutable gpu::Array<CastRay> sent_, asked_;
    mutable gpu::Array<CastHit> found_, returned_;
};

void QueryCaster::closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const
{
    assert(rays.size() == hits.size());
    Going going;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        hits[i].distance = kNothing;
        hits[i].tint = glm::vec3(1.0f);
        going.add(i, rays[i], rays[i].near);
    }
    while (!going.rays.empty()) {
        const std::vector<CastHit> found = cast(going.rays, kNearestOfAll);
        Going next;
        for (std::size_t n = 0; n < found.size(); ++n) {
            const CastHit& one = found[n];
            if (one.triangle == kNoTriangle)
                continue;
            const std::uint32_t i = going.which[n];
            if (one.triangle >= triangles_.solid())
                if (const auto tint = transmittance(one, rays[i].seed)) {
                    hits[i].tint *= *tint;
                    next.add(i, rays[i], kBehind * one.distance);
                    continue;
                }
            const auto [part, triangle] = triangles_.place(one.triangle);
            const glm::vec3 tint = hits[i].tint;
            hits[i] = rays_.hit(part, triangle, one.barycentric, one.distance, rays[i].direction);
            hits[i].tint = tint;
        }
        going = std::move(next);
    }
}

void QueryCaster::transmittance(std::span<const RaySpan> rays,
                                std::span<glm::vec3> transmittance) const
{
    assert(rays.size() == transmittance.size());
    Going all, going;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        transmittance[i] = glm::vec3(1.0f);
        all.add(i, rays[i], rays[i].near);
    }
    const std::vector<CastHit> solid = cast(all.rays, kAnySolid);
    for (std::size_t n = 0; n < solid.size(); ++n) {
        const std::uint32_t i = all.which[n];
        if (solid[n].triangle != kNoTriangle)
            transmittance[i] = glm::vec3(0.0f);
        else if (has_passable())
            going.add(i, rays[i], rays[i].near);
    }
    while (!going.rays.empty()) {
        const std::vector<CastHit> found = cast(going.rays, kNearestPassable);
        Going next;
        for (std::size_t n = 0; n < found.size(); ++n) {
            if (found[n].triangle == kNoTriangle)
                continue;
            const std::uint32_t i = going.which[n];
            const std::optional<glm::vec3> tint = this->transmittance(found[n], rays[i].seed);
            transmittance[i] *= tint.value_or(glm::vec3(0.0f));
            if (tint)
                next.add(i, rays[i], kBehind * found[n].distance);
        }
        going = std::move(next);
    }
}

std::vector<CastHit> QueryCaster::cast(std::span<const CastRay> rays, std::uint32_t wanted) const
{
    std::vector<CastHit> hits(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += kMaxQueries) {
        const std::size_t count = std::min(kMaxQueries, rays.size() - first);
        cast_at_once(rays.subspan(first, count), wanted, std::span(hits).subspan(first, count));
    }
    return hits;
}

void QueryCaster::cast_at_once(std::span<const CastRay> rays, std::uint32_t wanted,
                               std::span<CastHit> hits) const
{
    const std::lock_guard lock(mutex_);
    sent_.upload(rays);
    commands_.stage("rays");
    commands_.copy(sent_.buffer(), asked_.buffer(), rays.size_bytes());
    commands_.dispatch(
        cast_, {.triangles = tree_, .rays = asked_, .hits = found_},
        {.rays = std::uint32_t(rays.size()), .wanted = wanted, .solid = triangles_.solid()},
        rays.size());
    commands_.copy(found_.buffer(), returned_.buffer(), hits.size_bytes());
    commands_.run();
    std::copy_n(returned_.mapped(), hits.size(), hits.begin());
}

}  // namespace

std::unique_ptr<RayCaster> cast_by_queries(const gpu::Device& device, const RayScene& rays)
{
    return std::make_unique<QueryCaster>(device, rays);
}

}  // namespace lumel
