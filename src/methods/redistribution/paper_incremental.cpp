// Incremental radiosity as in the thesis: merged with a progressive iteration.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Section 4.4, Algorithm 4.3.
//
//     for all patches of M:
//         shoot minus their shot light from the old position     R_p(M, C), first part
//     clear the light of M
//     for all patches of C:
//         render the world before and after the move
//         shoot all light to M                                    R_p(C, M), Eq. (4.4.1)
//         shoot shot, unshot or all light to C by the four cases  R_p(C, C)
//
// R_p(M, M) and the second part of R_p(M, C) follow as progressive iterations: all light of M is
// unshot.
//
// Differs from the thesis:
// - The view before the move is the stored visibility of the patch (visibility_rows.h), if it has
//   any.
// - Patches without it are all taken back before the first of them sends. What these send lacks the
//   light taken back; progressive iterations shoot the rest.
// - Charts that never shot have no patches yet: progressive iterations shoot their light.

#include "methods/redistribution/paper_incremental.h"

#include <algorithm>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Appends all patches of a chart at a level; all points of a lumel are in the same batch.
void append_chart(std::uint32_t chart, std::uint32_t level, std::uint32_t count,
                  std::uint32_t batch, std::vector<ChosenPatch>& list)
{
    const std::uint32_t points = points_per_lumel(level);
    for (std::uint32_t index = 0; index < count; index += points) {
        while (list.size() % batch + points > batch)
            list.push_back({kNoPatch, 0, 0, kSendTotal});
        for (std::uint32_t part = 0; part < points; ++part)
            list.push_back({chart, level, index + part, kSendTotal});
    }
}

std::vector<ChosenPatch> sending_shot(std::vector<ChosenPatch> list)
{
    for (ChosenPatch& patch : list)
        patch.send = kSendShot;
    return list;
}

}  // namespace

PaperIncremental::PaperIncremental(const gpu::Device& device, World& world, const Lumels& lumels,
                                   ProgressiveRadiosity& solver, VisibilityRows& rows)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      solver_(&solver),
      rows_(&rows),
      reset_(device),
      receive_(device, std::uint32_t(solver.shots().views().projection())),
      moved_(device, world.placements().size()),
      shot_before_(device, solver.shots().batch()),
      phases_(rows),
      after_shot_(device, 0)
{
}

bool PaperIncremental::begin(Move move)
{
    solver_->pacer().finish();
    move_ = std::move(move);
    moved_.upload(move_.moved);
    begin_phases();
    if (phases_.phase() == ShotPhases::Phase::after)
        go_after();
    return is_under_way();
}

void PaperIncremental::begin_phases()
{
    const Patches& layout = solver_->shots().layout();
    const std::vector<std::uint32_t> levels = solver_->shots().levels().download();
    rows_->follow(levels);
    std::vector<ChosenPatch> unknown, back, after;
    for (std::uint32_t c = 0; c < levels.size(); ++c) {
        const PatchChart& chart = layout.charts[c];
        const std::uint32_t count = levels[c] == kNoLevel ? 0 : patches_of(chart, levels[c]);
        const bool moves = move_.moved[lumels_->lumels[chart.first_lumel].instance] != 0;
        for (std::uint32_t index = 0; index < count; ++index) {
            const ChosenPatch chosen{c, levels[c], index, kSendShot};
            if (!rows_->knows(chosen))
                unknown.push_back(chosen);
            if (moves && rows_->row_of(chosen) != kNoRow)
                back.push_back(chosen);
        }
        if (!moves)
            append_chart(c, levels[c], count, solver_->shots().batch(), after);
    }
    ShotList after_list = rows_->list_of(std::move(after));
    after_shot_ = gpu::Array<ChosenPatch>(*device_, view(sending_shot(after_list.patches)));
    phases_.begin(rows_->list_of(std::move(unknown)), rows_->list_of(std::move(back)),
                  std::move(after_list));
}

/// Moves the world; what moved has no light then.
void PaperIncremental::go_after()
{
    const auto count = std::uint32_t(world_->lumels().size());
    gpu::Pacer& pacer = solver_->pacer();
    pacer.dispatch("redistribute", reset_,
                   {.lumels = world_->lumels(),
                    .moved = moved_,
                    .far = solver_->light().far,
                    .shot = solver_->light().shot},
                   CountParams{count}, count);
    pacer.finish();
    for (const ChosenPatch& patch : phases_.back().patches)
        rows_->forget(patch);
    world_->place(move_.transforms);
    phases_.end_if_empty();
}

bool PaperIncremental::step()
{
    if (!is_under_way())
        return false;
    PatchShots& shots = solver_->shots();
    gpu::Pacer& pacer = solver_->pacer();
    const ShotList& list = phases_.list();
    const std::uint32_t next = phases_.next();
    const ShotPhases::Phase phase = phases_.phase();
    const bool is_after = phase == ShotPhases::Phase::after;
    pacer.work("redistribute", [&](gpu::Commands& commands) {
        shots.take(commands, solver_->light(), is_after ? after_shot_ : list.chosen, next);
        commands.copy(shots.shots().buffer(), shot_before_.buffer(),
                      shots.batch() * sizeof(PatchShot));
        if (is_after)
            shots.take(commands, solver_->light(), list.chosen, next);
    });
    if (phase == ShotPhases::Phase::back) {
        rows_->shoot(list, next, -1.0f);
    } else {
        shots.look(pacer);
        hemicubes_ += shots.batch();
        if (!is_after)
            rows_->record(list, next);
        receive(!is_after);
        if (is_after)
            solver_->settle();
    }
    if (phases_.pass(shots.batch()))
        go_after();
    return is_under_way();
}

void PaperIncremental::receive(bool takes_back)
{
    const PatchShots& shots = solver_->shots();
    const EyeViews& views = shots.views();
    solver_->pacer().dispatch_parts(
        "redistribute to lumels", std::uint32_t(world_->lumels().size()), kProbeLumels, receive_,
        {.lumels = world_->lumels(),
         .pieces = world_->pieces(),
         .views = {views.image(), views.sampler()},
         .far = solver_->light().far,
         .moved = moved_,
         .shot = solver_->light().shot,
         .shot_before = shot_before_,
         .eyes = shots.eyes(),
         .shots = shots.shots(),
         .sending = shots.sending(),
         .row_of = phases_.list().rows,
         .seen = rows_->seen()},
        {.batch = rows_->batch(phases_.next(), 1.0f), .takes_back = takes_back ? 1u : 0u});
}

}  // namespace lumel
