#include "methods/redistribution/patch_sides.h"

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

std::uint32_t pixels_of_levels(std::uint32_t side, std::uint32_t levels)
{
    std::uint32_t sum = 0;
    for (std::uint32_t level = 0; level < levels; ++level)
        sum += 3 * (side >> level) * (side >> level);
    return sum;
}

/// Fronts of all movable patches, and backs of those of open meshes.
std::vector<ChosenPatch> moving_patches(const Patches& layout, const Lumels& lumels,
                                        const std::vector<char>& open)
{
    std::vector<ChosenPatch> list;
    for (const std::uint32_t send : {kSendCrossing, kSendBackSide})
        for (std::uint32_t c = 0; c < layout.charts.size(); ++c) {
            const PatchChart& chart = layout.charts[c];
            const bool is_open = open[lumels.lumels[chart.first_lumel].instance] != 0;
            if (!chart.moving || (send == kSendBackSide && !is_open))
                continue;
            for (std::uint32_t index = 0; index < patches_of(chart, 0); ++index)
                list.push_back({c, 0, index, send});
        }
    return list;
}

}  // namespace

PatchSides::PatchSides(const gpu::Device& device, World& world, const Lumels& lumels,
                       ProgressiveRadiosity& solver, const std::vector<char>& open,
                       std::uint32_t back_side, std::uint32_t levels)
    : world_(&world),
      solver_(&solver),
      back_eyes_kernel_(device),
      resolve_(device),
      batch_(solver.shots().batch()),
      levels_(levels),
      views_(device, world, back_side, solver.shots().views().layout().near, batch_),
      back_layout_{back_side, pixels_of_levels(back_side, levels)},
      patches_(moving_patches(solver.shots().layout(), lumels, open)),
      list_(device, view(in_whole_batches(patches_, batch_))),
      back_eyes_(device, batch_),
      back_(device, std::size_t(batch_) * back_layout_.per_hemicube)
{
}

void PatchSides::look_from_fronts(std::uint32_t first)
{
    PatchShots& shots = solver_->shots();
    gpu::Pacer& pacer = solver_->pacer();
    pacer.work("take", [&](gpu::Commands& commands) {
        shots.take(commands, solver_->light(), list_, first);
        commands.dispatch(back_eyes_kernel_, {.eyes = shots.eyes(), .back_eyes = back_eyes_},
                          TakeParams{batch_}, batch_);
    });
    world_->show_movers(true);
    shots.look(pacer);
}

void PatchSides::look_from_backs(const SurfaceLight& light)
{
    world_->show_movers(false);
    views_.look_from(solver_->pacer(), back_eyes_, light, batch_);
    solver_->pacer().work("resolve", [&](gpu::Commands& commands) {
        for (std::uint32_t level = 0; level < levels_; ++level) {
            const std::uint32_t side = back_layout_.side >> level;
            commands.dispatch(resolve_,
                              {.views = {views_.image(), views_.sampler()}, .back = back_},
                              ResolveParams{.views = views_.layout(),
                                            .back = back_layout_,
                                            .level = level,
                                            .batch = batch_,
                                            .samples = gpu::kManySamples},
                              std::size_t(batch_) * 3 * side * side);
        }
    });
}

}  // namespace lumel
