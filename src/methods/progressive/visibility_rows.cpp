#include "methods/progressive/visibility_rows.h"

#include <algorithm>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Storage grows by this number of words per lumel.
constexpr std::uint32_t kWordsAtATime = 16;

}  // namespace

VisibilityRows::VisibilityRows(const gpu::Device& device, const World& world,
                               ProgressiveRadiosity& solver, Projection projection,
                               std::uint64_t most_bytes)
    : device_(&device),
      world_(&world),
      solver_(&solver),
      most_bytes_(std::min(most_bytes, device.max_array_bytes())),
      count_(std::uint32_t(world.lumels().size())),
      record_(device, std::uint32_t(projection)),
      shoot_(device, std::uint32_t(projection)),
      seen_(device, 0),
      charts_(solver.shots().layout().charts.size())
{
}

void VisibilityRows::follow(std::span<const std::uint32_t> levels)
{
    const Patches& layout = solver_->shots().layout();
    for (std::size_t c = 0; c < charts_.size(); ++c) {
        if (levels[c] == charts_[c].level || levels[c] == kNoLevel)
            continue;
        const std::uint32_t patches = patches_of(layout.charts[c], levels[c]);
        const std::uint64_t words = (rows_ + patches + kRowsInAWord - 1) / kRowsInAWord;
        const bool fits = words <= most_words();
        charts_[c] = {levels[c], fits ? rows_ : kNoRow, std::vector<char>(patches)};
        rows_ += fits ? patches : 0;
    }
    make_room(rows_);
}

/// Maximum words per lumel, for all its rows.
std::uint32_t VisibilityRows::most_words() const
{
    const std::uint64_t words = most_bytes_ / (std::uint64_t(count_) * sizeof(std::uint32_t));
    return std::uint32_t(std::min<std::uint64_t>(words, kNoRow / kRowsInAWord));
}

void VisibilityRows::make_room(std::uint32_t rows)
{
    const std::uint32_t words = (rows + kRowsInAWord - 1) / kRowsInAWord;
    if (std::size_t(words) * count_ <= seen_.size())
        return;
    const std::uint32_t enough =
        std::min((words + kWordsAtATime - 1) / kWordsAtATime * kWordsAtATime, most_words());
    gpu::Array<std::uint32_t> larger(*device_, std::size_t(enough) * count_);
    gpu::Pacer& pacer = solver_->pacer();
    pacer.work("prepare", [&](gpu::Commands& commands) {
        commands.fill(larger.buffer());
        if (seen_.size() > 0)
            commands.copy(seen_.buffer(), larger.buffer(), seen_.size() * sizeof(std::uint32_t));
    });
    pacer.finish();
    seen_ = std::move(larger);
}

std::uint32_t VisibilityRows::row_of(const ChosenPatch& patch) const
{
    if (patch.chart == kNoPatch)
        return kNoRow;
    const ChartRows& chart = charts_[patch.chart];
    return chart.level == patch.level && chart.first != kNoRow ? chart.first + patch.index : kNoRow;
}

bool VisibilityRows::knows(const ChosenPatch& patch) const
{
    return row_of(patch) != kNoRow && charts_[patch.chart].known[patch.index] != 0;
}

void VisibilityRows::forget(const ChosenPatch& patch)
{
    if (row_of(patch) != kNoRow)
        charts_[patch.chart].known[patch.index] = 0;
}

ShotList VisibilityRows::list_of(std::vector<ChosenPatch> patches) const
{
    if (!patches.empty())
        patches = in_whole_batches(std::move(patches), solver_->shots().batch());
    std::vector<std::uint32_t> rows;
    for (const ChosenPatch& patch : patches)
        rows.push_back(row_of(patch));
    gpu::Array<ChosenPatch> chosen(*device_, view(patches));
    return {std::move(patches), std::move(chosen), gpu::Array<std::uint32_t>(*device_, view(rows))};
}

RowsBatch VisibilityRows::batch(std::uint32_t first, float sign) const
{
    return {.views = solver_->shots().views().layout(),
            .count = count_,
            .shots = solver_->shots().batch(),
            .first_place = first,
            .near_radius = solver_->near_radius(),
            .sign_factor = sign};
}

void VisibilityRows::record(const ShotList& list, std::uint32_t first)
{
    const PatchShots& shots = solver_->shots();
    solver_->pacer().dispatch_parts("record visibility", count_, kProbeLumels, record_,
                                    {.lumels = world_->lumels(),
                                     .pieces = world_->pieces(),
                                     .views = {shots.views().image(), shots.views().sampler()},
                                     .eyes = shots.eyes(),
                                     .shots = shots.shots(),
                                     .row_of = list.rows,
                                     .seen = seen_},
                                    {.batch = batch(first, 0.0f)});
    const std::size_t last = std::min<std::size_t>(first + shots.batch(), list.patches.size());
    for (std::size_t i = first; i < last; ++i)
        if (row_of(list.patches[i]) != kNoRow)
            charts_[list.patches[i].chart].known[list.patches[i].index] = 1;
}

void VisibilityRows::shoot(const ShotList& list, std::uint32_t first, float sign)
{
    const PatchShots& shots = solver_->shots();
    solver_->pacer().dispatch_parts("shoot by visibility", count_, kProbeLumels, shoot_,
                                    {.lumels = world_->lumels(),
                                     .pieces = world_->pieces(),
                                     .eyes = shots.eyes(),
                                     .shots = shots.shots(),
                                     .sending = shots.sending(),
                                     .row_of = list.rows,
                                     .seen = seen_,
                                     .far = solver_->light().far},
                                    {.batch = batch(first, sign)});
}

}  // namespace lumel
