// Shoots light of lamps past movable objects.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 3.2, 4.4 and 4.5.2.
//
// Cross projection sees a lamp through a small hemicube on the back of each moving patch, and the
// thesis names the undersampling of small lamps as its main artefact (sections 4.5.2, 5.2.1). Here
// the patches of lamps send their light past movable objects, as in incremental radiosity: R(C, M),
// and R(C, C) for lamps alone. The rest, which is distributed smoothly, is crossed.
//
// Without movable objects a lamp's views never change: its rows are stored. While objects rest and
// lamps hardly change, earlier results are reused.

#include "methods/redistribution/lamp_shadows.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/core/box.h"
#include "base/core/luminance.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Minimum number of points whose shadows' edges follow each other within a lumel.
constexpr double kEdgesPerLumel = 2.0;

/// Side of a square lumel of the mean area [m].
double mean_side(const Lumels& lumels)
{
    double area = 0.0;
    for (const Lumel& lumel : lumels.lumels)
        area += double(lumel.area);
    return std::sqrt(area / double(std::max<std::size_t>(lumels.lumels.size(), 1)));
}

/// Distance from a point to a box, 0 inside [m].
double distance_to(const MovedBox& box, const glm::vec3& x)
{
    return double(glm::length(glm::max(glm::max(box.low - x, x - box.high), glm::vec3(0.0f))));
}

std::vector<std::uint32_t> lumels_of_lamps(const Patches& layout, const Lumels& lumels)
{
    std::vector<std::uint32_t> flags(lumels.lumels.size(), 0);
    for (const PatchChart& chart : layout.charts) {
        const auto first = lumels.lumels.begin() + chart.first_lumel;
        const bool shines = std::any_of(first, first + chart.lumel_count, [](const Lumel& lumel) {
            return lumel.emission != glm::vec3(0.0f);
        });
        if (shines && chart.moving == 0)
            std::fill_n(flags.begin() + chart.first_lumel, chart.lumel_count, 1u);
    }
    return flags;
}

/// Relative change of the lamps' light.
double change(const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& now,
              const std::vector<std::uint32_t>& is_lamp)
{
    double change = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!is_lamp[i])
            continue;
        change += luminance(glm::abs(now[i] - before[i]));
        sum += luminance(now[i]);
    }
    return sum > 0.0 ? change / sum : change;
}

}  // namespace

double lamp_points(std::span<const Lumel> lamp, const std::vector<MovedBox>& boxes,
                   const Box& world, double side, double most)
{
    double area = 0.0, steepest = 0.0;
    for (const Lumel& lumel : lamp) {
        area += double(lumel.area);
        const glm::vec3 corner =
            glm::max(glm::abs(world.low - lumel.position), glm::abs(world.high - lumel.position));
        const double b = double(glm::length(corner));
        for (const MovedBox& box : boxes)
            steepest =
                std::max(steepest, b / std::max(distance_to(box, lumel.position), side) - 1.0);
    }
    const double across = kEdgesPerLumel * std::sqrt(area) * steepest / side;
    return std::clamp(across * across, 1.0, most);
}

LampShadows::LampShadows(const gpu::Device& device, World& world, const Lumels& lumels,
                         ProgressiveRadiosity& solver, std::vector<char> movers,
                         std::uint32_t most_points, std::uint64_t most_bytes)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      solver_(&solver),
      rows_(device, world, solver, solver.shots().views().projection(), most_bytes),
      movers_(std::move(movers)),
      lamp_of_(lumels_of_lamps(solver.shots().layout(), lumels)),
      pairs_(device, solver, movers_.size()),
      is_lamp_(device, view(lamp_of_)),
      light_(device, lumels.lumels.size()),
      side_(mean_side(lumels)),
      most_points_(most_points),
      least_(solver.shots().layout().charts.size(), 0)
{
    pairs_.moved.upload(words_of(movers_));
}

void LampShadows::begin(const std::vector<MovedBox>& boxes, bool has_moved, double tolerance)
{
    gpu::Pacer& pacer = solver_->pacer();
    pacer.finish();
    std::vector<glm::vec3> shot = solver_->light().shot.download();
    if (!has_moved && !shot_.empty() && change(shot_, shot, lamp_of_) <= tolerance)
        return;
    shot_ = std::move(shot);
    const Move around{.moved = words_of(movers_), .transforms = {}, .boxes = boxes};
    pairs_.boxes = gpu::Array<MovedBox>(*device_, view(boxes));
    pacer.work("prepare", [&](gpu::Commands& commands) { commands.fill(light_.buffer()); });
    list_ = rows_.list_of(patches_to_shoot(around));
    next_ = 0;
    if (list_->empty())
        list_.reset();
}

/// [C] Level at which each lamp's chart shoots here; kNoLevel: not a lamp. It can differ from the
/// level shot at before, as results do not accumulate over moves. A level that an earlier move
/// needed is kept, with its rows.
std::vector<std::uint32_t> LampShadows::levels(const std::vector<MovedBox>& boxes)
{
    const Patches& layout = solver_->shots().layout();
    std::vector<std::uint32_t> levels = solver_->shots().levels().download();
    for (std::uint32_t c = 0; c < levels.size(); ++c) {
        const PatchChart& chart = layout.charts[c];
        if (!lamp_of_[chart.first_lumel])
            levels[c] = kNoLevel;
        if (levels[c] == kNoLevel)
            continue;
        const auto first = lumels_->lumels.begin() + chart.first_lumel;
        std::vector<Lumel> lamp(first, first + chart.lumel_count);
        const glm::mat4& place = world_->placements()[lamp.front().instance].now;
        for (Lumel& lumel : lamp)
            lumel.position = glm::vec3(place * glm::vec4(lumel.position, 1.0f));
        const double points =
            lamp_points(lamp, boxes, {world_->low(), world_->high()}, side_, most_points_);
        while (levels[c] > least_[c] && double(patches_of(chart, levels[c] - 1)) >= points)
            --levels[c];
        least_[c] = levels[c];
    }
    return levels;
}

std::vector<ChosenPatch> LampShadows::patches_to_shoot(const Move& around)
{
    const Patches& layout = solver_->shots().layout();
    const std::vector<std::uint32_t> levels = this->levels(around.boxes);
    std::vector<glm::mat4> places;
    for (const Placement& placement : world_->placements())
        places.push_back(placement.now);
    const float slack = edge_slack(solver_->shots().views().layout());
    rows_.follow(levels);
    std::vector<ChosenPatch> list;
    for (std::uint32_t c = 0; c < levels.size(); ++c) {
        if (levels[c] == kNoLevel)
            continue;
        for (std::uint32_t index = 0; index < patches_of(layout.charts[c], levels[c]); ++index) {
            const ChosenPatch chosen{c, levels[c], index, kSendShot};
            if (may_see(around, *lumels_, places, patch_of(layout, chosen), slack))
                list.push_back(chosen);
        }
    }
    return list;
}

void LampShadows::look(bool shows_movers)
{
    world_->show_movers(shows_movers);
    solver_->shots().look(solver_->pacer());
    hemicubes_ += solver_->shots().batch();
}

bool LampShadows::step()
{
    if (!is_under_way())
        return false;
    PatchShots& shots = solver_->shots();
    solver_->pacer().work("take", [&](gpu::Commands& commands) {
        shots.take(commands, solver_->light(), list_->chosen, next_);
    });
    const auto first = list_->patches.begin() + next_;
    if (std::any_of(first, first + shots.batch(), [&](const ChosenPatch& patch) {
            return patch.chart != kNoPatch && !rows_.knows(patch);
        })) {
        look(false);
        rows_.record(*list_, next_);
        receive(-1.0f);
    }
    look(true);
    receive(1.0f);
    next_ += shots.batch();
    if (next_ >= list_->patches.size()) {
        solver_->pacer().finish();
        list_.reset();
    }
    return is_under_way();
}

void LampShadows::receive(float sign)
{
    pairs_.receive("lamps to lumels", *world_, *solver_, *list_, next_, sign, rows_, false, light_);
}

}  // namespace lumel
