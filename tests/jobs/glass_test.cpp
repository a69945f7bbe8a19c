// Light through coloured glass, by every method, against the path tracer.

#include "../support/box_lumels.h"
#include "solved.h"
#include "truth/reference.h"

namespace lumel {
namespace {

/// A unit square that faces +z at height 0, or -z at any other.
support::Quad level(float height, float border)
{
    support::Quad quad;
    const float side = 1.0f + 2.0f * border;
    quad.corner = {-border, -border, height};
    quad.edge_u = height == 0.0f ? glm::vec3(side, 0, 0) : glm::vec3(0, side, 0);
    quad.edge_v = height == 0.0f ? glm::vec3(0, side, 0) : glm::vec3(side, 0, 0);
    return quad;
}

/// A lamp over a floor, and between them a pane that light passes by half, tinted, and that
/// reflects as well.
Scene lamp_over_pane_over_floor()
{
    support::Quad floor = level(0.0f, 0.0f), pane = level(0.5f, 0.5f), lamp = level(1.0f, 0.0f);
    lamp.emission = glm::vec3(1.0f);
    lamp.albedo = glm::vec3(0.0f);
    pane.albedo = {0.9f, 0.3f, 0.05f};
    pane.double_sided = true;
    Scene scene = support::make_quads({floor, pane, lamp}).scene;
    scene.model = MaterialModel::glossy;  // without any gloss: every method may solve it
    for (Material& material : scene.materials) {
        material.metallic = 0.0f;
        material.dielectric_specular = glm::vec3(0.0f);
    }
    scene.materials[1].transmission = 0.5f;
    return scene;
}

/// Mean over the lumels of the floor.
glm::dvec3 on_floor(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        if (lumels.lumels[i].instance == 0) {
            sum += double(lumels.lumels[i].area) * glm::dvec3(irradiance[i]);
            area += double(lumels.lumels[i].area);
        }
    return sum / area;
}

class Glass : public testing::TestWithParam<SolverOptions> {};

TEST_P(Glass, TintsTheFloorBelowIt)
{
    const SolveScene room(lamp_over_pane_over_floor(), {.size = 64});
    const glm::dvec3 truth =
        on_floor(room.lumels, reference_irradiance(room.scene, room.rays, room.lumels,
                                                   {.samples_per_lumel = 256}));
    EXPECT_GT(truth.r, 4.0 * truth.b) << "the floor is to be red";
    const NearField near = near_field_for(room.scene, room.rays, room.lumels, GetParam());
    const gpu::Device device;
    const World world(device, room.scene, room.lumels, &room.atlas);
    const auto solver = make_solver(
        {.device = &device, .world = &world, .lumels = room.lumels, .near = near, .scene = &room},
        GetParam());
    EXPECT_TRUE(solve(*solver, GetParam()));
    const glm::dvec3 found = on_floor(room.lumels, solver->irradiance());
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], truth[c], 0.02 * truth[c]) << "channel " << c;
    EXPECT_EQ(device.validation_messages(), "");
}

SolverOptions method(const char* id, std::uint64_t shots)
{
    SolverOptions options{
        .method = method_of(id).defaults(), .max_shots = shots, .target_error = 0.0};
    set_option(options.method, "hemicube", "128");
    set_option(options.method, "map-side", "256");
    return options;
}

/// Three hemicubes a lumel, for four bounces.
SolverOptions gather()
{
    return {.method = GatherOptions{.batch = 48, .hemicube = 32},
            .max_shots = 40000,
            .target_error = 0.0};
}

// With stochastic layers the nearest of several pixels counts, each of which decides by chance
// whether the pane blocks: it does too often. The glossy method shoots from each lumel some nine
// times, and the pane has lumels on both sides.
INSTANTIATE_TEST_SUITE_P(By, Glass,
                         testing::Values(method("links", 256), method("stochastic", 6144),
                                         method("glossy", 36864), method("directions", 24576),
                                         gather()),
                         [](const auto& test) {
                             return std::string(method_of(test.param.method).id);
                         });

}  // namespace
}  // namespace lumel
