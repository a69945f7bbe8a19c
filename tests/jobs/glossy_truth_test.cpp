// Glossy scenes against paths: the maps of four of them, and what sky, sun and lamps leave in maps
// and pictures.

#include <cmath>

#include "../support/box_lumels.h"
#include "../support/glossy_look.h"
#include "../support/lamps.h"
#include "jobs/render/render.h"
#include "jobs/solve/lighting.h"
#include "methods/glossy/glossy.h"
#include "methods/glossy/lobe_particles.h"
#include "raster/shadow_maps/direct_light.h"
#include "solve/shooting/lumel_arrays.h"
#include "solved.h"
#include "truth/reference.h"

namespace lumel {
namespace {

struct Case {
    std::string name;
    Scene (*make)();
    int size;   ///< of the atlas [texels]
    int paths;  ///< for a lumel, of each half of the truth
    std::uint64_t shots;
};

std::ostream& operator<<(std::ostream& out, const Case& given)
{
    return out << given.name;
}

template <const char* name>
Scene own_scene()
{
    return read_gltf(support::scene_path(name), MaterialModel::glossy);
}

constexpr char kBox[] = "glossy-cornell-box";
constexpr char kFloor[] = "glossy-floor";
constexpr char kObjects[] = "specular-objects";

/// A polished plate and a wall beside it, under an even sky, the sun and two lamps.
Scene plate_and_wall()
{
    Scene scene;
    support::add_quad(
        scene,
        {.corner = {0.0f, 0.0f, 0.0f}, .edge_u = {0.0f, 0.0f, 2.0f}, .edge_v = {2.0f, 0.0f, 0.0f}});
    support::add_quad(
        scene,
        {.corner = {0.0f, 0.0f, 0.0f}, .edge_u = {2.0f, 0.0f, 0.0f}, .edge_v = {0.0f, 2.0f, 0.0f}});
    support::make_glossy(scene, 0, {glm::vec3(0.1f), glm::vec3(0.7f, 0.6f, 0.5f), 40.0f});
    support::make_glossy(scene, 1, {glm::vec3(0.6f), glm::vec3(0.0f), 1.0f});
    PunctualLight sun = support::make_lamp(PunctualLight::Kind::directional, 4.0f, glm::vec3(0.0f),
                                           {-0.2f, -1.0f, -1.0f});
    sun.angle = 0.02f;  // [rad]
    PunctualLight bulb = support::make_lamp(PunctualLight::Kind::point, 2.0f, {1.6f, 1.2f, 1.5f});
    bulb.radius = 0.05f;
    scene.lights = {sun, bulb,
                    support::make_lamp(PunctualLight::Kind::point, 1.0f, {0.3f, 0.8f, 1.0f})};
    scene.sky = support::even_sky({0.2f, 0.3f, 0.5f});
    return scene;
}

/// H [N] [lx] as bakes find it. batch: shooters per iteration.
std::vector<glm::vec3> solved(const SolveScene& world, std::uint64_t shots, int batch = 16)
{
    GlossyOptions method;
    method.views.batch = batch;
    const SolverOptions options{.method = method, .max_shots = shots, .target_error = 0.0};
    const gpu::Device device;
    const World resident(device, world.scene, world.lumels, &world.atlas);
    std::vector<glm::vec3> direct;
    if (has_lights(world.scene))
        direct = direct_light(device, resident, world.scene, world.lumels, {}).irradiance;
    const std::optional<Lumels> lit = shining(world.lumels, direct, Lobes::carried);
    const Lumels& lumels = lit ? *lit : world.lumels;
    const NearField near = near_field_for(world.scene, world.rays, lumels, options);
    const LobeParticles particles(world);
    GlossyIllumination solver(device, resident, lumels, near,
                              std::get<GlossyOptions>(options.method), direct, &particles);
    EXPECT_TRUE(solve(solver, options));
    std::vector<glm::vec3> irradiance = solver.irradiance();
    add_light(irradiance, direct);
    EXPECT_EQ(device.validation_messages(), "");
    return irradiance;
}

class GlossyScene : public testing::TestWithParam<Case> {};

TEST_P(GlossyScene, HasTheMapThatPathsFindWithinTwoPerCent)
{
    const Case& given = GetParam();
    const SolveScene world(given.make(), AtlasOptions{.size = given.size});
    const auto truth = [&](std::uint32_t seed) {
        return reference_irradiance(world.scene, world.rays, world.lumels,
                                    {.samples_per_lumel = given.paths, .seed = seed});
    };
    const std::vector<glm::vec3> first = truth(99), second = truth(100);
    const std::vector<glm::vec3> found = solved(world, given.shots);
    const double error = support::error_alone(found, first, second);
    const double bias = support::lumel_error(world.lumels, found, support::mean_of(first, second),
                                             [](const Lumel&) { return true; })
                            .bias;
    RecordProperty("error", std::to_string(error));
    RecordProperty("bias", std::to_string(bias));
    EXPECT_LE(error, 0.02);
    EXPECT_LE(std::abs(bias), 0.005);
}

INSTANTIATE_TEST_SUITE_P(
    Of, GlossyScene,
    testing::Values(Case{"GlossyCornellBox", own_scene<kBox>, 48, 2048, 24576},
                    Case{"GlossyFloor", own_scene<kFloor>, 48, 1024, 16384},
                    Case{"SpecularObjects", own_scene<kObjects>, 48, 1024, 24576},
                    Case{"PlateUnderSkySunAndLamps", plate_and_wall, 48, 1024, 4096}),
    [](const auto& test) { return test.param.name; });

// 80 iterations of the default's 16 shooters.
TEST(GlossyIterations, EightyAreWithinFourPerCentOfPaths)
{
    const SolveScene world(own_scene<kBox>(), AtlasOptions{.size = 64});
    const auto truth = [&](std::uint32_t seed) {
        return reference_irradiance(world.scene, world.rays, world.lumels,
                                    {.samples_per_lumel = 1024, .seed = seed});
    };
    const double error = support::error_alone(solved(world, 1280), truth(99), truth(100));
    RecordProperty("error", std::to_string(error));
    EXPECT_LE(error, 0.04);
}

// Where a batch has a shooter of emission or of reflected light alone, particles carry both.
TEST(GlossyIterations, OfOneShooterAreNotNoisierThanThoseOfSixteen)
{
    const SolveScene world(own_scene<kBox>(), AtlasOptions{.size = 48});
    const auto truth = [&](std::uint32_t seed) {
        return reference_irradiance(world.scene, world.rays, world.lumels,
                                    {.samples_per_lumel = 1024, .seed = seed});
    };
    const std::vector<glm::vec3> first = truth(99), second = truth(100);
    const auto error = [&](int batch) {
        return support::error_alone(solved(world, 1280, batch), first, second);
    };
    EXPECT_LE(error(1), 1.5 * error(16));
}

// What lobes reflect of lamps, and of surfaces that shine, is indirect light too.
TEST(IndirectLight, OfLampsSkyAndAShiningSurfaceIsWhatPathsFind)
{
    Scene scene = plate_and_wall();
    support::add_quad(scene, {.corner = {1.5f, 1.5f, 1.5f},
                              .edge_u = {0.4f, 0.0f, 0.0f},
                              .edge_v = {0.0f, 0.0f, 0.4f},
                              .albedo = glm::vec3(0.0f),
                              .emission = glm::vec3(40.0f)});
    const gpu::Device device;
    const ProgressFunction progress;
    Stages stages(progress);
    BakeOptions options;
    options.atlas.size = 32;
    options.parts = Parts::indirect;
    options.solver = {.method = GlossyOptions{}, .max_shots = 8192, .target_error = 0.0};
    const Setting setting(std::move(scene), &device, options, stages);
    const std::vector<glm::vec3> found = solve_light(&device, setting, options, stages)->irradiance;
    const SolveScene& world = setting.prepared;
    const auto truth = [&](std::uint32_t seed) {
        return reference_irradiance(
            world.scene, world.rays, world.lumels,
            {.samples_per_lumel = 2048, .seed = seed, .parts = Parts::indirect});
    };
    const std::vector<glm::vec3> first = truth(99), second = truth(100);
    const double error = support::error_alone(found, first, second);
    RecordProperty("error", std::to_string(error));
    EXPECT_LE(error, 0.06);  // noise of both
    for (const std::uint32_t surface : {0, 1}) {
        const double bias =
            support::lumel_error(world.lumels, found, support::mean_of(first, second),
                                 [&](const Lumel& lumel) { return lumel.instance == surface; })
                .bias;
        RecordProperty("bias_" + std::to_string(surface), std::to_string(bias));
        EXPECT_LE(std::abs(bias), 0.01) << "surface " << surface;
    }
    EXPECT_EQ(device.validation_messages(), "");
}

/// The plate and the wall from an eye that sees the sun, the lamps and the sky in the plate.
class PictureOfHighlights : public testing::Test {
protected:
    static Image picture(int paths)
    {
        Scene scene = plate_and_wall();
        const glm::vec3 eye(1.2f, 1.0f, 3.2f);
        const glm::vec3 back = glm::normalize(eye - glm::vec3(1.0f, 0.2f, 0.7f));
        const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), back));
        scene.cameras = {
            {.transform = {glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                           glm::vec4(back, 0.0f), glm::vec4(eye, 1.0f)},
             .vertical_fov = 0.8f}};
        RenderOptions options;
        options.width = 48;
        options.height = 32;
        options.sets = 16;
        options.rays = 16;
        options.bake.atlas.size = 64;
        options.bake.solver.max_shots = 4096;
        options.bake.solver.target_error = 0.0;
        options.paths = paths;
        return render(scene, options).image;
    }
};

TEST_F(PictureOfHighlights, ShowsSkySunAndLampsAsPathsDo)
{
    const MapError error = compare_maps(picture(0), picture(2048));
    RecordProperty("error", std::to_string(error.relative_rmse));
    RecordProperty("bias", std::to_string(error.bias));
    EXPECT_LE(error.relative_rmse, 0.03);
    EXPECT_LE(std::abs(error.bias), 0.01);
}

}  // namespace
}  // namespace lumel
