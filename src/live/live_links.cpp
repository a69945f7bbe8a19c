#include "live/live_links.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/error.h"
#include "live/still_part.h"

namespace lumel {
namespace {

/// Lumels between two looks at the clock: about a tenth of a millisecond.
constexpr std::size_t kStep = 4096;
/// Changes count as shrinking by this factor at least.
constexpr double kSlowest = 1.0 - 1e-6;
/// Sweeps after which settle() takes the light as it is.
constexpr int kMostSweeps = 20000;

std::vector<std::vector<std::uint32_t>> instances_of(const Scene& scene,
                                                     const std::vector<std::string>& things)
{
    std::vector<std::vector<std::uint32_t>> result;
    for (const std::string& name : things) {
        find_instance(scene, name);  // or it throws
        std::vector<std::uint32_t>& instances = result.emplace_back();
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].name == name)
                instances.push_back(i);
    }
    return result;
}

const Scene& checked(const Scene& scene)
{
    for (const Material& material : scene.materials)
        if (is_coloured_glass(material))
            throw Error(ErrorKind::input, scene.path,
                        "has coloured glass (material \"" + material.name +
                            "\"), which links that are kept live do not know; make it white, or "
                            "opaque");
    return scene;
}

std::uint32_t side_of(std::uint32_t rays)
{
    for (const std::uint32_t side : {2u, 4u, 8u, 16u})
        if (side * side == rays)
            return side;
    throw Error(ErrorKind::input, std::to_string(rays) + " rays",
                "are no grid: a lumel has 4, 16, 64 or 256");
}

std::vector<std::vector<std::uint32_t>> lumels_by_thing(const Lumels& lumels, const ThingRays& rays)
{
    std::vector<std::vector<std::uint32_t>> result(rays.things());
    for (std::uint32_t i = 0; i < lumels.lumels.size(); ++i)
        if (const std::uint32_t t = rays.thing_of(lumels.lumels[i].instance);
            t != ThingRays::kStays)
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
        throw Error(ErrorKind::input, "factor", "is negative, but light is not");
}

/// Changes that shrink by a factor q leave q / (1 - q) of the last to come.
double still_to_come(double change, double before)
{
    const double factor = before > 0.0 ? std::min(change / before, kSlowest) : kSlowest;
    return change * factor / (1.0 - factor);
}

}  // namespace

LumelScene lay_out(Scene scene, const AtlasOptions& options, const std::vector<std::string>& things)
{
    std::vector<char> movers(scene.instances.size(), 0);
    for (const std::vector<std::uint32_t>& instances : instances_of(scene, things))
        for (const std::uint32_t instance : instances)
            movers[instance] = 1;
    Atlas atlas = make_atlas(scene, options);
    Lumels lumels = lift(scene, atlas);
    if (lumels.lumels.empty())
        throw Error(ErrorKind::input, scene.path, "has no surface that light could fall on");
    mark_buried_by_still(scene, movers, lumels);
    return {std::move(scene), std::move(atlas), std::move(lumels)};
}

LiveLinks::LiveLinks(LumelScene laid_out, const LiveLinksOptions& options)
    : options_(options),
      laid_out_(std::move(laid_out)),
      given_(transforms_of(scene())),
      rays_(checked(scene()), instances_of(scene(), options.things)),
      surfaces_(scene()),
      world_(scene(), rays_.still(), lumels()),
      starts_(world_, nullptr, rays_.lift(), false),
      sources_(scene(), surfaces_, glm::distance(rays_.still().low(), rays_.still().high())),
      lumels_of_(lumels_by_thing(lumels(), rays_)),
      links_(place(), atlas(), side_of(options.rays), options.seed),
      light_(place(), options.light),
      sweeps_(links_),
      paint_(lumels())
{
}

LivePlace LiveLinks::place() const
{
    if (rays_.still().parts() == 0)
        throw Error(ErrorKind::input, scene().path, "has nothing that stays where it is");
    return {scene(), lumels(), rays_, surfaces_, world_, starts_, sources_, rays_.lift()};
}

void LiveLinks::set_lamp(const std::string& name, const glm::vec3& factor)
{
    check_factor(factor);
    bool found = false;
    const auto set = [&](Part part, const auto& named) {
        for (std::uint32_t n = 0; n < named.size(); ++n)
            if (named[n].name == name) {
                light_.set_factor(part, n, factor);
                found = true;
            }
    };
    set(Part::light, scene().lights);
    set(Part::material, scene().materials);
    if (!found)
        throw Error(ErrorKind::input, scene().path,
                    "has no light and no material named \"" + name + "\"");
    edited_ = true;
}

void LiveLinks::set_sky(const glm::vec3& factor)
{
    check_factor(factor);
    if (scene().sky.empty())
        throw Error(ErrorKind::input, scene().path, "has no sky");
    sky_factor_ = factor;
    light_.set_factor(Part::sky, 0, factor);
    edited_ = true;
}

void LiveLinks::set_albedo(const std::string& name, const glm::vec3& colour)
{
    const std::vector<Material>& materials = scene().materials;
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material& one) { return one.name == name; });
    if (found == materials.end())
        throw Error(ErrorKind::input, scene().path, "has no material named \"" + name + "\"");
    if (glm::clamp(colour, 0.0f, 1.0f) != colour)
        throw Error(ErrorKind::input, "colour of \"" + name + "\"", "is not from 0 to 1");
    paint_.set(scene(), atlas(), int(found - materials.begin()), colour);
    edited_ = true;
}

void LiveLinks::move_lamp(const std::string& name, const glm::mat4& transform)
{
    std::vector<PunctualLight>& lights = laid_out_.scene.lights;
    std::vector<std::uint32_t> moved;
    for (std::uint32_t l = 0; l < lights.size(); ++l)
        if (lights[l].name == name) {
            lights[l].transform = transform;
            moved.push_back(l);
        }
    if (moved.empty())
        throw Error(ErrorKind::input, scene().path, "has no light named \"" + name + "\"");
    sources_.place();
    for (const std::uint32_t light : moved)
        light_.find_again(Part::light, light);
    edited_ = true;
}

std::uint32_t LiveLinks::thing(const std::string& name) const
{
    const auto found = std::find(options_.things.begin(), options_.things.end(), name);
    if (found == options_.things.end())
        throw Error(ErrorKind::input, "\"" + name + "\"", "is not one of the things that may move");
    return std::uint32_t(found - options_.things.begin());
}

/// Places begin from those of the scene that was given, so that no rounding adds up.
void LiveLinks::put(std::uint32_t thing, const glm::mat4& motion)
{
    for (const std::uint32_t instance : rays_.instances(thing))
        laid_out_.scene.instances[instance].transform = motion * given_[instance];
    rays_.place(thing);
    world_.place(scene(), lumels(), lumels_of_[thing]);
    sources_.place();
}

Moved LiveLinks::move(const std::string& name, const glm::mat4& motion)
{
    const std::uint32_t moved = thing(name);
    if (!is_rigid(glm::mat4(1.0f), motion))
        throw Error(ErrorKind::input, "\"" + name + "\"", "would be stretched by its motion");
    const Box before = rays_.box(moved);
    put(moved, motion);
    Moved again{.links = links_.follow(moved)};
    const double all = double(lumels().lumels.size() * light_.groups());
    const double found = double(light_.follow(moved, before));
    again.direct = all > 0.0 ? found / all : 0.0;
    edited_ = true;
    return again;
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
    sweeps_.begin(direct(), paint_.albedo());
    before_ = {};
    state_ = {};
    edited_ = false;
}

LiveLinksState LiveLinks::advance(double budget_ms)
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto spent = [&] {
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    };
    if (edited_)
        begin();
    while (!state_.at_rest) {
        if (sweeps_.step(kStep))
            state_.at_rest = is_at_rest();
        if (spent() >= budget_ms)
            break;
    }
    return state_;
}

/// After a whole sweep.
bool LiveLinks::is_at_rest()
{
    const SweepChange& now = sweeps_.change();
    state_.residual = still_to_come(now.all, before_.all);
    state_.dark_residual = still_to_come(now.dark, before_.dark);
    state_.sweeps = sweeps_.sweeps();
    before_ = now;
    return std::max(state_.residual, state_.dark_residual) <= options_.residual ||
           state_.sweeps >= kMostSweeps;
}

LiveLinksState LiveLinks::settle()
{
    return advance(std::numeric_limits<double>::infinity());
}

std::uint64_t LiveLinks::bytes() const
{
    return links_.bytes() + light_.bytes() + sweeps_.bytes();
}

std::vector<glm::vec3> LiveLinks::irradiance() const
{
    std::vector<glm::vec3> result(lumels().lumels.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = sweeps_.irradiance(i);
    return result;
}

}  // namespace lumel
