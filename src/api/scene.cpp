#include "api/scene.h"

#include <cmath>
#include <numbers>

#include "api/translate.h"
#include "api/values.h"
#include "api/warnings.h"
#include "scene/load/albedo_cap.h"
#include "scene/sky/light_options.h"

namespace lumel::v0 {
namespace {

constexpr float kLargestLux = 1e9f;

void refuse(const std::string& what)
{
    throw lumel::Error(lumel::ErrorKind::input, "Daylight", what);
}

SunPosition checked(const Daylight::Sun& sun)
{
    if (!(std::abs(sun.azimuth) <= 2.0 * std::numbers::pi) ||
        !(std::abs(sun.elevation) <= std::numbers::pi / 2.0))
        refuse("the elevation of the sun must lie between -pi/2 and pi/2, its azimuth between "
               "-2 pi and 2 pi");
    return {sun.azimuth, sun.elevation};
}

LightOptions options_of(const Daylight& daylight)
{
    LightOptions options;
    options.sky_file = daylight.sky_file;
    if (const auto& luminance = daylight.sky_luminance)
        options.sky_color = checked_factor(*luminance, "Daylight::sky_luminance");
    if (const auto& cie = daylight.cie) {
        if (cie->type < 1 || cie->type > kOvercastType || !(cie->lux > 0.0f) ||
            cie->lux > kLargestLux)
            refuse("cie: the type must lie between 1 and 16, its illuminance above 0 and at most "
                   "1e9 lx");
        options.cie = CieSky{.type = cie->type, .lux = cie->lux, .sun = {}};
        if (cie->sun)
            options.cie->sun = checked(*cie->sun);
    }
    if (daylight.sun)
        options.sun = checked(*daylight.sun);
    if (!std::isfinite(daylight.sky_scale) || daylight.sky_scale < 0.0f)
        refuse("sky_scale must be a number of 0 or more");
    if (!std::isfinite(daylight.rotation))
        refuse("rotation must be a number");
    if (!(daylight.ground >= 0.0f && daylight.ground <= 1.0f))
        refuse("ground must lie between 0 and 1");
    options.sky_scale = daylight.sky_scale;
    options.ground = daylight.ground;
    options.sky_rotation = daylight.rotation;
    return options;
}

MaterialModel model_of(Materials materials)
{
    return materials == Materials::glossy ? MaterialModel::glossy : MaterialModel::diffuse;
}

lumel::Scene finished(lumel::Scene scene)
{
    cap_albedo(scene, scene.max_albedo);
    scene.warnings = told(scene.warnings);
    return scene;
}

}  // namespace

Scene Scene::load(const std::string& path, Materials materials)
{
    return translated([&] {
        const auto document = std::make_shared<const GltfDocument>(load_gltf_document(path));
        return Scene(std::make_unique<SceneImpl>(
            SceneImpl{finished(lumel::read_gltf(*document, model_of(materials))), document}));
    });
}

Scene::Scene(const SceneContent& content)
    : impl_(translated([&] {
          return std::make_unique<SceneImpl>(SceneImpl{finished(scene_of(content)), nullptr});
      }))
{
}

Scene::Scene(std::unique_ptr<SceneImpl> impl) : impl_(std::move(impl)) {}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::add_daylight(const Daylight& daylight)
{
    translated([&] {
        lumel::Scene changed = impl_->scene;
        add_lights(changed, options_of(daylight));
        const std::vector<std::string> added(changed.warnings.begin() +
                                                 std::ptrdiff_t(impl_->scene.warnings.size()),
                                             changed.warnings.end());
        changed.warnings = impl_->scene.warnings;
        for (std::string& warning : told(added))
            changed.warnings.push_back(std::move(warning));
        impl_->scene = std::move(changed);
    });
}

std::vector<Instance> Scene::instances() const
{
    std::vector<Instance> list;
    for (const lumel::Instance& instance : impl_->scene.instances)
        list.push_back({.name = instance.name,
                        .mesh = std::uint32_t(instance.mesh),
                        .transform = place_in_file(instance.transform, impl_->scene.origin),
                        .node = instance.node});
    return list;
}

std::vector<std::string> Scene::lights() const
{
    std::vector<std::string> names;
    for (const PunctualLight& light : impl_->scene.lights)
        names.push_back(light.name);
    return names;
}

std::uint32_t Scene::find_instance(const std::string& name) const
{
    return translated([&] { return lumel::find_instance(impl_->scene, name); });
}

const std::vector<std::string>& Scene::warnings() const
{
    return impl_->scene.warnings;
}

}  // namespace lumel::v0
