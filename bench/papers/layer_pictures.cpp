// Pictures of [TN11] figures 2 and 8.

#include "bench/papers/layer_pictures.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/iteration_cost.h"
#include "raster/parallel/illumination_maps.h"
#include "raster/world/tiles.h"
#include "scene/sky/light_options.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

/// Directions that light the four cubes.
constexpr int kLightingDirections = 256;
/// From which the picture is taken: three sides of each cube show.
const glm::vec3 kTowardLight = glm::normalize(glm::vec3(0.55f, 0.6f, 0.58f));

std::vector<glm::vec3> radiosity_of(const LayersSettings& settings, const gpu::Device& device,
                                    const World& resident, const SolveScene& world)
{
    auto directions = options_of<DirectionsOptions>(settings.shared);
    directions.layers = Layers::list;
    const SolverOptions options = papers_iteration(directions);
    const NearField none = no_near_field(world.lumels);
    const auto solver = make_solver({&device, &resident, world.lumels, none}, options);
    while (solver->state().shots <
           std::uint64_t(std::min(settings.directions, kLightingDirections)))
        solver->step();
    std::vector<glm::vec3> radiosity = solver->irradiance();
    for (std::size_t i = 0; i < radiosity.size(); ++i)
        radiosity[i] =
            world.lumels.lumels[i].emission + world.lumels.lumels[i].albedo * radiosity[i];
    return radiosity;
}

/// The maps of one direction, by layers.
IlluminationMaps look(const gpu::Device& device, const World& resident, const SolveScene& world,
                      Layers layers, int side)
{
    IlluminationMaps maps(device, resident, layers, std::uint32_t(side), 1,
                          std::uint32_t(world.lumels.width), std::uint32_t(world.lumels.height));
    const std::array pose{fit_view(resident.low(), resident.high(), std::uint32_t(side),
                                   {.toward = kTowardLight, .random = 1})};
    const gpu::Array<ParallelView> views(device, std::span<const ParallelView>(pose));
    gpu::Pacer pacer(device);
    maps.look_along(pacer, views, 0, 1);
    pacer.finish();
    return maps;
}

/// Rows of maps go up, those of pictures down.
float* texel_of(Image& picture, int x, int y)
{
    return picture.at(x, picture.height - 1 - y);
}

Image illumination(const IlluminationMaps& maps, const Lumels& lumels,
                   const std::vector<glm::vec3>& radiosity)
{
    const std::vector<std::uint32_t> lumel_of = lumels_by_side(lumels);
    const auto side = int(maps.layout().side);
    const gpu::Target& image = maps.image();
    std::vector<glm::uvec4> pixels(std::size_t(image.width()) * image.height());
    image.download(pixels.data());
    const gpu::Area area = tiles_of(maps.layout()).area(0);
    Image picture(side, side, 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::uint32_t surface =
                pixels[(std::size_t(area.y) + std::size_t(y)) * image.width() + area.x +
                       std::size_t(x)]
                    .x;
            glm::vec3 color(0.0f);
            if (surface != 0 && surface != kAbsorbing && lumel_of[surface - 1] != kNoLumel)
                color = radiosity[lumel_of[surface - 1]];
            std::copy_n(&color.r, 3, texel_of(picture, x, y));
            texel_of(picture, x, y)[3] = 1.0f;
        }
    return tone_map(picture);
}

Image overdraw(const IlluminationMaps& maps)
{
    const auto side = int(maps.layout().side);
    const std::vector<std::uint32_t> heads = maps.heads().download();
    const std::vector<Fragment> fragments = maps.fragments().download();
    std::vector<int> counts;
    for (int k = 0; k < side * side; ++k) {
        int count = 0;
        for (std::uint32_t next = heads[std::size_t(k)]; next != kEndOfList;
             next = fragments[next].next)
            ++count;
        counts.push_back(count);
    }
    const auto most = float(std::max(*std::max_element(counts.begin(), counts.end()), 1));
    Image picture(side, side, 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float* texel = texel_of(picture, x, y);
            std::fill_n(texel, 3,
                        1.0f - float(counts[std::size_t(y) * std::size_t(side) + std::size_t(x)]) /
                                   most);
            texel[3] = 1.0f;
        }
    return picture;
}

}  // namespace

Image four_cubes_along_a_direction(const LayersSettings& settings, const gpu::Device& device)
{
    const int side = options_of<DirectionsOptions>(settings.shared).map_side;
    LightOptions white;
    white.sky_color = glm::vec3(1.0f);
    const SolveScene world(read_scene("scenes/four-cubes.gltf", MaterialModel::diffuse, white),
                           AtlasOptions{.size = settings.shared.size});
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const std::vector<glm::vec3> radiosity = radiosity_of(settings, device, resident, world);
    return contact_sheet({{illumination(look(device, resident, world, Layers::stochastic, side),
                                        world.lumels, radiosity),
                           overdraw(look(device, resident, world, Layers::list, side))}});
}

Image plane_on_top(const SolveScene& world, const std::vector<glm::vec3>& irradiance, int width)
{
    std::vector<std::size_t> below;
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        if (world.scene.instances[lumel.instance].name != "top" || (lumel.flags & kLumelBack) == 0)
            continue;
        below.push_back(i);
        low = glm::min(low, lumel.position);
        high = glm::max(high, lumel.position);
    }
    Image picture(width, width, 4);
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec2 part = (glm::vec2(x, y) + 0.5f) / float(width);
            const glm::vec2 place =
                glm::mix(glm::vec2(low.x, low.z), glm::vec2(high.x, high.z), part);
            const auto off = [&](std::size_t i) {
                const glm::vec3& at = world.lumels.lumels[i].position;
                return glm::distance(glm::vec2(at.x, at.z), place);
            };
            const std::size_t nearest =
                *std::min_element(below.begin(), below.end(),
                                  [&](std::size_t a, std::size_t b) { return off(a) < off(b); });
            const glm::vec3 radiosity = world.lumels.lumels[nearest].albedo * irradiance[nearest];
            std::copy_n(&radiosity.r, 3, picture.at(x, y));
            picture.at(x, y)[3] = 1.0f;
        }
    return picture;
}

}  // namespace lumel::bench
