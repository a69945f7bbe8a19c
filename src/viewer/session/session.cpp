#include "viewer/session/session.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/core/clock.h"
#include "base/core/error.h"
#include "base/core/log.h"
#include "scene/sky/clear_sky.h"
#include "viewer/session/view.h"

namespace lumel {
namespace {

/// Distance of deleted objects, in diagonals of the scene: far enough to be negligible (a form
/// factor of 1e-6), near enough for floats.
constexpr float kAway = 1000.0f;

std::unique_ptr<SolveScene> laid_out(const Scene& scene, const Animation& animation,
                                     const std::vector<MovableObject>& things, AtlasOptions atlas)
{
    atlas.sides = Sides::brighter;  // the window shows one side per texel
    std::vector<std::uint32_t> movers;
    for (const MovableObject& thing : things)
        movers.insert(movers.end(), thing.instances.begin(), thing.instances.end());
    std::sort(movers.begin(), movers.end());
    return lay_out_movers(at_its_brightest(scene, animation), atlas, movers);
}

LiveLinksOptions live_options(const SessionOptions& options,
                              const std::vector<MovableObject>& things)
{
    LiveLinksOptions live{.rays = options.link_rays, .seed = options.seed};
    for (const MovableObject& thing : things)
        live.groups.push_back(thing.instances);
    live.light.seed = options.seed;
    live.residual = options.residual;
    live.filter = options.filter;
    return live;
}

std::vector<ViewLamp> find_lamps(const Scene& scene)
{
    std::vector<ViewLamp> lamps;
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
        lamps.push_back({.name = scene.lights[l].name, .is_light = true, .index = l});
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
        if (scene.materials[m].emitted != glm::vec3(0.0f))
            lamps.push_back({.name = scene.materials[m].name, .index = m});
    return lamps;
}

/// The options' sun is the last light.
std::optional<std::uint32_t> find_sun(const Scene& scene, const LightOptions& options)
{
    if (options.sun && options.sun->elevation > 0.0)
        return std::uint32_t(scene.lights.size() - 1);
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
        if (scene.lights[l].kind == PunctualLight::Kind::directional)
            return l;
    return std::nullopt;
}

/// Bounds of an object in the scene's current state.
std::pair<glm::vec3, glm::vec3> bounds_of(const Scene& scene, const MovableObject& thing)
{
    auto [low, high] = bounds_of(scene, thing.instances.front());
    for (const std::uint32_t instance : thing.instances) {
        const auto [from, to] = bounds_of(scene, instance);
        low = glm::min(low, from);
        high = glm::max(high, to);
    }
    return {low, high};
}

}  // namespace

ViewSession::ViewSession(const gpu::Device& device, Scene scene, Animation animation,
                         const SessionOptions& options)
    : device_(&device),
      options_(options),
      animation_(std::move(animation)),
      shown_(std::move(scene)),
      things_(find_things(shown_, animation_, options.movable)),
      live_(laid_out(shown_, animation_, things_, options.atlas), live_options(options, things_)),
      near_(live_.scene(), live_.atlas(), live_.lumels()),
      drawn_(live_.atlas()),
      lamps_(find_lamps(live_.scene())),
      played_(shown_.materials.size(), glm::vec3(1.0f)),
      sun_light_(find_sun(shown_, options.lights)),
      camera_(first_view(shown_, options.camera)),
      sun_(options.lights.sun)
{
    for (const Instance& instance : shown_.instances)
        given_.push_back(instance.transform);
    set_time(0.0);
}

void ViewSession::take_camera(int index)
{
    if (index < 0 || std::size_t(index) >= shown_.cameras.size())
        throw Error(
            ErrorKind::input, "",
            fmt::format("there is no camera {}: the scene has {}", index, shown_.cameras.size()));
    camera_.set_view(view_of(shown_.cameras[std::size_t(index)]));
}

void ViewSession::orbit(float around, float over)
{
    const std::optional<Picked> middle = picked_ ? picked_ : seen_at(glm::vec2(0.5f));
    const glm::vec3 pivot = middle ? middle->place : 0.5f * (rays().low() + rays().high());
    camera_.orbit(pivot, around, over);
}

const RayScene& ViewSession::rays()
{
    if (rays_)
        return *rays_;
    std::vector<char> deleted(shown_.instances.size(), 0);
    for (const MovableObject& thing : things_)
        for (const std::uint32_t instance : thing.instances)
            deleted[instance] = thing.deleted;
    std::vector<std::uint32_t> there;
    for (std::uint32_t i = 0; i < shown_.instances.size(); ++i)
        if (!deleted[i])
            there.push_back(i);
    return rays_.emplace(shown_, there);
}

std::optional<std::uint32_t> ViewSession::object_of(std::uint32_t instance) const
{
    for (std::uint32_t t = 0; t < things_.size(); ++t)
        for (const std::uint32_t one : things_[t].instances)
            if (one == instance)
                return t;
    return std::nullopt;
}

/// The surface at a position of the image, (0, 0) at its top left.
std::optional<Picked> ViewSession::seen_at(const glm::vec2& place)
{
    const Ray ray = ray_through(camera_.view(), place);
    RayHit hit;
    if (!rays().closest(ray_out(ray.origin, ray.direction, 0), hit))
        return std::nullopt;
    const Instance& instance = shown_.instances[hit.instance];
    const Mesh& mesh = shown_.meshes[std::size_t(instance.mesh)];
    return Picked{.instance = hit.instance,
                  .material = mesh.primitives[hit.primitive].material,
                  .lumel = near_.lumel(hit),
                  .thing = object_of(hit.instance),
                  .place = ray.origin + hit.distance * ray.direction,
                  .normal = hit.normal,
                  .distance = hit.distance};
}

std::optional<Picked> ViewSession::seen_at(const glm::ivec2& pixel)
{
    return seen_at((glm::vec2(pixel) + 0.5f) / glm::vec2(size()));
}

void ViewSession::set_size(const glm::ivec2& pixels)
{
    options_.width = pixels.x;
    camera_.set_aspect(float(pixels.x) / float(pixels.y));
}

void ViewSession::check_inside(const glm::ivec2& pixel) const
{
    const glm::ivec2 all = size();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= all.x || pixel.y >= all.y)
        throw Error(ErrorKind::input, "",
                    fmt::format("the pixel {},{} is not in the picture, which has {} × {}", pixel.x,
                                pixel.y, all.x, all.y));
}

void ViewSession::pick(const glm::ivec2& pixel)
{
    check_inside(pixel);
    picked_ = seen_at(pixel);
    probe_ = picked_;
    pixel_ = pixel;
}

void ViewSession::unpick()
{
    picked_.reset();
    probe_.reset();
    pixel_.reset();
}

void ViewSession::pick(const std::string& name)
{
    const std::uint32_t instance = find_instance(shown_, name);
    const std::optional<std::uint32_t> thing = object_of(instance);
    if (thing && things_[*thing].deleted)
        throw Error(ErrorKind::input, "", fmt::format("\"{}\" is deleted", name));
    const auto& primitives = shown_.meshes[std::size_t(shown_.instances[instance].mesh)].primitives;
    const auto [low, high] = bounds_of(shown_, instance);
    picked_ = Picked{.instance = instance,
                     .material = primitives.empty() ? 0 : primitives.front().material,
                     .thing = thing,
                     .place = 0.5f * (low + high)};
    pixel_.reset();
    probe_.reset();
}

MovableObject& ViewSession::picked_thing()
{
    if (!picked_)
        throw Error(ErrorKind::input, "", "nothing is picked");
    if (!picked_->thing)
        throw Error(ErrorKind::input, "",
                    fmt::format("\"{0}\" is not movable; add --movable \"{0}\"",
                                shown_.instances[picked_->instance].name));
    return things_[*picked_->thing];
}

/// Applies an object's transform: images show it at once, the light follows.
void ViewSession::put(std::uint32_t number)
{
    const MovableObject& thing = things_[number];
    const glm::mat4 motion = thing.by_hand * thing.animation;
    live_.request(number, thing.deleted ? glm::translate(glm::mat4(1.0f), away()) : motion);
    for (const std::uint32_t instance : thing.instances)
        shown_.instances[instance].transform = motion * given_[instance];
    rays_.reset();
    note_edit();
}

glm::vec3 ViewSession::away()
{
    return {0.0f, -kAway * glm::distance(rays().low(), rays().high()), 0.0f};
}

void ViewSession::move(const glm::vec3& way)
{
    MovableObject& thing = picked_thing();
    thing.by_hand = glm::translate(glm::mat4(1.0f), way) * thing.by_hand;
    picked_->place += way;
    put(*picked_->thing);
}

void ViewSession::turn(float angle)
{
    MovableObject& thing = picked_thing();
    const auto [low, high] = bounds_of(shown_, thing);
    const glm::vec3 middle = 0.5f * (low + high);
    const glm::mat4 turning = glm::translate(
        glm::rotate(glm::translate(glm::mat4(1.0f), middle), angle, glm::vec3(0.0f, 1.0f, 0.0f)),
        -middle);
    thing.by_hand = turning * thing.by_hand;
    picked_->place = glm::vec3(turning * glm::vec4(picked_->place, 1.0f));
    picked_->normal = glm::mat3(turning) * picked_->normal;
    put(*picked_->thing);
}

void ViewSession::remove()
{
    MovableObject& thing = picked_thing();
    thing.deleted = true;
    put(*picked_->thing);
    hide(*picked_->thing);
    picked_.reset();
    probe_.reset();
}

/// Removes an object from images.
void ViewSession::hide(std::uint32_t thing)
{
    const auto is_gone = [&](const Surface& surface) {
        return object_of(surface.instance) == thing;
    };
    drawn_.surfaces.erase(std::remove_if(drawn_.surfaces.begin(), drawn_.surfaces.end(), is_gone),
                          drawn_.surfaces.end());
    if (preview_)
        preview_->show(shown_, drawn_);
}

/// A lamp's current factor relative to the scene.
glm::vec3 ViewSession::factor_of(const ViewLamp& lamp) const
{
    if (!lamp.is_light)
        return lamp.factor * played_[lamp.index];
    return lamp.factor * (lamp.index == sun_light_ ? sun_factor_ : 1.0f);
}

void ViewSession::apply(const ViewLamp& lamp)
{
    const glm::vec3 factor = factor_of(lamp);
    note_edit();
    if (lamp.is_light)
        return live_.set_light(lamp.index, factor);
    live_.set_emission(lamp.index, factor);
    shown_.materials[lamp.index].emitted = factor * live_.scene().materials[lamp.index].emitted;
}

void ViewSession::set_lamp(const std::string& name, const glm::vec3& factor)
{
    std::string names;
    bool found = false;
    for (ViewLamp& lamp : lamps_) {
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", lamp.name);
        if (lamp.name != name)
            continue;
        found = true;
        lamp.factor = factor;
        apply(lamp);
    }
    if (!found)
        throw Error(ErrorKind::input, "",
                    fmt::format("there is no lamp \"{}\"; the scene has {}", name,
                                names.empty() ? "none" : names));
}

void ViewSession::dim(const glm::vec3& factor)
{
    if (!picked_)
        throw Error(ErrorKind::input, "", "nothing is picked");
    for (ViewLamp& lamp : lamps_)
        if (!lamp.is_light && int(lamp.index) == picked_->material) {
            lamp.factor = factor;
            apply(lamp);
            return;
        }
    throw Error(ErrorKind::input, "",
                fmt::format("\"{}\" emits no light", shown_.instances[picked_->instance].name));
}

void ViewSession::paint(const glm::vec3& colour)
{
    if (!picked_)
        throw Error(ErrorKind::input, "", "nothing is picked");
    live_.set_albedo(std::uint32_t(picked_->material), colour);
    glm::vec4& base = shown_.materials[std::size_t(picked_->material)].base_color;
    base = glm::vec4(colour, base.a);
    note_edit();
}

void ViewSession::set_sky(const glm::vec3& factor)
{
    live_.set_sky(factor);
    sky_ = factor;
    note_edit();
}

/// A clear sky added with the sun follows its current position.
void ViewSession::place_sky()
{
    const LightOptions& lights = options_.lights;
    const bool with_sun = lights.sun && lights.sky_file.empty() && !lights.sky_color &&
                          !lights.cie && !shown_.sky.empty();
    if (!with_sun) {
        live_.turn_sky(sky_angle_);
        return note_edit();
    }
    Scene under;
    LightOptions now = lights;
    now.sun = sun_;
    now.profiles.clear();
    add_lights(under, now);
    live_.replace_sky(std::move(under.sky), sky_angle_);
    note_edit();
}

void ViewSession::turn_sky(double angle)
{
    const double before = sky_angle_;
    sky_angle_ = angle;
    if (shown_.sky.empty())
        sky_angle_ = before;
    place_sky();
}

void ViewSession::set_sun(const SunPosition& sun)
{
    if (!sun_light_)
        throw Error(ErrorKind::input, "", "there is no sun; use --sun AZIMUTH,ELEVATION");
    const bool is_ours = options_.lights.sun && options_.lights.sun->elevation > 0.0;
    sun_ = sun;
    SunPosition placed = sun;
    placed.azimuth -= options_.lights.sky_rotation;
    sun_factor_ = sun.elevation > 0.0 ? 1.0f : 0.0f;
    if (is_ours && sun.elevation > 0.0)
        sun_factor_ =
            float(sun_illuminance(sun.elevation) / sun_illuminance(options_.lights.sun->elevation));
    if (sun.elevation > 0.0)
        live_.move_light(*sun_light_, sun_light(placed).transform);
    for (const ViewLamp& lamp : lamps_)
        if (lamp.is_light && lamp.index == sun_light_)
            apply(lamp);
    if (is_ours && !shown_.sky.empty())
        place_sky();
}

const LiveLinksState& ViewSession::frame()
{
    const Clock::time_point start = Clock::now();
    const LiveLinksState before = live_.state();
    live_.advance(options_.budget_ms);
    const LiveLinksState& state = live_.state();
    costs_.add(ms_since(start));
    if (before.at_rest && state.at_rest && before.all_sweeps == state.all_sweeps)
        return state;
    by_links_ = {};
    return state;
}

/// A bake of an earlier scene is waited for, since it stops soon. One that fails is not repeated.
bool ViewSession::bake(std::chrono::milliseconds wait)
{
    if (!(options_.bake_error > 0.0) || live_.baked())
        return true;
    if (!bake_) {
        if (failed_edits_ == edits_)
            return true;
        StandingScene standing = this->standing(shown_.model);
        bake_.emplace(std::move(standing), live_.lumels(),
                      LinksOptions{.seed = options_.seed, .filter = options_.filter},
                      options_.bake_error);
        baked_edits_ = edits_;
    }
    if (!bake_->has_ended(wait))
        return false;
    const bool is_current = is_baking();
    try {
        std::optional<BakedLight> light = bake_->take();
        if (light && is_current) {
            live_.show(std::move(*light));
            by_links_ = {};
        }
    } catch (const std::exception& error) {  // such as out of memory: the light of links remains
        log_warning(fmt::format("the scene at rest was not baked: {}", error.what()));
        failed_edits_ = baked_edits_;
    }
    bake_.reset();
    return is_current;
}

}  // namespace lumel
