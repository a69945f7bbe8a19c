#include "bench/papers/matrix_case.h"

#include <algorithm>
#include <random>

#include "atlas/near/world_lumels.h"
#include "base/core/error.h"
#include "base/core/parallel.h"
#include "methods/matrix/matrix.h"

namespace lumel::bench {
namespace {

constexpr double kLitShare = 0.25;  // a light in a pillar, or behind a door, is of no use
constexpr int kMaxTries = 100;      // places for each light
constexpr float kMargin = 0.05f;    // of the scene's box: no light within this of its sides
constexpr std::size_t kLumelsPerTask = 256;

/// E [N] of a point light of 1 cd.
std::vector<glm::vec3> light_of(const SolveScene& world, const WorldLumels& lumels,
                                const glm::vec3& lamp)
{
    std::vector<glm::vec3> light(lumels.size(), glm::vec3(0.0f));
    parallel_for(light.size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const WorldLumel& lumel = lumels[i];
            const glm::vec3 to = lamp - lumel.centre;
            const float square = glm::dot(to, to) + lumel.size * lumel.size;
            const float cosine = glm::dot(to, lumel.normal) / std::sqrt(square);
            if (cosine > 0.0f && world.rays.sees(lumel.centre + lumel.ray_offset * lumel.normal,
                                                 lamp, lumel.ray_offset, std::uint32_t(i)))
                light[i] = glm::vec3(cosine / square);
        }
    });
    return light;
}

double lit_share(const std::vector<glm::vec3>& light)
{
    const auto lit = std::count_if(light.begin(), light.end(),
                                   [](const glm::vec3& color) { return color.g > 0.0f; });
    return double(lit) / double(light.size());
}

std::vector<std::vector<glm::vec3>> light_patches(const SolveScene& world,
                                                  const VoxelPatches& patches, int count)
{
    const WorldLumels lumels(world.scene, world.rays, world.lumels);
    const glm::vec3 low = world.rays.low(), size = world.rays.high() - low;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> inside(kMargin, 1.0f - kMargin);
    std::vector<std::vector<glm::vec3>> lights;
    for (int tries = 0; int(lights.size()) < count && tries < count * kMaxTries; ++tries) {
        const float x = inside(random), y = inside(random), z = inside(random);
        const std::vector<glm::vec3> light =
            light_of(world, lumels, low + glm::vec3(x, y, z) * size);
        if (lit_share(light) >= kLitShare)
            lights.push_back(patches.means(world.lumels, light));
    }
    if (lights.empty())
        throw Error(ErrorKind::input, world.scene.path, "has no place from which much is seen");
    return lights;
}

}  // namespace

Transport transport_of(const gpu::Device& device, const SolveScene& world,
                       const MatrixOptions& options)
{
    const NearField near =
        near_field_for(world.scene, world.rays, world.lumels, {.method = options});
    const World resident(device, world.scene, world.lumels);
    TransportBuilder builder(device, resident, world.lumels, near, options.transport);
    while (!builder.done())
        builder.step();
    return builder.finish();
}

MatrixCase make_matrix_case(const gpu::Device& device, const Settings& settings,
                            std::uint32_t patches, int lights)
{
    auto options = options_of<MatrixOptions>(settings);
    options.transport.patches = patches;
    const SolveScene world = prepare(settings, settings.size);
    Transport transport = transport_of(device, world, options);
    return {.elements = elements_of(transport.patches),
            .form_factors = std::move(transport.form_factors),
            .bounces = std::move(transport.bounces),
            .lights = light_patches(world, transport.patches, lights)};
}

StateError light_error(const MatrixCase& matrix_case, const ColorMatrix& found)
{
    StateError error;
    for (const std::vector<glm::vec3>& light : matrix_case.lights) {
        const std::vector<glm::vec3> wanted = multiply(matrix_case.bounces, light);
        const std::vector<glm::vec3> got = multiply(found, light);
        double off = 0.0, all = 0.0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const double area = double(matrix_case.elements.area[i]);
            const glm::dvec3 w(wanted[i]), d = glm::dvec3(got[i]) - w;
            off += area * glm::dot(d, d);
            all += area * glm::dot(w, w);
        }
        const double relative = std::sqrt(off / all);
        error.mean += relative / double(matrix_case.lights.size());
        error.worst = std::max(error.worst, relative);
    }
    return error;
}

}  // namespace lumel::bench
