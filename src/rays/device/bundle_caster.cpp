#include "rays/device/bundle_caster.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/core/error.h"
#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "gpu/commands.h"
#include "rays/cast/device_triangles.h"
#include "rays/cast/ray_caster.h"
#include "rays/device/bundle_caster.cast.comp.h"
#include "rays/device/bundle_caster.raster.h"

namespace lumel {
namespace {

/// Maximum rays, and views, in GPU memory at once.
constexpr std::size_t kMaxRays = std::size_t(1) << 18;
constexpr std::uint32_t kMaxViews = 1024;
/// Maximum views per pass: enough to hide its start-up cost.
constexpr std::uint32_t kMaxSlots = 64;
/// Maximum pixels per pass; lists and the image take 8 bytes each.
constexpr std::uint32_t kMaxPixels = 1u << 22;
/// Capacity of the lists over all pixels of a pass (32 MiB). Larger passes are split.
constexpr std::uint32_t kListed = 1u << 22;
/// Side of a view [pixels], a power of two so that pixel positions are exact. Listed triangles are
/// tested exactly; finer views make shorter lists and slower passes. A view has about one pixel per
/// two triangles.
constexpr std::uint32_t kMinSide = 32, kMaxSide = 1024;
constexpr double kTrianglesPerPixel = 2.0;
static_assert(kListed >= kMaxSide * kMaxSide, "a triangle alone has room");
/// Border around the scene [pixels], for rays that start on its edge.
constexpr float kBorder = 1.0f;
/// Maximum boxes per draw call, in which small scenes draw several views.
constexpr std::uint32_t kMaxBoxes = 1u << 16;
/// Indices of a box around a triangle: two triangles.
constexpr std::uint32_t kIndices = 6;
/// Hits per task.
constexpr std::size_t kGrain = 1024;

const gpu::Device& able_to_list(const gpu::Device& device)
{
    if (!device.can_list_fragments())
        throw Error(ErrorKind::device, "--rays raster",
                    device.info().name +
                        " cannot write lists while it draws (fragmentStoresAndAtomics); use "
                        "--rays host");
    return device;
}

std::uint32_t side_for(std::uint32_t triangles)
{
    const auto side = std::uint32_t(std::sqrt(double(triangles) / kTrianglesPerPixel));
    return std::clamp(std::bit_ceil(side), kMinSide, kMaxSide);
}

std::uint32_t slots_for(const gpu::Device& device, std::uint32_t side)
{
    return std::bit_floor(
        std::min({kMaxSlots, device.max_image_side() / side, kMaxPixels / (side * side)}));
}

/// Number of views per draw call.
std::uint32_t views_at_once(std::uint32_t triangles, std::uint32_t slots)
{
    return std::clamp(kMaxBoxes / std::max(triangles, 1u), 1u, slots);
}

std::vector<std::uint32_t> box_indices(std::uint32_t boxes)
{
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t(kIndices) * boxes);
    for (std::uint32_t box = 0; box < boxes; ++box)
        for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u})
            indices.push_back(4 * box + corner);
    return indices;
}

/// A view along a direction that contains the scene.
BundleView view_along(const glm::vec3& direction, const RayScene& rays, std::uint32_t side)
{
    const glm::mat3 frame = frame_about(direction);
    const glm::vec3 middle = 0.5f * (rays.low() + rays.high());
    const glm::vec3 half = 0.5f * (rays.high() - rays.low());
    const auto reach = [&](const glm::vec3& axis) { return glm::dot(glm::abs(axis), half); };
    const float tiny = std::numeric_limits<float>::min();
    const float across = std::max({reach(frame[0]), reach(frame[1]), tiny});
    const float scale = (0.5f * float(side) - kBorder) / across;
    const glm::vec2 centre(glm::dot(frame[0], middle), glm::dot(frame[1], middle));
    return {.right = frame[0],
            .up = frame[1],
            .along = direction,
            .low = centre - 0.5f * float(side) / scale,
            .scale = scale};
}

/// Indices of rays, sorted by direction. first [directions + 1]: index into `rays`.
struct Sorted {
    std::vector<std::uint32_t> rays, first;

    Sorted(std::span<const std::uint32_t> along, std::size_t directions)
        : rays(along.size()),
          first(directions + 1, 0)
    {
        for (const std::uint32_t d : along)
            ++first[d + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t i = 0; i < along.size(); ++i)
            rays[next[along[i]]++] = i;
    }
};

/// Rays in GPU memory at once, sorted by view.
struct Go {
    std::vector<BundleView> views;
    std::vector<std::uint32_t> first_ray;  ///< [views + 1]
    std::vector<BundleRay> rays;
    std::vector<std::uint32_t> which;  ///< [rays] indices among all
};

/// Several views with all triangles, or one view with some of them.
struct Job {
    std::uint32_t view, views, triangle, triangles;
};

}  // namespace

struct BundleCaster::Data {
    Data(const gpu::Device& device, const RayScene& scene);

    void cast(const Go& go, std::span<const RaySpan> rays, std::span<RayHit> hits);
    void cast_part(const Go& go, const Job& job);
    std::uint32_t draw_and_cast(const Go& go, const Job& job);
    void draw(const Job& job);
    void take(const BundleHit& found, const RaySpan& ray, RayHit& hit) const;

    const RayScene& rays;
    DeviceTriangles triangles;
    std::uint32_t side, slots;
    std::uint32_t per_call;  ///< views per draw call
    std::uint32_t at_once;   ///< views of the next pass
    gpu::Raster<shaders::BundleCaster> raster;
    gpu::Kernel<shaders::BundleCasterCast> tester;
    gpu::Commands commands;
    std::optional<gpu::Array<glm::vec3>> positions;
    std::optional<gpu::Array<std::uint32_t>> corners;
    gpu::Array<std::uint32_t> indices;
    gpu::Target depth;  ///< never written; passes require a depth target
    gpu::Array<BundleView> views;
    gpu::Array<std::uint32_t> heads;
    gpu::Array<Listed> lists;
    gpu::Array<std::uint32_t> used, used_there;  ///< list length; its readback
    gpu::Array<BundleRay> asked;
    gpu::Array<BundleHit> found;
};

BundleCaster::Data::Data(const gpu::Device& device, const RayScene& scene)
    : rays(scene),
      triangles(scene),
      side(side_for(triangles.count())),
      slots(slots_for(able_to_list(device), side)),
      per_call(views_at_once(triangles.count(), slots)),
      at_once(slots),
      raster(device, {.depth_test = false}),
      tester(device),
      commands(device, gpu::Timing::off),
      indices(device, box_indices(triangles.count() * per_call)),
      depth(device, gpu::Pixel::depth, side, side * slots),
      views(device, kMaxViews),
      heads(device, std::size_t(side) * side * slots),
      lists(device, kListed),
      used(device, 1),
      used_there(device, 1, gpu::Buffer::Place::host),
      asked(device, kMaxRays),
      found(device, kMaxRays)
{
    const DeviceTriangles::Mesh mesh = triangles.mesh(scene);
    positions.emplace(device, mesh.positions);
    corners.emplace(device, mesh.corners);
}

void BundleCaster::Data::draw(const Job& job)
{
    commands.fill(heads.buffer(), kNoneListed);
    commands.fill(used.buffer(), 0);
    const gpu::Area area{0, 0, side, side * slots};
    commands.begin_pass(nullptr, depth, area);
    const auto drawing = commands.use(raster,
                                      {.views = views,
                                       .positions = *positions,
                                       .corners = *corners,
                                       .heads = heads,
                                       .lists = lists,
                                       .used = used},
                                      {}, indices);
    for (std::uint32_t slot = 0; slot < job.views; slot += per_call) {
        const std::uint32_t more = std::min(per_call, job.views - slot) - 1;
        drawing.draw(
            {.view = job.view + slot,
             .slot = slot,
             .slots = slots,
             .side = side,
             .triangles = triangles.count(),
             .capacity = kListed},
            {kIndices * job.triangle, kIndices * (job.triangles + more * triangles.count())});
    }
    commands.end_pass();
}

/// Returns the number of triangles that the pixels needed to list. All that fit were tested.
std::uint32_t BundleCaster::Data::draw_and_cast(const Go& go, const Job& job)
{
    commands.stage("draw bundles");
    draw(job);
    commands.stage("cast bundles");
    const std::uint32_t first = go.first_ray[job.view];
    const std::uint32_t count = go.first_ray[job.view + job.views] - first;
    commands.dispatch(tester,
                      {.views = views,
                       .positions = *positions,
                       .corners = *corners,
                       .heads = heads,
                       .lists = lists,
                       .rays = asked,
                       .hits = found},
                      {.first = first, .count = count, .first_view = job.view, .side = side},
                      count);
    commands.copy(used.buffer(), used_there.buffer(), sizeof(std::uint32_t));
    commands.run();
    return *used_there.mapped();
}

/// Converts a result of the GPU.
void BundleCaster::Data::take(const BundleHit& one, const RaySpan& ray, RayHit& hit) const
{
    hit.distance = RayCaster::kNothing;
    hit.tint = glm::vec3(1.0f);
    if (one.triangle == kNoneListed)
        return;
    hit = triangles.hit(rays, ray, {one.triangle, one.distance, one.barycentric});
}

/// Splits a part that exceeds the lists in halves. Testing a triangle twice does not change hits.
void BundleCaster::Data::cast_part(const Go& go, const Job& job)
{
    if (draw_and_cast(go, job) <= kListed)
        return;
    if (job.views > 1) {
        const std::uint32_t half = job.views / 2;
        at_once = std::min(at_once, half);
        cast_part(go, {job.view, half, job.triangle, job.triangles});
        cast_part(go, {job.view + half, job.views - half, job.triangle, job.triangles});
    } else {
        const std::uint32_t half = job.triangles / 2;
        cast_part(go, {job.view, 1, job.triangle, half});
        cast_part(go, {job.view, 1, job.triangle + half, job.triangles - half});
    }
}

void BundleCaster::Data::cast(const Go& go, std::span<const RaySpan> all, std::span<RayHit> hits)
{
    views.upload(go.views);
    asked.upload(go.rays);
    std::vector<BundleHit> result(go.rays.size(), {kNoneListed, RayCaster::kNothing, {}});
    found.upload(result);
    const auto count = std::uint32_t(go.views.size());
    for (std::uint32_t view = 0, next; view < count; view = next) {
        next = std::min(view + at_once, count);
        cast_part(go, {view, next - view, 0, triangles.count()});
    }
    found.buffer().download(result.data(), result.size() * sizeof(BundleHit));
    parallel_for(result.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            take(result[i], all[go.which[i]], hits[go.which[i]]);
    });
}

BundleCaster::BundleCaster(const gpu::Device& device, const RayScene& rays)
    : data_(std::make_unique<Data>(device, rays))
{
}

BundleCaster::~BundleCaster() = default;

void BundleCaster::closest(const RayBundles& bundles, std::span<RayHit> hits) const
{
    assert(bundles.rays.size() == hits.size() && bundles.along.size() == hits.size());
    const Sorted sorted(bundles.along, bundles.directions.size());
    Go go;
    const auto cast = [&] {
        go.first_ray.push_back(std::uint32_t(go.rays.size()));
        if (!go.rays.empty())
            data_->cast(go, bundles.rays, hits);
        go = {};
    };
    for (std::size_t d = 0; d < bundles.directions.size(); ++d)
        for (std::uint32_t k = sorted.first[d]; k < sorted.first[d + 1]; ++k) {
            const bool full = go.rays.size() == kMaxRays || go.views.size() == kMaxViews;
            const bool begins = k == sorted.first[d];
            if (go.rays.size() == kMaxRays || (begins && full))
                cast();
            if (begins || go.views.empty()) {
                go.views.push_back(view_along(bundles.directions[d], data_->rays, data_->side));
                go.first_ray.push_back(std::uint32_t(go.rays.size()));
            }
            const RaySpan& ray = bundles.rays[sorted.rays[k]];
            go.rays.push_back({ray.origin, ray.near, ray.far, std::uint32_t(go.views.size()) - 1});
            go.which.push_back(sorted.rays[k]);
        }
    cast();
}

}  // namespace lumel
