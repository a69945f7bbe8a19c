// Cross-redistribution radiosity.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 3.3 and 4.5.
//
// C are the static lumels, M the movable ones. The progressive solver shoots C's light among C
// alone, as if M did not exist: H = T_CC B^s. The effect of M on C is stored separately, and
// recomputed whenever objects moved or more was shot: lamps shoot past M (lamp_shadows.h), then for
// each patch j of M (Algorithm 4.4):
//
//     render the world from the front of j                  look_from
//     gather the light that arrives at its lumels           gather    R_g(C, M), R(M, M)
//     send all their light                                  send
//     render C's light, without lamps, from the back of j   look_from in colour, resolve
//     for all lumels i of C:                                receive
//         ΔH_i += F_ij (B_j - P(C, j, i))                   R_p(M, C), R_x(C, C): Eq. (3.3.1)
//     replace the previous ΔH                               settle
//
// Differs from the thesis:
// - The solution without M is stored. No light of an old position is taken back, so there are 2
//   |M| hemicubes instead of 4 |M|, errors cannot accumulate, and M need not be removed before C
//   shoots (section 4.5.2, Error analysis).
// - Lamps are not crossed. The thesis names undersampling of small lamps as its main artefact.
// - Patches are blocks of lumels on any triangles; rays go through the lumels, where the thesis
//   divides a quad into a grid.
// - Back hemicubes have mipmaps; the level follows from the width of the bundle of rays through a
//   lumel where it ends.
// - Close pairs use form factors of the near field: no halos where objects touch.
// - M's lumels gather from C's by the depth hemicube of their patch, where the thesis multiplies
//   a hemicube of radiosity by delta form factors.

#include "methods/redistribution/cross.h"

#include <algorithm>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Side of a back hemicube's front face [pixels]; the thesis goes down to 16. Divisible by
/// 2^kBackLevels, so that faces stay separate in all levels.
constexpr std::uint32_t kBackSide = 32;

/// Rows of static lumels, with columns of movable ones.
NearField rows_of_still(const NearField& near, const Lumels& lumels)
{
    const auto moves = [&](std::uint32_t i) {
        return (lumels.lumels[i].flags & kLumelMoving) != 0;
    };
    NearField rows;
    rows.first.push_back(0);
    for (std::uint32_t i = 0; i + 1 < near.first.size(); ++i) {
        for (std::uint32_t k = near.first[i]; !moves(i) && k < near.first[i + 1]; ++k)
            if (moves(near.column[k])) {
                rows.column.push_back(near.column[k]);
                rows.factor.push_back(near.factor[k]);
            }
        rows.first.push_back(std::uint32_t(rows.column.size()));
    }
    return rows;
}

}  // namespace

CrossRedistribution::CrossRedistribution(const gpu::Device& device, World& world,
                                         const Lumels& lumels, ProgressiveRadiosity& solver,
                                         const std::vector<char>& movers,
                                         const std::vector<char>& open, const CrossOptions& options,
                                         std::uint64_t most_bytes)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      solver_(&solver),
      part_(device),
      gather_(device, std::uint32_t(solver.shots().views().projection())),
      send_(device),
      receive_(device, std::uint32_t(solver.shots().views().projection())),
      settle_(device),
      lamps_(device, world, lumels, solver, movers, options.lamp_points, most_bytes),
      sides_(device, world, lumels, solver, open, kBackSide, kBackLevels),
      lumel_of_(device, view(lumels_by_side(lumels))),
      near_first_(device, lumels.lumels.size() + 1),
      near_column_(device, 1),
      near_factor_(device, 1),
      crossed_(device, lumels.lumels.size()),
      fresh_(device, lumels.lumels.size()),
      crossing_(device, lumels.lumels.size())
{
    solver.pacer().work("prepare",
                        [&](gpu::Commands& commands) { commands.fill(crossing_.buffer()); });
}

void CrossRedistribution::set_near_field(const NearField& near)
{
    solver_->pacer().finish();
    const NearField rows = rows_of_still(near, *lumels_);
    near_first_.upload(rows.first);
    near_column_ = gpu::Array<std::uint32_t>(*device_, view(rows.column));
    near_factor_ = gpu::Array<float>(*device_, view(rows.factor));
}

void CrossRedistribution::begin(const std::vector<MovedBox>& boxes, bool has_moved,
                                double tolerance)
{
    lamps_.begin(boxes, has_moved, tolerance);
    next_ = 0;
    under_way_ = true;
    if (!lamps_.is_under_way())
        begin_crossing();
}

void CrossRedistribution::begin_crossing()
{
    const auto count = std::uint32_t(lumels_->lumels.size());
    solver_->pacer().work("prepare", [&](gpu::Commands& commands) {
        commands.copy(lamps_.light().buffer(), fresh_.buffer(), count * sizeof(glm::vec3));
        commands.dispatch(
            part_, {.shot = solver_->light().shot, .is_lamp = lamps_.lamps(), .crossed = crossed_},
            CountParams{count}, count);
    });
}

bool CrossRedistribution::step()
{
    if (!under_way_)
        return false;
    if (lamps_.is_under_way()) {
        if (!lamps_.step())
            begin_crossing();
        return true;
    }
    sides_.look_from_fronts(next_);
    gather();
    sides_.look_from_backs({.lumel_of = &lumel_of_,
                            .radiosity = &crossed_,
                            .width = std::uint32_t(lumels_->width),
                            .height = std::uint32_t(lumels_->height)});
    receive();
    hemicubes_ += 2 * std::min<std::uint64_t>(sides_.batch(), sides_.size() - next_);
    next_ += sides_.batch();
    under_way_ = next_ < sides_.listed();
    if (!under_way_) {
        const CountParams params{std::uint32_t(lumels_->lumels.size())};
        solver_->pacer().dispatch("settle", settle_,
                                  {.lumels = world_->lumels(),
                                   .fresh = fresh_,
                                   .crossing = crossing_,
                                   .far = solver_->light().far},
                                  params, params.count);
    }
    return under_way_;
}

void CrossRedistribution::gather()
{
    const PatchShots& shots = solver_->shots();
    const EyeViews& views = shots.views();
    const ShotLight& light = solver_->light();
    const CrossGatherParams params{.views = views.layout(),
                                   .count = std::uint32_t(lumels_->lumels.size()),
                                   .batch = sides_.batch(),
                                   .near_radius = solver_->near_radius()};
    solver_->pacer().work("gather", [&](gpu::Commands& commands) {
        commands.dispatch(gather_,
                          {.views = {views.image(), views.sampler()},
                           .lumels = world_->lumels(),
                           .eyes = shots.eyes(),
                           .shots = shots.shots(),
                           .crossed = crossed_,
                           .fresh = fresh_,
                           .far = light.far},
                          params, std::size_t(sides_.batch()) * kPatchGroup);
        commands.dispatch(send_,
                          {.shots = shots.shots(),
                           .surface = light.surface,
                           .emission = light.emission,
                           .far = light.far,
                           .near = light.near,
                           .shot = light.shot,
                           .crossed = crossed_},
                          TakeParams{sides_.batch()}, sides_.batch());
    });
}

void CrossRedistribution::receive()
{
    const PatchShots& shots = solver_->shots();
    const EyeViews& views = shots.views();
    solver_->pacer().dispatch_parts("cross to lumels", std::uint32_t(lumels_->lumels.size()),
                                    kProbeLumels, receive_,
                                    {.lumels = world_->lumels(),
                                     .pieces = world_->pieces(),
                                     .views = {views.image(), views.sampler()},
                                     .near_first = near_first_,
                                     .near_column = near_column_,
                                     .near_factors = near_factor_,
                                     .eyes = shots.eyes(),
                                     .shots = shots.shots(),
                                     .shot = solver_->light().shot,
                                     .back = sides_.back(),
                                     .fresh = fresh_},
                                    {.views = views.layout(),
                                     .back = sides_.back_layout(),
                                     .shots = sides_.batch(),
                                     .near_radius = solver_->near_radius()});
}

}  // namespace lumel
