#include "raster/parallel/parallel_views.h"

#include <algorithm>
#include <cmath>

#include "base/core/frame.h"

namespace lumel {
namespace {

/// Pixels around the scene: one for the offset, and half a pixel from the tile's edge.
constexpr float kBorder = 1.5f;
/// Fraction of the depth range that is free at both ends.
constexpr float kDepthBorder = 0.01f;

constexpr std::uint32_t kMinMapSide = 128, kMaxMapSide = 2048;

/// Extent of a box along an axis.
struct Reach {
    float low = std::numeric_limits<float>::max(), high = -low;
    float size() const { return high - low; }
    float middle() const { return 0.5f * (low + high); }
};

Reach reach_along(const glm::vec3& axis, const glm::vec3& low, const glm::vec3& high)
{
    Reach reach;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                           corner & 4 ? high.z : low.z);
        reach.low = std::min(reach.low, glm::dot(axis, at));
        reach.high = std::max(reach.high, glm::dot(axis, at));
    }
    return reach;
}

}  // namespace

ParallelLayout tile_layout(const gpu::Device& device, std::uint32_t side, std::uint32_t capacity)
{
    return {side, tile_columns(capacity, std::max(device.max_image_side() / side, 1u))};
}

Tiles tiles_of(const ParallelLayout& layout)
{
    return {layout.side, layout.side, layout.columns};
}

std::uint32_t parallel_side(const Lumels& lumels, float diagonal, float pixels, std::uint32_t most)
{
    std::vector<float> sizes;
    for (const Lumel& lumel : lumels.lumels)
        if (!(lumel.flags & kLumelBuried) && lumel.area > 0.0f)
            sizes.push_back(std::sqrt(lumel.area));
    if (sizes.empty())
        return kMinMapSide;
    const auto median = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
    std::nth_element(sizes.begin(), median, sizes.end());
    const float across = pixels * diagonal / std::max(*median, 1e-30f);
    const std::uint32_t largest = std::min(kMaxMapSide, most);
    return std::clamp(std::uint32_t(std::min(across, float(largest))), kMinMapSide, largest);
}

ParallelView fit_view(const glm::vec3& low, const glm::vec3& high, std::uint32_t side,
                      const ParallelPose& pose)
{
    const glm::mat3 frame = frame_about(pose.toward);
    const glm::vec3 right = std::cos(pose.turn) * frame[0] + std::sin(pose.turn) * frame[1];
    const glm::vec3 up = std::cos(pose.turn) * frame[1] - std::sin(pose.turn) * frame[0];

    const Reach x = reach_along(right, low, high), y = reach_along(up, low, high);
    const Reach z = reach_along(pose.toward, low, high);
    const float tiny = std::numeric_limits<float>::min();
    const float scale = (float(side) - 2.0f * kBorder) / std::max({x.size(), y.size(), tiny});
    const float depth_scale = (1.0f - 2.0f * kDepthBorder) / std::max(z.size(), tiny);
    const glm::vec2 centre = 0.5f * glm::vec2(float(side)) + pose.offset - 0.5f;
    return {.right = scale * right,
            .up = scale * up,
            .toward = depth_scale * pose.toward,
            .shift = centre - scale * glm::vec2(x.middle(), y.middle()),
            .depth_shift = kDepthBorder - depth_scale * z.low,
            .random = pose.random,
            .channel = pose.channel};
}

ParallelViews::ParallelViews(const gpu::Device& device, const World& world, std::uint32_t side,
                             std::uint32_t capacity)
    : world_(&world),
      layout_(tile_layout(device, side, capacity)),
      capacity_(tiles_of(layout_).fitting(capacity, device.max_image_side())),
      image_(device, gpu::Pixel::depth, tiles_of(layout_).image_width(),
             tiles_of(layout_).image_height(capacity_)),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      rasters_(device)
{
}

void ParallelViews::draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views,
                         std::uint32_t view, std::uint32_t tile)
{
    const auto draw_range = [&](const auto& drawing, const OccluderRange& range,
                                const Passage& passage) {
        drawing.draw({layout_, view, passage}, {range.first_index, range.index_count});
    };
    commands.begin_pass(nullptr, image_, tiles_of(layout_).area(tile));
    if (world_->opaque().index_count > 0)
        draw_range(commands.use(rasters_.opaque, {.views = views}, {.position = world_->vertices()},
                                world_->indices()),
                   world_->opaque(), {});
    for (const CutOutDraw& cut_out : world_->cut_outs())
        draw_range(commands.use(rasters_.cut_out,
                                {.views = views, .base_color = {*cut_out.color, *cut_out.sampler}},
                                {.position = world_->vertices(), .look = world_->looks()},
                                world_->indices()),
                   cut_out.range, cut_out.passage);
    commands.end_pass();
}

void ParallelViews::look_along(gpu::Pacer& pacer, const gpu::Array<ParallelView>& views,
                               std::uint32_t first, std::uint32_t count)
{
    pacer.work("look along", count, 1,
               [&](gpu::Commands& commands, std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t tile = begin; tile < end; ++tile)
                       draw(commands, views, first + tile, tile);
               });
}

}  // namespace lumel
