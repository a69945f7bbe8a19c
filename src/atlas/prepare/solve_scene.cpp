#include "atlas/prepare/solve_scene.h"

#include <algorithm>
#include <span>

#include "atlas/near/buried.h"
#include "atlas/near/still_part.h"
#include "atlas/prepare/lit_sides.h"
#include "base/core/error.h"

namespace lumel {
namespace {

/// Approximate progress at the end of each stage.
constexpr double kRaysReady = 0.1, kLaidOut = 0.3, kLifted = 0.5;

bool is_black(const glm::vec3& light)
{
    return light == glm::vec3(0.0f);
}

/// True if there is any light source, whether or not it lights a surface.
bool gives_light(const Scene& scene)
{
    const auto shines = [](const PunctualLight& light) {
        return light.intensity > 0.0f && !is_black(light.color);
    };
    const auto emits = [&](const Instance& instance) {
        const auto& primitives = scene.meshes[std::size_t(instance.mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(), [&](const Primitive& primitive) {
            return !is_black(scene.materials[std::size_t(primitive.material)].emitted);
        });
    };
    return std::any_of(scene.lights.begin(), scene.lights.end(), shines) ||
           std::any_of(scene.instances.begin(), scene.instances.end(), emits) ||
           !std::all_of(scene.sky.radiance.begin(), scene.sky.radiance.end(), is_black);
}

std::vector<std::uint32_t> those_that_stay(const Scene& scene,
                                           const std::vector<std::uint32_t>& movers)
{
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (std::find(movers.begin(), movers.end(), i) == movers.end())
            result.push_back(i);
    return result;
}

}  // namespace

Scene read_scene(const std::string& path, MaterialModel model, const LightOptions& lights)
{
    Scene scene = read_gltf(path, model);
    add_lights(scene, lights);
    warn_if_dark(scene);
    return scene;
}

void warn_if_dark(Scene& scene)
{
    if (!gives_light(scene))
        scene.warnings.emplace_back(
            "nothing in the scene gives light, so the lightmap will be black: give a material "
            "emission, add lamps (KHR_lights_punctual), or use --sky or --sun");
}

void check_camera(const Scene& scene, int camera)
{
    const int cameras = int(scene.cameras.size());
    if (camera >= cameras)
        throw Error(ErrorKind::input, "--camera " + std::to_string(camera),
                    cameras == 0 ? "the scene has no cameras; leave it out and one is chosen"
                                 : "the scene's cameras are 0 to " + std::to_string(cameras - 1));
}

SolveScene::SolveScene(Scene given, const AtlasOptions& options, const ProgressCallback& progress)
    : SolveScene(
          std::move(given),
          [&](const Scene& placed, const RayScene& among, const ProgressCallback& part) {
              return make_atlas(placed, options, part,
                                sides_by_light(options.sides, among, options.daylit));
          },
          {}, progress)
{
}

SolveScene::SolveScene(Scene given, const LayOut& lay_out, const Bury& bury,
                       const ProgressCallback& progress)
    : scene(std::move(given)),
      rays(scene),
      surfaces(scene),
      atlas(lay_out(scene, rays, part_of(progress, kRaysReady, kLaidOut))),
      lumels(make_lumels(scene, atlas, part_of(progress, kLaidOut, kLifted)))
{
    if (lumels.lumels.empty())
        throw Error(ErrorKind::input, scene.path,
                    "has no surface that can receive light: nothing is drawn, or all of it is "
                    "cut out");
    const ProgressCallback burying = part_of(progress, kLifted, 1.0);
    open = bury ? bury(scene, rays, atlas, lumels, burying)
                : mark_buried(scene, rays, atlas, lumels, {}, burying);
}

SolveScene::SolveScene(Scene given, Atlas laid_out, Lumels made, std::vector<std::uint32_t> moving)
    : scene(std::move(given)),
      movers(std::move(moving)),
      rays(scene, those_that_stay(scene, movers)),
      surfaces(scene),
      atlas(std::move(laid_out)),
      lumels(std::move(made)),
      open(lumels.lumels.size(), 1.0f)
{
}

SolveScene::SolveScene(const std::string& scene_path, const AtlasOptions& options)
    : SolveScene(read_gltf(scene_path), options)
{
}

std::unique_ptr<SolveScene> lay_out_movers(Scene scene, const AtlasOptions& options,
                                           const std::vector<std::uint32_t>& movers)
{
    std::vector<char> moves(scene.instances.size(), 0);
    for (const std::uint32_t instance : movers) {
        if (instance >= moves.size())
            throw Error(ErrorKind::input, scene.path,
                        "has no instance " + std::to_string(instance));
        moves[instance] = 1;
    }
    std::vector<std::uint32_t> ascending;
    for (std::uint32_t i = 0; i < moves.size(); ++i)
        if (moves[i])
            ascending.push_back(i);
    // Movers block no light here, since they may leave. Rays from inside of them would leave, too,
    // so their sides share texels.
    const RayScene still(scene, those_that_stay(scene, ascending));
    const auto find_sides = [&](const Scene& placed,
                                std::span<const std::vector<TriangleOf>> charts) {
        std::vector<ChartSides> found = sides_by_light(options.sides, still)(placed, charts);
        for (std::size_t chart = 0; chart < charts.size(); ++chart)
            if (!charts[chart].empty() && moves[charts[chart].front().instance])
                found[chart] = {.shows_both =
                                    options.sides == Sides::both && found[chart].shows_both};
        return found;
    };
    Atlas atlas = make_atlas(scene, options, {}, find_sides);
    Lumels lumels = make_lumels(scene, atlas, moves);
    return std::make_unique<SolveScene>(std::move(scene), std::move(atlas), std::move(lumels),
                                        std::move(ascending));
}

std::unique_ptr<SolveScene> copy_of(const SolveScene& from)
{
    return std::make_unique<SolveScene>(from.scene, from.atlas, from.lumels, from.movers);
}

}  // namespace lumel
