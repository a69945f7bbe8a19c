#include <numeric>

#include "api/bake.h"
#include "api/device.h"
#include "api/translate.h"
#include "api/values.h"
#include "atlas/finish/finish.h"
#include "methods/matrix/matrix_file.h"
#include "methods/matrix/relight_session.h"

namespace lumel::v0 {
namespace {

const lumel::Relightable& light_of(const Baked& baked)
{
    const BakedSolution* const solution = baked.solution.get();
    if (!solution || !solution->light)
        throw lumel::Error(lumel::ErrorKind::input, "Baked",
                           "is not relightable; bake all light by method \"matrix\" to its end");
    return *solution->light;
}

/// Map of lumels without charts: front sides hide back sides.
Map map_of_places(const lumel::Relightable& light, const std::vector<glm::vec3>& irradiance)
{
    Image map(int(light.side), int(light.side), 4);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const std::uint32_t texel = light.place[i] / 2;
        float* shown = map.values.data() + std::size_t(texel) * 4;
        const bool back = light.place[i] != place_of(texel, false);
        if (back && shown[3] > 0.0f)
            continue;
        for (int c = 0; c < 3; ++c)
            shown[c] = irradiance[i][c];
        shown[3] = 1.0f;
    }
    dilate(map);
    return map_of(std::move(map));
}

}  // namespace

struct RelightImpl {
    const gpu::Device* device;
    RelightSession session;
    std::shared_ptr<const BakedSolution> baked;  ///< null if read from a file
    std::unique_ptr<World> world;                ///< set by the first move_light()

    /// Uploads the baked scene.
    void load_world()
    {
        if (world || !baked)
            return;
        const SolveScene& from = baked->setting.prepared;
        world = std::make_unique<World>(*device, from.scene, from.lumels, &from.atlas);
        std::vector<std::uint32_t> number(from.lumels.lumels.size());
        std::iota(number.begin(), number.end(), 0u);
        session.set_world({*world, from.lumels, std::move(number), {}});
    }
};

Relight::Relight(const Device& device, const Baked& baked)
    : impl_(translated([&] {
          const gpu::Device& on = device.impl().device;
          return std::unique_ptr<RelightImpl>(
              new RelightImpl{&on, RelightSession(on, light_of(baked)), baked.solution, nullptr});
      }))
{
}

Relight::Relight(const Device& device, const std::string& path)
    : impl_(translated([&] {
          const gpu::Device& on = device.impl().device;
          return std::unique_ptr<RelightImpl>(
              new RelightImpl{&on, RelightSession(on, path), nullptr, nullptr});
      }))
{
}

Relight::~Relight() = default;
Relight::Relight(Relight&&) noexcept = default;
Relight& Relight::operator=(Relight&&) noexcept = default;

std::vector<std::string> Relight::lights() const
{
    return impl_->session.names();
}

void Relight::set_light(const std::string& name, const Vec3& factor)
{
    translated([&] { impl_->session.set_light(name, to_glm(factor)); });
}

void Relight::move_light(const std::string& name, const LampPlace& place)
{
    translated([&] {
        lumel::LampPlace to;
        if (place.position)
            to.position = glm::dvec3(to_glm(*place.position));
        if (place.direction)
            to.direction = to_glm(*place.direction);
        impl_->load_world();
        impl_->session.move_light(name, to);
    });
}

Map Relight::map()
{
    return translated([&] {
        const std::vector<glm::vec3> irradiance = impl_->session.irradiance();
        impl_->device->check_validation();
        if (impl_->baked) {
            const SolveScene& from = impl_->baked->setting.prepared;
            return map_of(finish_map(from.scene, from.atlas, from.lumels, irradiance));
        }
        return map_of_places(impl_->session.light(), irradiance);
    });
}

void Relight::save(const std::string& path) const
{
    translated([&] { write_relightable(path, impl_->session.light()); });
}

}  // namespace lumel::v0
