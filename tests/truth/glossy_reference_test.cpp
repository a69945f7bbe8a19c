// Maps of scenes with gloss, by path tracing.

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "../support/glossy_look.h"
#include "../support/quadrature.h"
#include "truth/reference.h"

namespace lumel {
namespace {

using support::HandMade;
using support::kPi;
using support::make_glossy;
using support::make_quads;
using support::Quad;

std::vector<glm::vec3> solve(const HandMade& made, int samples)
{
    return reference_irradiance(made.scene, RayScene(made.scene), made.lumels,
                                {.samples_per_lumel = samples, .rule = SampleRule::centre});
}

/// A lamp and a receiver side by side above a plate, both facing it.
struct Reflection {
    Quad lamp{{-0.6f, 0.25f, 1.0f}, {0.0f, 0.5f, 0.0f}, {0.5f, 0.0f, 0.0f}};
    Quad plate{{0.0f, 0.0f, 0.0f}};
    Quad receiver{{1.1f, 0.25f, 1.0f}, {0.0f, 0.5f, 0.0f}, {0.5f, 0.0f, 0.0f}};

    Reflection() { lamp.emission = glm::vec3(10.0f); }

    HandMade made(const Reflectance& look) const
    {
        HandMade result = make_quads({lamp, plate, receiver});
        make_glossy(result.scene, 0, {});
        make_glossy(result.scene, 1, look);
        make_glossy(result.scene, 2, {});
        return result;
    }
};

/// H [lx] at the receiver's centre through the plate: points on the plate times points on the
/// lamp.
double reflected_irradiance(const Reflection& scene, const Reflectance& look)
{
    constexpr int kPlate = 64, kLamp = 32;
    const auto at = [](const Quad& quad, int u, int v, int side) {
        return quad.corner + (float(u) + 0.5f) / float(side) * quad.edge_u +
               (float(v) + 0.5f) / float(side) * quad.edge_v;
    };
    const glm::vec3 receiver = at(scene.receiver, 0, 0, 1), up(0.0f, 0.0f, 1.0f);
    const double luminance = double(scene.lamp.emission.x / kPi);
    const double lamp_area = 0.25 / (kLamp * kLamp), plate_area = 1.0 / (kPlate * kPlate);
    double sum = 0.0;
    for (int y = 0; y < kPlate * kPlate; ++y) {
        const glm::vec3 from = at(scene.plate, y % kPlate, y / kPlate, kPlate);
        const glm::vec3 out = receiver - from;
        const Brdf brdf(look, up, glm::normalize(out));
        double radiance = 0.0;
        for (int z = 0; z < kLamp * kLamp; ++z) {
            const glm::vec3 in = at(scene.lamp, z % kLamp, z / kLamp, kLamp) - from;
            const float squared = glm::dot(in, in);
            radiance += double(support::value_of(brdf, glm::normalize(in)).x * in.z * in.z /
                               (squared * squared));
        }
        const double squared = double(glm::dot(out, out));
        sum += radiance * luminance * lamp_area * double(out.z * out.z) / (squared * squared);
    }
    return sum * plate_area;
}

TEST(GlossyReference, LightByWayOfAGlossyPlateMatchesItsQuadrature)
{
    // Tolerances are four deviations and more: paths meet narrow lobes seldom.
    for (const auto& [shininess, tolerance] :
         {std::pair{1.0f, 0.01}, std::pair{10.0f, 0.01}, std::pair{100.0f, 0.035}}) {
        const Reflectance look{glm::vec3(0.2f), glm::vec3(0.7f), shininess};
        const Reflection scene;
        const double truth = reflected_irradiance(scene, look);
        const HandMade made = scene.made(look);
        EXPECT_NEAR(solve(made, 1 << 19)[made.first[2]].x, truth, tolerance * truth)
            << "n " << shininess;
    }
}

TEST(GlossyReference, NearlyAMirrorLightsAsTheLampsImage)
{
    // A receiver right of a wall that shows it the lamp behind the wall.
    const Reflectance look{glm::vec3(0.0f), glm::vec3(0.8f), 1000.0f};
    Reflection scene;
    scene.plate = {{-4.0f, -4.0f, 0.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 8.0f, 0.0f}};
    const HandMade made = scene.made(look);
    const glm::vec3 at = made.lumels.lumels[made.first[2]].position;
    const double image =
        point_to_parallel_rectangle({-0.6 - at.x, -0.1 - at.x}, {0.25 - at.y, 0.75 - at.y}, 2.0);
    // The lobe is 2.6° wide, and what of it is flatter than the mirror direction is weakened.
    EXPECT_NEAR(solve(made, 1 << 16)[made.first[2]].x, 10.0 * 0.8 * image, 0.04 * 8.0 * image);
}

TEST(GlossyReference, WithoutGlossIsTheDiffuseReference)
{
    const Reflection scene;
    HandMade made = scene.made({glm::vec3(0.5f), glm::vec3(0.0f), 30.0f});
    const auto glossy = solve(made, 256);
    made.scene.model = MaterialModel::diffuse;
    EXPECT_EQ(glossy, solve(made, 256));
}

TEST(GlossyReference, IsANumberForEveryShininess)
{
    Quad look;
    look.res_u = look.res_v = 4;
    look.emission = glm::vec3(1.0f);
    const auto walls = support::box_walls(glm::vec3(0.0f), glm::vec3(1.0f), true, look);
    HandMade made = make_quads({walls.begin(), walls.end()});
    for (const float shininess : {1.0f, 30.0f, 1000.0f}) {
        for (std::size_t i = 0; i < walls.size(); ++i)
            make_glossy(made.scene, i, {glm::vec3(0.1f), glm::vec3(0.0f, 0.5f, 0.9f), shininess});
        for (const glm::vec3& H : solve(made, 64)) {
            // Emission alone gives 1, and a furnace of that reflectance 1 / (1 - ρ).
            EXPECT_NEAR(H.r, 1.0f / 0.9f, 0.15f);
            EXPECT_TRUE(H.g >= 1.0f && H.g <= 1.0f / 0.4f + 0.2f);
            EXPECT_TRUE(std::isfinite(H.b) && H.b >= 1.0f);
        }
    }
}

}  // namespace
}  // namespace lumel
