#include "raster/eyes/hemisphere_cuts.h"

#include <algorithm>

namespace lumel {
namespace {

/// Triangle slots for all eyes together, 3 MiB; more eyes at once save little.
constexpr std::uint32_t kMaxSlots = 1u << 18;

/// The two draws of a part for an eye.
constexpr std::uint32_t kStrips = 0, kPatches = 1;

std::uint32_t blocks_of(std::uint32_t indices)
{
    return (indices / 3 + kCutBlock - 1) / kCutBlock;
}

/// Blocks of everything drawable for one eye.
std::uint32_t most_blocks(const World& world)
{
    std::uint32_t blocks = blocks_of(world.opaque().inner_count);
    for (const CutOutDraw& cut_out : world.cut_outs())
        blocks += blocks_of(cut_out.range.inner_count);
    return std::max(blocks, 1u);
}

}  // namespace

HemisphereCuts::HemisphereCuts(const gpu::Device& device, const World& world,
                               std::uint32_t capacity)
    : world_(&world),
      eye_blocks_(most_blocks(world)),
      eye_draws_(2 * std::uint32_t(1 + world.cut_outs().size())),
      eyes_at_once_(std::clamp(kMaxSlots / (eye_blocks_ * kCutBlock), 1u, capacity)),
      cuts_(device, std::size_t(eyes_at_once_) * eye_blocks_ * kCutBlock),
      counts_(device, cuts_.size()),
      block_counts_(device, std::size_t(eyes_at_once_) * eye_blocks_),
      draws_(device, std::size_t(eyes_at_once_) * eye_draws_),
      cut_(device),
      count_(device),
      place_(device),
      strips_(device),
      patches_(device)
{
}

std::uint64_t HemisphereCuts::device_bytes()
{
    return kMaxSlots * (sizeof(std::uint32_t) + sizeof(CutCount));
}

std::vector<HemisphereCuts::Part> HemisphereCuts::parts() const
{
    std::vector<Part> parts;
    std::uint32_t block = 0;
    const auto add = [&](const OccluderRange& occluders, const CutOutDraw* cut_out) {
        const gpu::Range range = world_->drawn(occluders);
        if (range.count == 0)
            return;
        parts.push_back({range, cut_out, block, blocks_of(range.count)});
        block += parts.back().blocks;
    };
    add(world_->opaque(), nullptr);
    for (const CutOutDraw& cut_out : world_->cut_outs())
        add(cut_out.range, &cut_out);
    return parts;
}

template <class Shaders>
gpu::Drawing<Shaders> HemisphereCuts::use(gpu::Commands& commands,
                                          const gpu::Raster<Shaders>& raster,
                                          const gpu::Array<Eye>& eyes) const
{
    return commands.use(raster, {.eyes = eyes,
                                 .vertices = world_->vertices(),
                                 .indices = world_->indices(),
                                 .counts = counts_,
                                 .block_counts = block_counts_,
                                 .cuts = cuts_});
}

template <class Shaders>
gpu::Drawing<Shaders>
HemisphereCuts::use(gpu::Commands& commands, const gpu::Raster<Shaders>& raster,
                    const gpu::Array<Eye>& eyes, const CutOutDraw& cut_out) const
{
    return commands.use(raster, {.eyes = eyes,
                                 .vertices = world_->vertices(),
                                 .indices = world_->indices(),
                                 .counts = counts_,
                                 .block_counts = block_counts_,
                                 .cuts = cuts_,
                                 .base_color = {*cut_out.color, *cut_out.sampler},
                                 .looks = world_->looks()});
}

std::uint32_t HemisphereCuts::draw_index(std::uint32_t eye, std::size_t part) const
{
    return (eye - first_eye_) * eye_draws_ + 2 * std::uint32_t(part);
}

void HemisphereCuts::cut(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                         std::uint32_t count, float near, float radius, float chord)
{
    first_eye_ = first;
    const std::vector<Part> all = parts();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Part& part = all[i];
        const CutParams params{.first_eye = first,
                               .eyes = count,
                               .first_index = part.range.first,
                               .triangles = part.range.count / 3,
                               .first_block = part.first_block,
                               .blocks = part.blocks,
                               .eye_blocks = eye_blocks_,
                               .first_draw = 2 * std::uint32_t(i),
                               .eye_draws = eye_draws_,
                               .near = near,
                               .radius = radius,
                               .chord = chord};
        const std::size_t blocks = std::size_t(count) * part.blocks;
        commands.dispatch(cut_,
                          {.eyes = eyes,
                           .vertices = world_->vertices(),
                           .indices = world_->indices(),
                           .cuts = cuts_},
                          params, blocks * kCutBlock);
        commands.dispatch(count_, {.cuts = cuts_, .counts = counts_, .block_counts = block_counts_},
                          params, blocks);
        commands.dispatch(place_, {.block_counts = block_counts_, .draws = draws_}, params, count);
    }
}

void HemisphereCuts::draw(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                          std::uint32_t last,
                          const std::function<LookParams(std::uint32_t)>& begin_eye) const
{
    const std::vector<Part> all = parts();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Part& part = all[i];
        const auto draw_all = [&](const auto& drawing, std::uint32_t kind) {
            for (std::uint32_t eye = first; eye < last; ++eye) {
                LookParams params = begin_eye(eye);
                if (part.cut_out)
                    params.passage = part.cut_out->passage;
                params.first_index = part.range.first;
                params.first_block = (eye - first_eye_) * eye_blocks_ + part.first_block;
                params.blocks = part.blocks;
                drawing.draw_indirect(params, draws_, draw_index(eye, i) + kind);
            }
        };
        const auto draw_kind = [&](const auto& rasters, std::uint32_t kind) {
            if (part.cut_out)
                draw_all(use(commands, rasters.cut_out, eyes, *part.cut_out), kind);
            else
                draw_all(use(commands, rasters.opaque, eyes), kind);
        };
        draw_kind(strips_, kStrips);
        draw_kind(patches_, kPatches);
    }
}

}  // namespace lumel
