#include "links/live/live_links.h"

#include <algorithm>
#include <limits>

#include "atlas/lumels/sides.h"
#include "atlas/near/still_part.h"
#include "base/core/clock.h"
#include "base/core/error.h"
#include "base/core/parallel.h"
#include "scene/sky/sky_file.h"

namespace lumel {
namespace {

/// Lumels between clock checks: of a sweep, about 0.1 ms; of an update after a move, at most 5 ms,
/// if all are on the object.
constexpr std::size_t kSweptPerStep = 4096, kPiece = 256;

/// After this fraction of all links is retraced, a sweep runs before the rest.
constexpr double kWorthASweep = 0.01;

using Groups = std::vector<std::vector<std::uint32_t>>;

Groups instances_of(const Scene& scene, const std::vector<std::string>& things,
                    const Groups& groups)
{
    Groups result;
    for (const std::string& name : things) {
        find_instance(scene, name);  // or it throws
        std::vector<std::uint32_t>& instances = result.emplace_back();
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].name == name)
                instances.push_back(i);
    }
    result.insert(result.end(), groups.begin(), groups.end());
    return result;
}

/// Index of the first element of that name, or the number of elements.
template <class Named>
std::uint32_t index_of(const std::vector<Named>& all, const std::string& name)
{
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
    return std::uint32_t(found - all.begin());
}

std::vector<std::vector<std::uint32_t>> lumels_by_thing(const Lumels& lumels,
                                                        const DynamicRayScene& rays)
{
    std::vector<std::vector<std::uint32_t>> result(rays.things());
    for (std::uint32_t i = 0; i < lumels.lumels.size(); ++i)
        if (const std::uint32_t t = rays.object_of(lumels.lumels[i].instance);
            t != DynamicRayScene::kStatic)
            result[t].push_back(i);
    return result;
}

std::vector<glm::mat4> transforms_of(const Scene& scene)
{
    std::vector<glm::mat4> result;
    for (const Instance& instance : scene.instances)
        result.push_back(instance.transform);
    return result;
}

void check_factor(const glm::vec3& factor)
{
    if (!(factor.x >= 0.0f && factor.y >= 0.0f && factor.z >= 0.0f))
        throw Error(ErrorKind::input, "factor", "must not be negative");
}

/// Calls edit(index) for each element of that name. Returns false if there is none.
template <class All, class Edit>
bool edit_named(const All& all, const std::string& name, const Edit& edit)
{
    bool found = false;
    for (std::uint32_t i = 0; i < all.size(); ++i)
        if (all[i].name == name) {
            edit(i);
            found = true;
        }
    return found;
}

template <class All>
void check_index(std::uint32_t index, const All& all, const std::string& what)
{
    if (index >= all.size())
        throw Error(ErrorKind::input, what + " " + std::to_string(index), "is not in the scene");
}

}  // namespace

std::unique_ptr<SolveScene> lay_out(Scene scene, const AtlasOptions& options,
                                    const std::vector<std::string>& things)
{
    std::vector<std::uint32_t> movers;
    for (const std::vector<std::uint32_t>& instances : instances_of(scene, things, {}))
        movers.insert(movers.end(), instances.begin(), instances.end());
    return lay_out_movers(std::move(scene), options, movers);
}

LiveLinks::LiveLinks(std::unique_ptr<SolveScene> of, const LiveLinksOptions& options)
    : options_(options),
      scene_(std::move(of)),
      given_(transforms_of(scene())),
      rays_(*scene_, instances_of(scene(), options.things, options.groups)),
      world_(scene(), rays_.still(), lumels()),
      starts_(world_, nullptr, false),
      given_sky_(scene().sky),
      sources_(scene(), scene_->surfaces, scene_->extent()),
      lumels_of_(lumels_by_thing(lumels(), rays_)),
      links_(place(), side_of_rays(options.rays), options.seed),
      light_(place(), options.light),
      sweeps_(links_),
      paint_(lumels()),
      filter_(place(), links_),
      motions_(rays_.things(), glm::mat4(1.0f)),
      requested_(rays_.things())
{
}

LinkContext LiveLinks::place() const
{
    if (rays_.still().parts() == 0)
        throw Error(ErrorKind::input, scene().path, "has no static geometry");
    return {*scene_, rays_, world_, starts_, sources_};
}

void LiveLinks::note_edit()
{
    edited_ = true;
    baked_.reset();
}

void LiveLinks::set_lamp(const std::string& name, const glm::vec3& factor)
{
    const bool has_light =
        edit_named(scene().lights, name, [&](std::uint32_t l) { set_light(l, factor); });
    const bool has_material =
        edit_named(scene().materials, name, [&](std::uint32_t m) { set_emission(m, factor); });
    if (!has_light && !has_material)
        throw Error(ErrorKind::input, scene().path,
                    "has no light and no material named \"" + name + "\"");
}

void LiveLinks::set_light(std::uint32_t light, const glm::vec3& factor)
{
    check_index(light, scene().lights, "light");
    check_factor(factor);
    if (light_.set_factor(Part::light, light, factor))
        note_edit();
}

void LiveLinks::set_emission(std::uint32_t material, const glm::vec3& factor)
{
    check_index(material, scene().materials, "material");
    check_factor(factor);
    if (light_.set_factor(Part::material, material, factor))
        note_edit();
}

void LiveLinks::set_sky(const glm::vec3& factor)
{
    check_factor(factor);
    if (scene().sky.empty())
        throw Error(ErrorKind::input, scene().path, "has no sky");
    if (factor == sky_factor_)
        return;
    sky_factor_ = factor;
    light_.set_factor(Part::sky, 0, factor);
    note_edit();
}

void LiveLinks::turn_sky(double angle)
{
    if (given_sky_.empty())
        throw Error(ErrorKind::input, scene().path, "has no sky");
    place_sky(angle);
}

void LiveLinks::replace_sky(Sky sky, double angle)
{
    if (given_sky_.empty() || sky.empty())
        throw Error(ErrorKind::input, scene().path, "has no sky");
    given_sky_ = std::move(sky);
    place_sky(angle);
}

void LiveLinks::place_sky(double angle)
{
    scene_->scene.sky = angle != 0.0 ? turned(given_sky_, angle) : given_sky_;
    sources_.find();
    links_.find_sky();
    light_.find_again(Part::sky, 0);
    light_.set_factor(Part::sky, 0, sky_factor_);  // its bright part may be new
    note_edit();
}

void LiveLinks::set_albedo(const std::string& name, const glm::vec3& colour)
{
    const std::uint32_t material = index_of(scene().materials, name);
    if (material == scene().materials.size())
        throw Error(ErrorKind::input, scene().path, "has no material named \"" + name + "\"");
    set_albedo(material, colour);
}

void LiveLinks::set_albedo(std::uint32_t material, const glm::vec3& colour)
{
    check_index(material, scene().materials, "material");
    if (glm::clamp(colour, 0.0f, 1.0f) != colour)
        throw Error(ErrorKind::input, "colour of \"" + scene().materials[material].name + "\"",
                    "must be from 0 to 1");
    paint_.set(scene(), atlas(), int(material), colour);
    note_edit();
}

void LiveLinks::move_lamp(const std::string& name, const glm::mat4& transform)
{
    if (!edit_named(scene().lights, name, [&](std::uint32_t l) { move_light(l, transform); }))
        throw Error(ErrorKind::input, scene().path, "has no light named \"" + name + "\"");
}

void LiveLinks::move_light(std::uint32_t light, const glm::mat4& transform)
{
    check_index(light, scene().lights, "light");
    scene_->scene.lights[light].transform = transform;
    sources_.place();
    light_.find_again(Part::light, light);
    note_edit();
}

std::uint32_t LiveLinks::thing(const std::string& name) const
{
    const auto found = std::find(options_.things.begin(), options_.things.end(), name);
    if (found == options_.things.end())
        throw Error(ErrorKind::input, "\"" + name + "\"", "is not a movable object");
    return std::uint32_t(found - options_.things.begin());
}

/// Transforms start from those of the given scene, so that rounding does not accumulate.
void LiveLinks::put(std::uint32_t thing, const glm::mat4& motion)
{
    motions_[thing] = motion;
    for (const std::uint32_t instance : rays_.instances(thing))
        scene_->scene.instances[instance].transform = motion * given_[instance];
    rays_.place(thing);
    world_.place(scene(), lumels(), lumels_of_[thing]);
}

Moved LiveLinks::move(const std::string& name, const glm::mat4& motion)
{
    const Moved before = state_.found;
    request(thing(name), motion);
    while (is_under_way())
        if (PendingMove* one = with_direct())
            follow_direct(*one);
        else if (is_requested())
            put_requested();
        else
            follow_links();
    const Moved& now = state_.found;
    return {.links = {now.links.started - before.links.started,
                      now.links.ended - before.links.ended,
                      now.links.crossed - before.links.crossed},
            .direct = now.direct - before.direct};
}

void LiveLinks::request(std::uint32_t thing, const glm::mat4& motion)
{
    check_index(thing, motions_, "thing");
    if (!is_rigid(glm::mat4(1.0f), motion))
        throw Error(ErrorKind::input,
                    "\"" + scene().instances[rays_.instances(thing).front()].name + "\"",
                    "would be stretched by its motion");
    requested_[thing].reset();
    if (motion == motions_[thing])
        return;
    requested_[thing] = motion;
    baked_.reset();
}

bool LiveLinks::is_requested() const
{
    return std::any_of(requested_.begin(), requested_.end(),
                       [](const std::optional<glm::mat4>& motion) { return motion.has_value(); });
}

bool LiveLinks::is_under_way() const
{
    return !following_.empty() || is_requested();
}

/// Places all objects first: rays retraced for one then hit the others at their new positions.
void LiveLinks::put_requested()
{
    for (std::uint32_t t = 0; t < requested_.size(); ++t)
        if (requested_[t]) {
            following_.erase(std::remove_if(following_.begin(), following_.end(),
                                            [&](const PendingMove& one) { return one.thing == t; }),
                             following_.end());
            following_.push_back({.thing = t, .before = rays_.box(t)});
            put(t, *requested_[t]);
            following_.back().order = follow_order(world_, lumels_of_[t], rays_.box(t));
            requested_[t].reset();
        }
    sources_.place();
    light_.place();
}

/// The first move whose direct light is not updated for all lumels.
LiveLinks::PendingMove* LiveLinks::with_direct()
{
    const auto found =
        std::find_if(following_.begin(), following_.end(),
                     [&](const PendingMove& one) { return one.direct < lumels().lumels.size(); });
    return found == following_.end() ? nullptr : &*found;
}

/// Updates a piece of the changed direct light.
void LiveLinks::follow_direct(PendingMove& one)
{
    const std::size_t count = lumels().lumels.size();
    const std::size_t end = std::min(one.direct + kPiece, count);
    const double all = double(count * std::max<std::size_t>(light_.groups(), 1));
    state_.found.direct += double(light_.follow(one.thing, one.before, one.direct, end)) / all;
    one.direct = end;
    edited_ |= with_direct() == nullptr;
}

/// True if lumels on and around the object are not updated yet. They are updated before further
/// moves, so that an object in constant motion still has correct light around it.
bool LiveLinks::has_near_to_follow(const PendingMove& one)
{
    return one.links < one.order.near;
}

/// Updates a piece of the changed links. Runs a sweep after a distance band in which many changed.
void LiveLinks::follow_links()
{
    const auto next = std::find_if(following_.begin(), following_.end(), has_near_to_follow);
    PendingMove& one = next != following_.end() ? *next : following_.front();
    const std::size_t end = std::min(one.links + kPiece, one.order.end_after(one.links));
    const Retraced found =
        links_.follow(one.thing, std::span(one.order.lumels).subspan(one.links, end - one.links));
    state_.found.links += found;
    unseen_ += found.all();
    one.links = end;
    const double all = double(lumels().lumels.size() * links_.rays());
    edited_ |= one.order.ends_at(end) && double(unseen_) > kWorthASweep * all;
    if (end < one.order.lumels.size())
        return;
    following_.erase(following_.begin() + (&one - following_.data()));
    edited_ |= following_.empty();
}

std::vector<glm::vec3> LiveLinks::direct()
{
    std::vector<glm::vec3> light = light_.sum();
    if (!scene().sky.empty())
        for (std::size_t i = 0; i < light.size(); ++i)
            light[i] += sky_factor_ * links_.sky_light()[i];
    return light;
}

void LiveLinks::begin()
{
    if (!scene().sky.empty()) {
        sky_light_ = links_.sky_light();
        for (glm::vec3& light : sky_light_)
            light *= sky_factor_;
    }
    sweeps_.begin(direct(), paint_.albedo());
    weighing_ = false;
    swept_ = false;
    unseen_ = 0;
    state_ = {.found = state_.found, .all_sweeps = state_.all_sweeps};
    edited_ = false;
}

/// Runs a piece of the pending work. Results are shown before objects move again, and near links
/// are updated first.
void LiveLinks::work()
{
    if (PendingMove* one = with_direct())
        follow_direct(*one);
    else if (edited_ || !swept_)
        sweep();
    else if (is_requested() &&
             std::none_of(following_.begin(), following_.end(), has_near_to_follow))
        put_requested();
    else if (!following_.empty())
        follow_links();
    else if (!weighing_)
        sweep();
    else if (filter_.step()) {
        weighing_ = false;
        state_.at_rest = true;
    }
}

/// Runs part of a sweep.
void LiveLinks::sweep()
{
    if (edited_)
        begin();
    if (!sweeps_.step(kSweptPerStep))
        return;
    swept_ = true;
    ++state_.all_sweeps;
    const bool still = is_at_rest();
    state_.at_rest = still && !options_.filter;
    weighing_ = still && options_.filter;
    if (weighing_)
        filter_.begin(sweeps_, sky_factor_);
}

LiveLinksState LiveLinks::advance(double budget_ms)
{
    const Clock::time_point start = Clock::now();
    while (edited_ || is_under_way() || !state_.at_rest) {
        work();
        if (!(ms_since(start) < budget_ms))
            break;
    }
    state_.under_way = is_under_way();
    state_.weighing = weighing_ && !edited_;
    state_.at_rest = state_.at_rest && !edited_ && !state_.under_way;
    return state_;
}

/// Call after a complete sweep.
bool LiveLinks::is_at_rest()
{
    const StillToCome now = sweeps_.still_to_come();
    state_.residual = now.all;
    state_.dark_residual = now.dark;
    state_.sweeps = sweeps_.sweeps();
    return sweeps_.rests(options_.residual);
}

LiveLinksState LiveLinks::settle()
{
    return advance(std::numeric_limits<double>::infinity());
}

std::uint64_t LiveLinks::bytes() const
{
    return links_.bytes() + light_.bytes() + sweeps_.bytes() + filter_.bytes() +
           sky_light_.size() * sizeof(glm::vec3);
}

StandingScene LiveLinks::standing() const
{
    StandingScene standing{scene(), atlas()};
    Scene& now = standing.scene;
    paint_.paint(now.materials);
    for (std::uint32_t m = 0; m < now.materials.size(); ++m)
        now.materials[m].emitted *= light_.factor(Part::material, m);
    for (std::uint32_t l = 0; l < now.lights.size(); ++l)
        now.lights[l].color *= light_.factor(Part::light, l);
    for (glm::vec3& radiance : now.sky.radiance)
        radiance *= sky_factor_;
    return standing;
}

Lumels LiveLinks::shown_lumels() const
{
    return baked_ ? with_buried(lumels(), baked_->buried) : lumels();
}

std::vector<glm::vec3> LiveLinks::shown() const
{
    if (baked_)
        return baked_->irradiance;
    std::vector<glm::vec3> result(lumels().lumels.size());
    parallel_for(result.size(), kSweptPerStep, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            result[i] = filter_.irradiance(sweeps_, sky_light_, i);
    });
    return result;
}

std::vector<float> LiveLinks::error_estimate() const
{
    if (baked_)
        return baked_->error_estimate;
    const auto to_come = edited_ ? 1.0f : float(std::max(state_.residual, state_.dark_residual));
    std::vector<float> result(lumels().lumels.size());
    parallel_for(result.size(), kSweptPerStep, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            result[i] = std::min(filter_.noise(sweeps_, sky_light_, i) + to_come, 1.0f);
    });
    return result;
}

std::vector<glm::vec3> LiveLinks::irradiance() const
{
    std::vector<glm::vec3> result(lumels().lumels.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = sweeps_.irradiance(i);
    return result;
}

}  // namespace lumel
