#include "api/device.h"
#include "api/scene.h"
#include "api/translate.h"
#include "api/values.h"
#include "api/warnings.h"
#include "atlas/finish/finish.h"
#include "lumel/vulkan.h"
#include "methods/redistribution/live_scene.h"
#include "scene/values/geometry_checks.h"

namespace lumel::v0 {
namespace {

LiveOptions checked_options(const LiveSettings& settings)
{
    if (!(settings.residual > 0.0 && settings.residual <= 1.0))
        throw lumel::Error(lumel::ErrorKind::input, "LiveSettings::residual",
                           "must be above 0 and at most 1");
    if (settings.atlas.sides == Sides::both)
        throw lumel::Error(lumel::ErrorKind::input, "AtlasSettings::sides",
                           "cannot be both in a LiveScene: it has one texel for both sides of a "
                           "surface; use LiveLinks");
    LiveOptions options;
    options.atlas = checked_options(settings.atlas);
    options.movers = settings.movers;
    options.still = settings.movers.empty();
    // Without movers, there is nothing for the cross method to do.
    options.redistribution = settings.redistribution == Redistribution::cross && !options.still
                                 ? lumel::Redistribution::cross
                                 : lumel::Redistribution::incremental;
    options.solver.seed = settings.seed;
    options.residual = settings.residual;
    return options;
}

LiveState state_of(const lumel::LiveState& state)
{
    return {.residual = state.residual,
            .under_way = state.under_way,
            .at_rest = state.at_rest,
            .milliseconds = state.milliseconds};
}

}  // namespace

struct LiveImpl {
    const gpu::Device* device;
    lumel::LiveScene live;
    std::vector<glm::mat4> given;  ///< [instances] transforms in the scene
    std::vector<Surface> surfaces;
    std::vector<std::string> notes;
    LiveState state;

    LiveImpl(const gpu::Device& on, const lumel::Scene& scene, const LiveOptions& options)
        : device(&on),
          live(on, scene, options),
          surfaces(surfaces_of(live.scene(), live.atlas())),
          notes(told(live.atlas().notes))
    {
        for (const lumel::Instance& instance : scene.instances)
            given.push_back(instance.transform);
    }
};

LiveScene::LiveScene(const Device& device, const Scene& scene, const LiveSettings& settings)
    : impl_(translated([&] {
          return std::make_unique<LiveImpl>(device.impl().device, scene.impl().scene,
                                            checked_options(settings));
      }))
{
}

LiveScene::~LiveScene() = default;
LiveScene::LiveScene(LiveScene&&) noexcept = default;
LiveScene& LiveScene::operator=(LiveScene&&) noexcept = default;

void LiveScene::move(std::uint32_t instance, const Mat4& transform)
{
    translated([&] {
        const glm::mat4 place = instance < impl_->given.size()
                                    ? place_in_scene(transform, impl_->given[instance],
                                                     impl_->live.scene().origin)
                                    : to_glm(transform);  // move() throws
        if (!is_finite(transform) || reaches_too_far(Bounds{}, place))
            throw lumel::Error(lumel::ErrorKind::input, "instance " + std::to_string(instance),
                               "is moved to a position that is not finite or too far out");
        impl_->live.move(instance, place);
    });
}

void LiveScene::set_emission(std::uint32_t instance, const Vec3& factor)
{
    translated([&] {
        impl_->live.set_emission(
            instance, checked_factor(factor, "emission of instance " + std::to_string(instance)));
    });
}

void LiveScene::set_reflectance(std::uint32_t instance, const Vec3& factor)
{
    translated([&] {
        impl_->live.set_reflectance(instance, checked_factor(factor, "reflectance of instance " +
                                                                         std::to_string(instance)));
    });
}

void LiveScene::set_light(std::uint32_t light, const Vec3& factor)
{
    translated([&] {
        impl_->live.set_light(light, checked_factor(factor, "light " + std::to_string(light)));
    });
}

void LiveScene::set_sky(const Vec3& factor)
{
    translated([&] { impl_->live.set_sky(checked_factor(factor, "the sky")); });
}

LiveState LiveScene::update(double budget_ms)
{
    return translated([&] {
        impl_->state = state_of(impl_->live.update(budget_ms));
        impl_->device->check_validation();
        return impl_->state;
    });
}

const LiveState& LiveScene::state() const
{
    return impl_->state;
}

Map LiveScene::map() const
{
    return translated([&] {
        const lumel::LiveScene& live = impl_->live;
        return map_of(finish_map(live.scene(), live.atlas(), live.lumels(), live.irradiance()));
    });
}

const std::vector<Surface>& LiveScene::surfaces() const
{
    return impl_->surfaces;
}

const std::vector<std::string>& LiveScene::notes() const
{
    return impl_->notes;
}

DeviceImage device_image(const LiveScene& live)
{
    const gpu::Target& image = live.impl().live.irradiance_image();
    return {.image = image.image(),
            .view = image.view(),
            .format = gpu::format_of(image.pixel()),
            .width = image.width(),
            .height = image.height()};
}

}  // namespace lumel::v0
