#include "rays/device/device_caster.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "gpu/commands.h"
#include "gpu/triangle_tree.h"
#include "rays/cast/device_triangles.h"
#include "rays/device/device_caster.query.comp.h"
#include "rays/device/device_caster.tree.comp.h"
#include "rays/device/flat_tree.h"

namespace lumel {
namespace {

/// Rays per dispatch: few enough that a step of the tracer has some for each core, and a core takes
/// far longer to make them than the GPU to answer.
constexpr std::size_t kBatch = std::size_t(1) << 13;
/// Hits at the very end of a ray count, as on the CPU, despite rounding.
constexpr float kToTheEnd = 1.0f + 8.0f * std::numeric_limits<float>::epsilon();
constexpr float kFar = std::numeric_limits<float>::max();

/// Records the cast of rays by one of the kernels.
using Cast = std::function<void(gpu::Commands& commands, const gpu::Array<CastRay>& rays,
                                const gpu::Array<CastHit>& hits, const CastParams& params)>;

/// The buffers of a thread that casts rays. The device reads and writes host memory: each ray and
/// hit crosses the bus once.
class Lane {
public:
    explicit Lane(const gpu::Device& device)
        : commands(device, gpu::Timing::off),
          rays(device, kBatch, gpu::Buffer::Place::host, "rays to cast"),
          hits(device, kBatch, gpu::Buffer::Place::host, "hits of rays")
    {
    }

    /// Ray `i` of a longer list.
    void add(std::uint32_t i, const RaySpan& ray)
    {
        if (!(ray.far > ray.near))
            return;
        sent()[which_.size()] = {ray.origin, ray.near, ray.direction,
                                 std::min(kToTheEnd * ray.far, kFar)};
        which_.push_back(i);
    }
    void clear() { which_.clear(); }
    /// [rays] in that list
    const std::vector<std::uint32_t>& which() const { return which_; }

    gpu::Commands commands;
    gpu::Array<CastRay> rays;
    gpu::Array<CastHit> hits;

private:
    CastRay* sent() const { return reinterpret_cast<CastRay*>(rays.buffer().mapped()); }

    std::vector<std::uint32_t> which_;
};

/// One for each core.
std::size_t lanes()
{
    return std::max(1u, std::thread::hardware_concurrency());
}

class DeviceCaster final : public RayCaster {
public:
    DeviceCaster(const gpu::Device& device, const RayScene& rays, DeviceTriangles triangles,
                 const char* name, Cast cast)
        : device_(device),
          rays_(rays),
          triangles_(std::move(triangles)),
          name_(name),
          cast_(std::move(cast))
    {
        for (std::size_t n = 0; n < lanes(); ++n)
            free_.push_back(std::make_unique<Lane>(device_));
    }

    void closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const override
    {
        assert(rays.size() == hits.size());
        in_batches(rays.size(), [&](Lane& lane, std::size_t first, std::size_t count) {
            find_closest(lane, rays.subspan(first, count), hits.subspan(first, count));
        });
    }
    void transmittance(std::span<const RaySpan> rays,
                       std::span<glm::vec3> transmittance) const override
    {
        assert(rays.size() == transmittance.size());
        in_batches(rays.size(), [&](Lane& lane, std::size_t first, std::size_t count) {
            find_transmittance(lane, rays.subspan(first, count),
                               transmittance.subspan(first, count));
        });
    }
    std::size_t batch() const override { return kBatch; }
    const char* name() const override { return name_; }

private:
    using Batch = std::function<void(Lane& lane, std::size_t first, std::size_t count)>;
    void in_batches(std::size_t rays, const Batch& batch) const;
    void find_closest(Lane& lane, std::span<const RaySpan> rays, std::span<RayHit> hits) const;
    void find_transmittance(Lane& lane, std::span<const RaySpan> rays,
                            std::span<glm::vec3> transmittance) const;
    std::span<const CastHit> cast(Lane& lane, std::span<const RaySpan> rays,
                                  std::uint32_t wanted) const;

    const gpu::Device& device_;
    const RayScene& rays_;
    DeviceTriangles triangles_;
    const char* name_;
    Cast cast_;
    mutable std::mutex recording_;  ///< of commands on the device
    mutable std::mutex choosing_;   ///< protects free_
    mutable std::vector<std::unique_ptr<Lane>> free_;
};

/// Every thread has a lane of its own, so that some prepare rays while the device casts others.
void DeviceCaster::in_batches(std::size_t rays, const Batch& batch) const
{
    std::unique_ptr<Lane> lane;
    {
        const std::lock_guard lock(choosing_);
        if (!free_.empty()) {
            lane = std::move(free_.back());
            free_.pop_back();
        }
    }
    if (!lane) {  // the host has more threads than cores
        const std::lock_guard lock(recording_);
        lane = std::make_unique<Lane>(device_);
    }
    for (std::size_t first = 0; first < rays; first += kBatch)
        batch(*lane, first, std::min(kBatch, rays - first));
    const std::lock_guard lock(choosing_);
    free_.push_back(std::move(lane));
}

void DeviceCaster::find_closest(Lane& lane, std::span<const RaySpan> rays,
                                std::span<RayHit> hits) const
{
    const std::span<const CastHit> found = cast(lane, rays, kNearest);
    for (RayHit& hit : hits) {
        hit.distance = kNothing;
        hit.tint = glm::vec3(1.0f);
    }
    for (std::size_t n = 0; n < found.size(); ++n) {
        const CastHit& one = found[n];
        if (one.triangle == kNoTriangle)
            continue;
        const std::uint32_t i = lane.which()[n];
        hits[i] = triangles_.hit(rays_, rays[i], {one.triangle, one.distance, one.barycentric});
    }
}

void DeviceCaster::find_transmittance(Lane& lane, std::span<const RaySpan> rays,
                                      std::span<glm::vec3> transmittance) const
{
    const std::span<const CastHit> found = cast(lane, rays, kOccluder);
    std::ranges::fill(transmittance, glm::vec3(1.0f));
    for (std::size_t n = 0; n < found.size(); ++n) {
        const std::uint32_t i = lane.which()[n];
        if (found[n].triangle != kNoTriangle)
            transmittance[i] = found[n].triangle < triangles_.solid()
                                   ? glm::vec3(0.0f)
                                   : rays_.transmittance(rays[i]);
    }
}

/// Hits of the lane's rays, which are those that can hit anything.
std::span<const CastHit> DeviceCaster::cast(Lane& lane, std::span<const RaySpan> rays,
                                            std::uint32_t wanted) const
{
    lane.clear();
    for (std::uint32_t i = 0; i < rays.size(); ++i)
        lane.add(i, rays[i]);
    const std::size_t count = lane.which().size();
    if (count == 0)
        return {};
    {
        const std::lock_guard lock(recording_);
        lane.commands.stage("rays");
        cast_(lane.commands, lane.rays, lane.hits,
              {.rays = std::uint32_t(count), .wanted = wanted, .solid = triangles_.solid()});
        lane.commands.submit();
    }
    lane.commands.wait_awake();
    return {lane.hits.mapped(), count};
}

std::shared_ptr<gpu::TriangleTree> make_tree(const gpu::Device& device, const RayScene& rays,
                                             const DeviceTriangles& triangles)
{
    if (!device.can_query_rays())
        throw Error(
            ErrorKind::device, "--rays query",
            device.info().name +
                " has no ray queries (VK_KHR_ray_query); use --rays tree or --rays host, or "
                "choose a device that has them with --device");
    const DeviceTriangles::Mesh mesh = triangles.mesh(rays);
    const std::span<const std::uint32_t> all(mesh.corners);
    const std::size_t solid = 3 * std::size_t(triangles.solid());
    const gpu::TriangleTree::Triangles lists[] = {{.corners = all.first(solid), .opaque = true},
                                                  {.corners = all.subspan(solid), .opaque = false}};
    return std::make_shared<gpu::TriangleTree>(device, mesh.positions, lists);
}

/// A kernel with the tree that it walks.
struct TreeOnDevice {
    TreeOnDevice(const gpu::Device& device, const FlatTree& tree)
        : nodes(device, tree.nodes, "nodes of a tree"),
          triangles(device, tree.triangles, "triangles of a tree"),
          cast(device)
    {
    }

    gpu::Array<TreeNode> nodes;
    gpu::Array<TreeTriangle> triangles;
    gpu::Kernel<shaders::DeviceCasterTree> cast;
};

/// Memory of a triangle with its share of the nodes [bytes]: 80 in Sponza; an estimate for queries.
constexpr std::uint64_t kTriangleBytes = sizeof(TreeTriangle) + sizeof(TreeNode) * 5 / 8;

}  // namespace

std::uint64_t device_rays_bytes(const RayScene& rays)
{
    return kTriangleBytes * DeviceTriangles(rays).count() +
           lanes() * kBatch * (sizeof(CastRay) + sizeof(CastHit));
}

std::unique_ptr<RayCaster> cast_by_queries(const gpu::Device& device, const RayScene& rays)
{
    DeviceTriangles triangles(rays);
    const auto tree = make_tree(device, rays, triangles);
    const auto kernel = std::make_shared<gpu::Kernel<shaders::DeviceCasterQuery>>(device);
    return std::make_unique<DeviceCaster>(
        device, rays, std::move(triangles), "query",
        [=](gpu::Commands& commands, const gpu::Array<CastRay>& given,
            const gpu::Array<CastHit>& hits, const CastParams& params) {
            commands.dispatch(*kernel, {.triangles = *tree, .rays = given, .hits = hits}, params,
                              params.rays);
        });
}

std::unique_ptr<RayCaster> cast_by_tree(const gpu::Device& device, const RayScene& rays)
{
    DeviceTriangles triangles(rays);
    if (triangles.count() * std::uint64_t(sizeof(TreeTriangle)) > device.max_array_bytes())
        throw Error(ErrorKind::device, "--rays tree",
                    "the scene has more triangles than an array of " + device.info().name +
                        " can hold; use --rays host");
    const auto tree = std::make_shared<TreeOnDevice>(device, build_flat_tree(triangles.mesh(rays)));
    return std::make_unique<DeviceCaster>(
        device, rays, std::move(triangles), "tree",
        [=](gpu::Commands& commands, const gpu::Array<CastRay>& given,
            const gpu::Array<CastHit>& hits, const CastParams& params) {
            commands.dispatch(tree->cast,
                              {.nodes = gpu::packed(tree->nodes),
                               .triangles = gpu::packed(tree->triangles),
                               .rays = given,
                               .hits = hits},
                              params, params.rays);
        });
}

}  // namespace lumel
