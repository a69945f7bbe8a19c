#include "links/live/live_links.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "api/scene.h"
#include "api/translate.h"
#include "api/values.h"
#include "api/warnings.h"
#include "atlas/finish/finish.h"
#include "atlas/lumels/sides.h"
#include "base/core/clock.h"
#include "base/core/frame.h"
#include "scene/values/geometry_checks.h"

namespace lumel::v0 {
namespace {

/// Minimum length of a direction vector.
constexpr float kMinLength = 1e-20f;

lumel::LiveLinksOptions links_options(const LiveLinksSettings& settings)
{
    if (!(settings.residual > 0.0 && settings.residual <= 1.0))
        throw lumel::Error(lumel::ErrorKind::input, "LiveLinksSettings::residual",
                           "must be above 0 and at most 1");
    lumel::LiveLinksOptions options;
    options.rays = settings.rays;
    options.seed = options.light.seed = settings.seed;
    options.residual = settings.residual;
    options.filter = settings.filter;
    for (std::size_t k = 0; k < settings.movers.size(); ++k) {
        const auto earlier = settings.movers.begin() + std::ptrdiff_t(k);
        if (std::find(settings.movers.begin(), earlier, settings.movers[k]) != earlier)
            throw lumel::Error(lumel::ErrorKind::input, "LiveLinksSettings::movers",
                               "names instance " + std::to_string(settings.movers[k]) + " twice");
        options.groups.push_back({settings.movers[k]});
    }
    return options;
}

/// Transform of a lamp after a move; members of `place` without a value do not change it.
glm::mat4 placed(const PunctualLight& lamp, const LampPlace& place, const glm::dvec3& origin)
{
    const auto refuse = [&](const char* what) {
        throw lumel::Error(lumel::ErrorKind::input, "\"" + lamp.name + "\"", what);
    };
    glm::mat4 result = lamp.transform;
    if (place.direction) {
        const glm::vec3 direction = to_glm(*place.direction);
        const float length = glm::length(direction);
        if (!std::isfinite(length) || length < kMinLength)
            refuse("has a direction of no length");
        result = glm::mat4(frame_about(direction / -length));
        result[3] = lamp.transform[3];
    }
    if (place.position) {
        if (lamp.kind == PunctualLight::Kind::directional)
            refuse("is a directional light: it has a direction and no position");
        const glm::vec3 position(glm::dvec3(to_glm(*place.position)) - origin);
        if (!is_finite(*place.position) ||
            reaches_too_far(Bounds{}, glm::mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0},
                                                glm::vec4(position, 1.0f))))
            refuse("is moved to a position that is not finite or too far out");
        result[3] = glm::vec4(position, 1.0f);
    }
    return result;
}

}  // namespace

struct LinksImpl {
    std::vector<std::uint32_t> movers;
    LinksOptions baking;
    lumel::LiveLinks live;
    std::vector<glm::mat4> given;  ///< [instances] transforms in the scene
    std::vector<Surface> surfaces;
    std::vector<std::string> notes;
    LiveLinksState state;

    LinksImpl(const lumel::Scene& scene, const LiveLinksSettings& settings)
        : movers(settings.movers),
          baking{.seed = settings.seed, .filter = settings.filter},
          live(lay_out_movers(scene, checked_options(settings.atlas), movers),
               links_options(settings)),
          surfaces(surfaces_of(live.scene(), live.atlas())),
          notes(told(live.atlas().notes))
    {
        for (const lumel::Instance& instance : scene.instances)
            given.push_back(instance.transform);
    }
};

LiveLinks::LiveLinks(const Scene& scene, const LiveLinksSettings& settings)
    : impl_(translated([&] { return std::make_unique<LinksImpl>(scene.impl().scene, settings); }))
{
}

LiveLinks::~LiveLinks() = default;
LiveLinks::LiveLinks(LiveLinks&&) noexcept = default;
LiveLinks& LiveLinks::operator=(LiveLinks&&) noexcept = default;

void LiveLinks::move(std::uint32_t instance, const Mat4& transform)
{
    translated([&] {
        const std::string name = "instance " + std::to_string(instance);
        const auto mover = std::find(impl_->movers.begin(), impl_->movers.end(), instance);
        if (mover == impl_->movers.end())
            throw lumel::Error(lumel::ErrorKind::input, name, "is not movable");
        const glm::mat4 &given = impl_->given[instance],
                        place = place_in_scene(transform, given, impl_->live.scene().origin);
        if (!is_finite(transform) || reaches_too_far(Bounds{}, place))
            throw lumel::Error(lumel::ErrorKind::input, name,
                               "is moved to a position that is not finite or too far out");
        const glm::mat4 motion =
            place == given ? glm::mat4(1.0f)
                           : glm::mat4(glm::dmat4(place) * glm::inverse(glm::dmat4(given)));
        impl_->live.request(std::uint32_t(mover - impl_->movers.begin()), motion);
        impl_->state.at_rest = false;
    });
}

void LiveLinks::move_lamp(const std::string& name, const LampPlace& place)
{
    translated([&] {
        const lumel::Scene& scene = impl_->live.scene();
        std::vector<std::pair<std::uint32_t, glm::mat4>> moved;
        for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
            if (scene.lights[l].name == name)
                moved.emplace_back(l, placed(scene.lights[l], place, scene.origin));
        if (moved.empty())
            throw lumel::Error(lumel::ErrorKind::input, scene.path,
                               "has no light named \"" + name + "\"");
        for (const auto& [light, transform] : moved)
            impl_->live.move_light(light, transform);
        impl_->state.at_rest = false;
    });
}

void LiveLinks::set_lamp(const std::string& name, const Vec3& factor)
{
    translated([&] {
        impl_->live.set_lamp(name, checked_factor(factor, "lamp \"" + name + "\""));
        impl_->state.at_rest = false;
    });
}

void LiveLinks::set_sky(const Vec3& factor)
{
    translated([&] {
        impl_->live.set_sky(checked_factor(factor, "the sky"));
        impl_->state.at_rest = false;
    });
}

void LiveLinks::set_color(const std::string& material, const Vec3& color)
{
    translated([&] {
        impl_->live.set_albedo(material, to_glm(color));
        impl_->state.at_rest = false;
    });
}

LiveLinksState LiveLinks::update(double budget_ms)
{
    return translated([&] {
        const Clock::time_point start = Clock::now();
        const lumel::LiveLinksState state = impl_->live.advance(budget_ms);
        impl_->state = {.residual = state.residual,
                        .dark_residual = state.dark_residual,
                        .under_way = state.under_way,
                        .at_rest = state.at_rest,
                        .milliseconds = ms_since(start)};
        return impl_->state;
    });
}

double LiveLinks::bake(double error)
{
    return translated([&] {
        if (!(error > 0.0 && std::isfinite(error)))
            throw lumel::Error(lumel::ErrorKind::input, "error", "must be above 0");
        update(std::numeric_limits<double>::infinity());
        lumel::LiveLinks& live = impl_->live;
        live.show(bake_standing(live.standing(), live.lumels(), impl_->baking, error));
        return live.baked()->error;
    });
}

const LiveLinksState& LiveLinks::state() const
{
    return impl_->state;
}

Map LiveLinks::map() const
{
    return translated([&] {
        const lumel::LiveLinks& live = impl_->live;
        return map_of(finish_map(live.scene(), live.atlas(), live.shown_lumels(), live.shown()));
    });
}

Map LiveLinks::lumels() const
{
    return translated([&] {
        const Lumels& lumels = impl_->live.lumels();
        const std::vector<glm::vec3> light = impl_->live.shown();
        Image image(lumels.width, lumels.height, 4);
        for (std::size_t i = 0; i < light.size(); ++i) {
            const Lumel& lumel = lumels.lumels[i];
            if (is_back(lumel) && !has_own_back(lumels.back_shift, lumel.chart))
                continue;
            float* texel = image.values.data() + std::size_t(map_texel(lumels, lumel)) * 4;
            for (int c = 0; c < 3; ++c)
                texel[c] = light[i][c];
            texel[3] = 1.0f;
        }
        return map_of(std::move(image));
    });
}

const std::vector<Surface>& LiveLinks::surfaces() const
{
    return impl_->surfaces;
}

const std::vector<std::string>& LiveLinks::notes() const
{
    return impl_->notes;
}

}  // namespace lumel::v0
