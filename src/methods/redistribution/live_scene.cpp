#include "methods/redistribution/live_scene.h"

#include <algorithm>
#include <limits>

#include "atlas/near/still_part.h"
#include "base/core/clock.h"
#include "base/core/dispatch.shared.h"
#include "methods/methods.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

gpu::Target image_of(const gpu::Device& device, const Atlas& atlas)
{
    return {device, gpu::Pixel::rgba32, std::uint32_t(atlas.width), std::uint32_t(atlas.height)};
}

/// Batches between readbacks of the residual, each of which waits for the device.
constexpr int kBatchesALook = 8;

/// Below this relative residual, the patches with most unshot light shoot one by one; above it,
/// charts do, and choose their level.
constexpr double kMaxToCorrect = 0.1;
/// Fraction of the allowed residual left outside the chosen patches: their light is reflected in
/// turn.
constexpr double kLeftOutside = 0.5;

Lumels lift_in_place(const Scene& scene, const Atlas& atlas, const std::vector<char>& movers,
                     Redistribution redistribution)
{
    Lumels lumels = make_lumels(scene, atlas, movers);
    if (crosses(redistribution))
        for (Lumel& lumel : lumels.lumels)
            if (movers[lumel.instance])
                lumel.flags |= kLumelMoving;
    return lumels;
}

NearFieldOptions near_field_options(const LiveOptions& options)
{
    return near_field_options(
        SolverOptions{.method = options.solver, .target_error = options.target_error});
}

/// Area of movers relative to all surfaces.
double share_of(const std::vector<char>& movers, const Lumels& lumels)
{
    double moving = 0.0, all = 0.0;
    for (const Lumel& lumel : lumels.lumels) {
        all += double(lumel.area);
        moving += movers[lumel.instance] ? double(lumel.area) : 0.0;
    }
    return moving / all;
}

std::vector<char> open_meshes(const Scene& scene)
{
    std::vector<char> open;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        open.push_back(is_open(scene, i) ? 1 : 0);
    return open;
}

/// If crosses(): near field of static pairs, as if there were no movers.
NearField near_field_of_still(const Scene& scene, const Lumels& lumels,
                              const std::vector<char>& movers, const LiveOptions& options)
{
    if (!crosses(options.redistribution))
        return {};
    const Scene still = without(scene, movers);
    std::vector<char> stays;
    for (const Lumel& lumel : lumels.lumels)
        stays.push_back(!movers[lumel.instance]);
    return build_near_field_among(stays, still, RayScene(still), lumels,
                                  near_field_options(options));
}

/// Near field of all pairs; with cross redistribution, of pairs with movers.
MovingNearField near_field_of_moving(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                                     const std::vector<char>& movers, const LiveOptions& options)
{
    NearFieldOptions near = near_field_options(options);
    if (!crosses(options.redistribution))
        return {scene, rays, lumels, near, movers, NearPairsOf::all};
    near.most_pairs = std::numeric_limits<std::size_t>::max();  // as for static pairs
    return {scene, rays, lumels, near, movers, NearPairsOf::movers};
}

/// Rows of static lumels from `still`, rows of movers from `moving`.
NearField joined(const NearField& still, const NearField& moving, const Lumels& lumels)
{
    NearField rows;
    rows.radius = still.radius;
    rows.first.push_back(0);
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i) {
        const NearField& from = lumels.lumels[i].flags & kLumelMoving ? moving : still;
        rows.column.insert(rows.column.end(), from.column.begin() + from.first[i],
                           from.column.begin() + from.first[i + 1]);
        rows.factor.insert(rows.factor.end(), from.factor.begin() + from.first[i],
                           from.factor.begin() + from.first[i + 1]);
        rows.first.push_back(std::uint32_t(rows.column.size()));
    }
    return rows;
}

}  // namespace

LiveScene::LiveScene(const gpu::Device& device, Scene scene, const LiveOptions& options)
    : device_(&device),
      options_(options),
      scene_(std::move(scene)),
      edits_(scene_, options.movers, options.still),
      atlas_(make_atlas(scene_, options.atlas)),
      lumels_(lift_in_place(scene_, atlas_, edits_.movers(), options.redistribution)),
      rays_(scene_, edits_.movers()),
      still_near_(near_field_of_still(scene_, lumels_, edits_.movers(), options)),
      near_(near_field_of_moving(scene_, rays_, lumels_, edits_.movers(), options)),
      world_(device, scene_, lumels_, &atlas_, edits_.movers()),
      lamps_(scene_, options.lights),
      solver_(device, world_, lumels_,
              crosses(options.redistribution) ? still_near_ : near_.table(), options.solver),
      rows_(device, world_, solver_, options.solver.views.projection, options.visibility_bytes),
      remaining_(solver_, rows_),
      direct_(device, lumels_.lumels.size()),
      shown_(device, lumels_.lumels.size()),
      texels_(device, std::size_t(atlas_.width) * std::size_t(atlas_.height)),
      images_{image_of(device, atlas_), image_of(device, atlas_)},
      show_(device)
{
    solver_.pacer().work("prepare", [&](gpu::Commands& commands) {
        commands.fill(texels_.buffer());
        commands.fill(direct_.buffer());
    });
    if (options.redistribution == Redistribution::cross)
        cross_.emplace(device, world_, lumels_, solver_, edits_.movers(), open_meshes(scene_),
                       options.cross, options.visibility_bytes);
    else if (crosses(options.redistribution))
        paper_cross_.emplace(
            device, scene_, world_, lumels_, solver_, edits_.movers(), open_meshes(scene_),
            options.redistribution == Redistribution::paper_cross ? CrossProjection::whole
                                                                  : CrossProjection::incremental,
            options.reprojects);
    else if (options.redistribution == Redistribution::paper_incremental)
        paper_incremental_.emplace(device, world_, lumels_, solver_, rows_);
    else
        incremental_.emplace(device, world_, lumels_, solver_, rows_);
    moving_share_ = share_of(edits_.movers(), lumels_);
    if (!lamps_.empty()) {
        lamps_.find(device, world_, lumels_);
        upload_surfaces();
    }
    world_.show_movers(!crosses(options_.redistribution));
    show();
}

void LiveScene::move(std::uint32_t instance, const glm::mat4& transform)
{
    edits_.move(scene_, instance, transform);
}

void LiveScene::light_changes()
{
    surfaces_changed_ = true;
    corrects_ = false;
    state_.residual = 1.0;
}

void LiveScene::set_light(std::uint32_t light, const glm::vec3& factor)
{
    lamps_.set_light(light, factor);
    light_changes();
}

void LiveScene::set_sky(const glm::vec3& factor)
{
    lamps_.set_sky(factor);
    light_changes();
}

/// Starts to compute the lamps' light for the current positions.
void LiveScene::begin_lamps()
{
    if (lamps_.empty())
        return;
    world_.show_movers(true);
    lamps_.begin(*device_, world_, lumels_);
}

void LiveScene::upload_surfaces()
{
    Lumels lumels = edits_.scaled(lumels_);
    solver_.pacer().finish();
    // Reflected direct light joins the emission of surfaces: the solver handles no lamps.
    if (const std::vector<glm::vec3> direct = lamps_.irradiance(); !direct.empty()) {
        for (std::size_t i = 0; i < direct.size(); ++i)
            lumels.lumels[i].emission += lumels.lumels[i].albedo * direct[i];
        direct_.upload(direct);
    }
    solver_.light().emission.upload(emission_of(lumels));
    solver_.light().surface.upload(surfaces_of(lumels));
    surfaces_changed_ = false;
}

void LiveScene::set_emission(std::uint32_t instance, const glm::vec3& factor)
{
    edits_.set_emission(instance, factor);
    light_changes();
}

void LiveScene::set_reflectance(std::uint32_t instance, const glm::vec3& factor)
{
    edits_.set_reflectance(instance, factor);
    light_changes();
}

bool LiveScene::is_under_way() const
{
    return lamps_.is_under_way() || is_redistributing();
}

/// Calls `call` with the redistribution that there is.
template <class Scene, class Call>
auto LiveScene::of_redistribution(Scene& scene, const Call& call)
{
    return scene.cross_               ? call(*scene.cross_)
           : scene.paper_cross_       ? call(*scene.paper_cross_)
           : scene.paper_incremental_ ? call(*scene.paper_incremental_)
                                      : call(*scene.incremental_);
}

bool LiveScene::is_redistributing() const
{
    return of_redistribution(*this, [](const auto& now) { return now.is_under_way(); });
}

bool LiveScene::begin_incremental()
{
    return paper_incremental_ ? paper_incremental_->begin(move_) : incremental_->begin(move_);
}

bool LiveScene::is_at_rest() const
{
    return !is_under_way() && !edits_.is_move_requested() && state_.residual <= options_.residual &&
           (!crosses(options_.redistribution) || is_crossed());
}

/// True if the effect of movers is accurate enough. Movers receive their share of unshot light, and
/// occlude about as much as they send on: both are below the allowed residual.
bool LiveScene::is_crossed() const
{
    return crossed_ && 2.0 * moving_share_ * uncrossed_ <= options_.residual;
}

void LiveScene::begin_move()
{
    move_ = {};
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
        Instance& instance = scene_.instances[i];
        const std::optional<glm::mat4> moved = edits_.take_move(scene_, i);
        move_.moved.push_back(moved ? 1 : 0);
        if (moved) {
            const MovedBox before = box_of(scene_, i, instance.transform);
            instance.transform = *moved;
            const MovedBox after = box_of(scene_, i, instance.transform);
            const std::vector<MovedBox> boxes = around(before, after);
            move_.boxes.insert(move_.boxes.end(), boxes.begin(), boxes.end());
        }
        move_.transforms.push_back(instance.transform);
    }
    world_.bound(scene_);
    if (paper_cross_)
        return paper_cross_->begin(move_.transforms, !move_.boxes.empty());
    if (!cross_) {
        if (!move_.boxes.empty() && !begin_incremental())
            end_move();
        return;
    }
    if (!move_.boxes.empty()) {
        world_.place(move_.transforms);
        follow_move();
    }
    if (!move_.boxes.empty() || !knows_crossing_pairs_) {
        solver_.set_near_field(joined(still_near_, near_.table(), lumels_));
        cross_->set_near_field(near_.table());
        knows_crossing_pairs_ = true;
    }
    std::vector<MovedBox> boxes;
    for (std::uint32_t i = 0; i < edits_.movers().size(); ++i)
        if (edits_.movers()[i])
            boxes.push_back(box_of(scene_, i, scene_.instances[i].transform));
    cross_->begin(boxes, !move_.boxes.empty(), options_.residual);
}

/// Updates rays and near pairs, at the cost of the moved instances.
void LiveScene::follow_move()
{
    std::vector<std::uint32_t> moved;
    for (std::uint32_t i = 0; i < move_.moved.size(); ++i)
        if (move_.moved[i])
            moved.push_back(i);
    std::vector<Box> boxes;
    for (const MovedBox& box : move_.boxes)
        boxes.push_back({box.low, box.high});
    rays_.place(moved);
    near_.follow(scene_, rays_, moved, boxes);
}

void LiveScene::end_move()
{
    if (crosses(options_.redistribution)) {
        crossed_ = true;
        uncrossed_ = 0.0;
    } else {
        follow_move();
        solver_.set_near_field(near_.table());
    }
    if (!move_.boxes.empty())
        begin_lamps();
    if (!lamps_.is_under_way())
        settle_move();
}

/// Reads the residual once the lamps' light is known.
void LiveScene::settle_move()
{
    state_.residual = solver_.residual();
    corrects_ = state_.residual <= kMaxToCorrect;
    unseen_ = true;
    remaining_.drop();
}

void LiveScene::work()
{
    if (lamps_.is_under_way()) {
        if (!lamps_.step()) {
            upload_surfaces();
            settle_move();
        }
    } else if (is_redistributing()) {
        if (!of_redistribution(*this, [](auto& now) { return now.step(); }))
            end_move();
    } else if (edits_.is_move_requested() || (crosses(options_.redistribution) && !is_crossed() &&
                                              state_.residual <= options_.residual)) {
        if (unseen_)
            show();  // also shows objects in constant motion
        begin_move();
    } else {
        shoot();
    }
    solver_.pacer().finish();
}

void LiveScene::shoot()
{
    world_.show_movers(!crosses(options_.redistribution));
    if (corrects_ && !remaining_.is_under_way())
        corrects_ = remaining_.begin(kLeftOutside * options_.residual / state_.residual);
    if (!corrects_) {
        crossed_ = false;
        solver_.step();
        if (++batches_ % kBatchesALook == 0)
            state_.residual = solver_.residual();
        return;
    }
    remaining_.step();
    if (!remaining_.is_under_way()) {
        const double before = state_.residual;
        state_.residual = solver_.residual();
        uncrossed_ += before;  // all of it, as a part can have been reflected since
    }
}

LiveState LiveScene::update(double budget_ms)
{
    const Clock::time_point start = Clock::now();
    if (surfaces_changed_)
        upload_surfaces();
    if (!is_at_rest()) {
        do
            work();
        while (!is_at_rest() && ms_since(start) < budget_ms);
        if (!is_under_way())
            show();
    }
    state_.under_way = is_under_way();
    state_.at_rest = is_at_rest();
    state_.hemicubes = solver_.state().shots + remaining_.hemicubes() +
                       of_redistribution(*this, [](const auto& now) { return now.hemicubes(); });
    state_.milliseconds = ms_since(start);
    return state_;
}

LiveState LiveScene::settle()
{
    return update(std::numeric_limits<double>::max());
}

void LiveScene::show()
{
    unseen_ = false;
    gpu::Pacer& pacer = solver_.pacer();
    pacer.work("show", [&](gpu::Commands& commands) {
        const CountParams params{std::uint32_t(lumels_.lumels.size())};
        commands.dispatch(show_,
                          {.lumels = world_.lumels(),
                           .far = solver_.light().far,
                           .near = solver_.light().near,
                           .shown = shown_,
                           .texels = texels_,
                           .direct = direct_},
                          params, params.count);
        shown_image_ = 1 - shown_image_;
        commands.copy(texels_.buffer(), images_[shown_image_]);
    });
    pacer.finish();
}

std::vector<glm::vec3> LiveScene::irradiance() const
{
    return shown_.download();
}

}  // namespace lumel
