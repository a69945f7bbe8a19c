// Patches that shoot after a redistribution.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 3.2 and 4.4.1.
//
// Differs from the thesis:
// - Patches are chosen one by one, by their own light, where the progressive pass shoots whole
//   charts: a move changes the light of a few.
// - The thesis merges this pass with the redistribution, so that a patch renders once for both.
//   Here visibility is stored (visibility_rows.h), and this pass renders nothing.

#include "methods/redistribution/remaining_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/core/luminance.h"

namespace lumel {
namespace {

/// Patches that must shoot in the same batch: all points of a lumel, or one block.
struct Unit {
    ChosenPatch first;
    std::uint32_t patches;
    double power;  ///< Σ A |𝓛(B^u)| [lm]
};

struct Choice {
    std::vector<Unit> units;
    double total = 0.0;        ///< [lm]
    double unreachable = 0.0;  ///< light of charts without a level [lm]
};

/// A |𝓛(B^u)| of each lumel [lm].
std::vector<double> unshot_power(const ShotLight& light)
{
    const std::vector<glm::vec4> surface = light.surface.download();
    const std::vector<glm::vec3> emission = light.emission.download();
    const std::vector<glm::vec3> far = light.far.download(), near = light.near.download();
    const std::vector<glm::vec3> shot = light.shot.download();
    std::vector<double> power;
    for (std::size_t i = 0; i < shot.size(); ++i) {
        const glm::vec3 unshot = emission[i] + glm::vec3(surface[i]) * (far[i] + near[i]) - shot[i];
        power.push_back(double(surface[i].a) * std::abs(double(luminance(unshot))));
    }
    return power;
}

Choice all_units(const Patches& layout, const std::vector<std::uint32_t>& levels,
                 const std::vector<double>& power)
{
    Choice all;
    for (std::uint32_t c = 0; c < levels.size(); ++c) {
        const PatchChart& chart = layout.charts[c];
        if (chart.moving != 0)
            continue;
        double of_chart = 0.0;
        for (std::uint32_t i = 0; i < chart.lumel_count; ++i)
            of_chart += power[chart.first_lumel + i];
        all.total += of_chart;
        if (levels[c] == kNoLevel) {
            all.unreachable += of_chart;
            continue;
        }
        const std::uint32_t together = points_per_lumel(levels[c]);
        for (std::uint32_t index = 0; index < patches_of(chart, levels[c]); index += together) {
            const ChosenPatch first{c, levels[c], index, kSendUnshot};
            const Patch patch = patch_of(layout, first);
            double of_patch = 0.0;
            for (std::uint32_t j = patch.first; j < patch.first + patch.count; ++j)
                of_patch += power[j];
            all.units.push_back({first, together, of_patch});
        }
    }
    return all;
}

/// Units with the most light per hemicube, until at most `left` [lm] is outside them.
std::vector<Unit> brightest(Choice all, double left)
{
    std::vector<Unit>& units = all.units;
    std::stable_sort(units.begin(), units.end(), [](const Unit& a, const Unit& b) {
        return a.power / a.patches > b.power / b.patches;
    });
    double outside = all.total;
    std::size_t count = 0;
    while (count < units.size() && outside > left && units[count].power > 0.0)
        outside -= units[count++].power;
    units.resize(count);
    return std::move(units);
}

/// Concatenates units, none of them across the end of a batch.
std::vector<ChosenPatch> in_batches(std::vector<Unit> units, std::uint32_t batch)
{
    std::stable_sort(units.begin(), units.end(),
                     [](const Unit& a, const Unit& b) { return a.patches > b.patches; });
    std::vector<ChosenPatch> list;
    for (const Unit& unit : units) {
        while (list.size() % batch + unit.patches > batch)
            list.push_back({kNoPatch, 0, 0, kSendUnshot});
        for (std::uint32_t p = 0; p < unit.patches; ++p) {
            list.push_back(unit.first);
            list.back().index += p;
        }
    }
    return list;
}

}  // namespace

RemainingLight::RemainingLight(ProgressiveRadiosity& solver, VisibilityRows& rows)
    : solver_(&solver),
      rows_(&rows)
{
}

bool RemainingLight::begin(double left)
{
    solver_->pacer().finish();
    lists_.clear();
    at_ = 0;
    next_ = 0;
    const std::vector<std::uint32_t> levels = solver_->shots().levels().download();
    rows_->follow(levels);
    Choice all = all_units(solver_->shots().layout(), levels, unshot_power(solver_->light()));
    const double allowed = left * all.total;
    if (all.unreachable > allowed)
        return false;
    std::array<std::vector<Unit>, 3> parts;  // visibility stored, to be stored, without rows
    for (const Unit& unit : brightest(std::move(all), allowed)) {
        bool known = true;
        ChosenPatch patch = unit.first;
        for (std::uint32_t p = 0; p < unit.patches; ++p, ++patch.index)
            known = known && rows_->knows(patch);
        parts[known ? 0 : rows_->row_of(unit.first) != kNoRow ? 1 : 2].push_back(unit);
    }
    for (std::vector<Unit>& part : parts)
        if (!part.empty())
            lists_.push_back(rows_->list_of(in_batches(std::move(part), solver_->shots().batch())));
    return is_under_way();
}

void RemainingLight::step()
{
    const ShotList& list = lists_[at_];
    PatchShots& shots = solver_->shots();
    solver_->pacer().work("take", [&](gpu::Commands& commands) {
        shots.take(commands, solver_->light(), list.chosen, next_);
    });
    const ChosenPatch& first = list.patches[next_];
    if (!rows_->knows(first)) {
        shots.look(solver_->pacer());
        hemicubes_ += shots.batch();
        rows_->record(list, next_);
    }
    if (rows_->knows(first))
        rows_->shoot(list, next_, 1.0f);
    else
        solver_->receive();
    solver_->settle();
    next_ += shots.batch();
    if (next_ >= list.patches.size()) {
        next_ = 0;
        ++at_;
    }
}

}  // namespace lumel
