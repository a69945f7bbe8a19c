// Pictures by path tracing, against radiance that is known.

#include "truth/reference_image.h"

#include <cmath>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "../support/glossy_look.h"
#include "../support/lamps.h"
#include "../support/quadrature.h"
#include "truth/reference.h"

namespace lumel {
namespace {

using support::box_walls;
using support::HandMade;
using support::make_glossy;
using support::make_quads;
using support::Quad;

/// Looks from `eye` at `target`.
glm::mat4 look_at(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up)
{
    const glm::vec3 back = glm::normalize(eye - target);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    return {glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0),
            glm::vec4(eye, 1)};
}

Image render(const Scene& scene, const View& view, const ReferenceImageOptions& options)
{
    return reference_image(scene, RayScene(scene), view, options);
}

double mean_of(const Image& image, int channel)
{
    double sum = 0.0;
    for (std::size_t i = std::size_t(channel); i < image.values.size(); i += 4)
        sum += double(image.values[i]);
    return sum / (double(image.width) * image.height);
}

TEST(ReferenceImage, AFurnaceLooksTheSameEverywhere)
{
    Quad look;
    look.albedo = glm::vec3(0.5f);
    look.emission = glm::vec3(1.0f);
    const auto walls = box_walls(glm::vec3(-1.0f), glm::vec3(1.0f), true, look);
    const HandMade made = make_quads({walls.begin(), walls.end()});
    const Image image =
        render(made.scene, {}, {.width = 8, .height = 6, .samples_per_pixel = 1024});
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            EXPECT_NEAR(image.at(x, y)[0] * support::kPi, 2.0f, 0.05f);
            EXPECT_EQ(image.at(x, y)[3], 1.0f);
        }
    EXPECT_NEAR(mean_of(image, 0) * double(support::kPi), 2.0, 0.01);
}

TEST(ReferenceImage, ADiffuseFloorShowsItsAlbedoTimesTheMapOverPi)
{
    // A room with a lamp behind a shade; each pixel sees one lumel of the floor.
    constexpr int kSide = 5;
    Quad look;
    look.albedo = glm::vec3(0.7f, 0.5f, 0.3f);
    look.res_u = look.res_v = kSide;
    const auto walls = box_walls(glm::vec3(0.0f), glm::vec3(2.0f), true, look);
    std::vector<Quad> quads(walls.begin(), walls.end());
    Quad lamp{{0.8f, 1.9f, 0.8f}, {0.4f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.4f}};
    lamp.emission = glm::vec3(3.0f, 2.0f, 1.0f);
    Quad shade = lamp;
    shade.corner.y = 1.0f;
    shade.emission = glm::vec3(0.0f);
    shade.double_sided = true;
    quads.insert(quads.end(), {lamp, shade});
    const HandMade made = make_quads(quads);
    const RayScene rays(made.scene);
    const auto irradiance =
        reference_irradiance(made.scene, rays, made.lumels, {.samples_per_lumel = 4096});

    // Rows of lumels go along z, then x.
    View view{.transform = look_at({1.0f, 0.5f, 1.0f}, {1.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}),
              .aspect = 1.0f,
              .orthographic_height = 2.0f};
    const Image image =
        render(made.scene, view, {.width = kSide, .height = kSide, .samples_per_pixel = 4096});
    constexpr std::size_t kFloor = 2;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const std::size_t lumel = made.first[kFloor] + std::size_t((kSide - 1 - y) * kSide + x);
            for (int c = 0; c < 3; ++c) {
                const float truth = look.albedo[c] * irradiance[lumel][c] / support::kPi;
                EXPECT_NEAR(image.at(x, y)[c], truth, 0.03f * truth) << x << ", " << y;
            }
        }
}

/// A patch in a black room whose walls all glow, seen at an angle.
struct SeenPatch {
    Reflectance look;
    float cosine;
};

class GlossyPatch : public testing::TestWithParam<SeenPatch> {};

std::ostream& operator<<(std::ostream& out, const SeenPatch& patch)
{
    return out << patch.look.diffuse.x << " diffuse, " << patch.look.specular.x << " specular, n "
               << patch.look.shininess << ", cos " << patch.cosine;
}

TEST_P(GlossyPatch, InEvenLightShowsItsAlbedo)
{
    Quad wall;
    wall.albedo = glm::vec3(0.0f);
    wall.emission = glm::vec3(support::kPi);  // of the radiance 1
    const auto walls = box_walls(glm::vec3(-2.0f), glm::vec3(2.0f), true, wall);
    std::vector<Quad> quads(walls.begin(), walls.end());
    quads.push_back({{-0.5f, -0.5f, 0.0f}});
    HandMade made = make_quads(quads);
    made.scene.max_albedo = 1.0f;
    const auto& [look, cosine] = GetParam();
    for (std::size_t i = 0; i < walls.size(); ++i)
        make_glossy(made.scene, i, {});
    make_glossy(made.scene, walls.size(), look);

    const glm::vec3 toward = support::direction_of(cosine, 0.4);
    const View view{.transform = look_at(1.5f * toward, glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}),
                    .vertical_fov = 1e-3f,  // sees all from one direction
                    .aspect = 1.0f};
    const Image image =
        render(made.scene, view, {.width = 4, .height = 4, .samples_per_pixel = 4096});
    const double truth = support::albedo_of(Brdf(look, {0.0f, 0.0f, 1.0f}, toward));
    EXPECT_NEAR(mean_of(image, 0), truth, 0.01 * truth);
    for (const float value : image.values)
        EXPECT_TRUE(std::isfinite(value) && value >= 0.0f);
}

Reflectance grey(float diffuse, float specular, float shininess)
{
    return {glm::vec3(diffuse), glm::vec3(specular), shininess};
}

INSTANTIATE_TEST_SUITE_P(Materials, GlossyPatch,
                         testing::Values(SeenPatch{grey(0.5f, 0.0f, 1.0f), 0.8f},
                                         SeenPatch{grey(0.0f, 0.9f, 1.0f), 0.9f},
                                         SeenPatch{grey(0.3f, 0.6f, 1.0f), 0.2f},
                                         SeenPatch{grey(0.0f, 0.9f, 10.0f), 0.5f},
                                         SeenPatch{grey(0.8f, 0.1f, 30.0f), 0.5f},
                                         SeenPatch{grey(0.1f, 0.8f, 100.0f), 0.1f},
                                         SeenPatch{grey(0.1f, 0.8f, 100.0f), 1.0f},
                                         SeenPatch{grey(0.0f, 1.0f, 1000.0f), 0.7f},
                                         SeenPatch{grey(0.5f, 0.5f, 1000.0f), 0.1f}));

/// Radiance of a point at the origin, normal +z, under a lamp: ∫ f_r L cosθ cosθ' / r² dA.
double lit_by(const Quad& lamp, const Brdf& brdf)
{
    constexpr int kSide = 400;
    const glm::vec3 across = glm::cross(lamp.edge_u, lamp.edge_v);
    double sum = 0.0;
    for (int v = 0; v < kSide; ++v)
        for (int u = 0; u < kSide; ++u) {
            const glm::vec3 offset = lamp.corner + (float(u) + 0.5f) / kSide * lamp.edge_u +
                                     (float(v) + 0.5f) / kSide * lamp.edge_v;
            const float squared = glm::dot(offset, offset);
            const glm::vec3 incoming = offset / std::sqrt(squared);
            sum += double(support::value_of(brdf, incoming).x * incoming.z *
                          std::max(0.0f, -glm::dot(across, incoming)) / squared);
        }
    return sum / (double(kSide) * kSide) * double(lamp.emission.x / support::kPi);
}

TEST(ReferenceImage, ALampIsReflectedAsItsQuadratureSays)
{
    // Small and large, so that either technique of finding it matters; in the mirror and off it.
    Quad small{{-0.6f, -0.05f, 1.0f}, {0.0f, 0.1f, 0.0f}, {0.1f, 0.0f, 0.0f}};
    Quad large{{-3.0f, -2.0f, 1.0f}, {0.0f, 4.0f, 0.0f}, {4.0f, 0.0f, 0.0f}};
    for (Quad lamp : {small, large})
        for (const float shininess : {1.0f, 10.0f, 100.0f, 1000.0f})
            for (const float aside : {0.5f, 0.75f}) {
                lamp.emission = glm::vec3(5.0f);
                lamp.albedo = glm::vec3(0.0f);
                HandMade made = make_quads({lamp, {{-0.5f, -0.5f, 0.0f}}});
                const Reflectance look = grey(0.2f, 0.7f, shininess);
                make_glossy(made.scene, 0, {});
                make_glossy(made.scene, 1, look);
                const glm::vec3 eye(aside, 0.0f, 0.9f);
                const View view{.transform = look_at(eye, glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}),
                                .vertical_fov = 1e-3f,
                                .aspect = 1.0f};
                const Image image =
                    render(made.scene, view, {.width = 4, .height = 4, .samples_per_pixel = 4096});
                const double truth =
                    lit_by(lamp, Brdf(look, {0.0f, 0.0f, 1.0f}, glm::normalize(eye)));
                EXPECT_NEAR(mean_of(image, 0), truth, 0.01 * truth)
                    << "n " << shininess << ", from x " << aside;
            }
}

TEST(ReferenceImage, AGlossyFloorReflectsALampAndTheSkyAsItsBrdfSays)
{
    // A sky with a bright texel, which rays are aimed at, and without.
    const glm::vec3 place(-0.8f, 0.1f, 1.0f), toward = support::direction_of(0.7, 0.1);
    const View view{.transform = look_at(1.5f * toward, glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}),
                    .vertical_fov = 1e-3f,
                    .aspect = 1.0f};
    for (const float bright : {1.0f, 100.0f})
        for (const float shininess : {1.0f, 10.0f, 100.0f}) {
            const Reflectance look = grey(0.2f, 0.7f, shininess);
            HandMade made = make_quads({{{-0.5f, -0.5f, 0.0f}}});
            make_glossy(made.scene, 0, look);
            made.scene.lights = {support::make_lamp(PunctualLight::Kind::point, 5.0f, place)};
            made.scene.sky = {16, 8, std::vector<glm::vec3>(16 * 8, glm::vec3(1.0f))};
            made.scene.sky.radiance[4 * 16 + 13] = glm::vec3(bright);
            const Image image =
                render(made.scene, view, {.width = 4, .height = 4, .samples_per_pixel = 4096});
            const Brdf brdf(look, {0.0f, 0.0f, 1.0f}, toward);
            const glm::vec3 direction = glm::normalize(place);
            const double from_lamp =
                double(support::value_of(brdf, direction).x * 5.0f * direction.z) /
                double(glm::dot(place, place));
            const double from_sky = support::over_hemisphere([&](const glm::vec3& incoming) {
                return support::value_of(brdf, incoming).x * incoming.z *
                       sky_radiance(made.scene.sky, incoming).x;
            });
            const double truth = from_lamp + from_sky;
            EXPECT_NEAR(mean_of(image, 0), truth, 0.01 * truth)
                << "n " << shininess << ", bright " << bright;
        }
}

TEST(ReferenceImage, ThingsAreSeenWhereTheyAre)
{
    // A lamp that fills the top left quarter of what a camera at the origin sees.
    Quad lamp{{-1.5f, 0.0f, -1.0f}, {1.5f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    lamp.albedo = glm::vec3(0.0f);
    lamp.emission = glm::vec3(support::kPi, 0.0f, 0.0f);
    const HandMade made = make_quads({lamp});
    View view{.vertical_fov = support::kPi / 2.0f, .aspect = 1.5f};
    for (const float height : {0.0f, 2.0f}) {
        view.orthographic_height = height;
        const Image image =
            render(made.scene, view, {.width = 6, .height = 4, .samples_per_pixel = 4});
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x) {
                const float seen = x < 3 && y < 2 ? 1.0f : 0.0f;
                EXPECT_NEAR(image.at(x, y)[0], seen, 1e-6f);
                EXPECT_EQ(image.at(x, y)[1], 0.0f);
                EXPECT_EQ(image.at(x, y)[3], seen);
            }
    }
}

TEST(ReferenceImage, AlphaIsTheShareOfAPixelWhereSomethingIs)
{
    Quad lamp{{-1.0f, -1.0f, -1.0f}, {1.25f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}};
    lamp.albedo = glm::vec3(0.0f);
    lamp.emission = glm::vec3(support::kPi);
    HandMade made = make_quads({lamp});
    const View view{.aspect = 1.0f, .orthographic_height = 2.0f};
    const ReferenceImageOptions options{.width = 2, .height = 1, .samples_per_pixel = 1024};
    const Image cut = render(made.scene, view, options);
    EXPECT_EQ(cut.at(0, 0)[3], 1.0f);
    EXPECT_NEAR(cut.at(1, 0)[3], 0.25f, 0.01f);
    EXPECT_FLOAT_EQ(cut.at(1, 0)[0], cut.at(1, 0)[3]);

    made.scene.materials[0].alpha_mode = AlphaMode::blend;
    made.scene.materials[0].base_color.a = 0.5f;
    const Image veil = render(made.scene, view, options);
    EXPECT_NEAR(veil.at(0, 0)[3], 0.5f, 0.07f);
    EXPECT_FLOAT_EQ(veil.at(0, 0)[0], veil.at(0, 0)[3]);
}

TEST(ReferenceImage, BacksOfSingleSidedSurfacesAreSeenBlack)
{
    Quad lamp{{-1.0f, -1.0f, -1.0f}, {0.0f, 2.0f, 0.0f}, {2.0f, 0.0f, 0.0f}};
    lamp.emission = glm::vec3(1.0f);
    const HandMade made = make_quads({lamp});
    const Image image = render(made.scene, {.aspect = 1.0f, .orthographic_height = 1.0f},
                               {.width = 1, .height = 1});
    EXPECT_EQ(image.values, (std::vector<float>{0.0f, 0.0f, 0.0f, 1.0f}));
}

TEST(ReferenceImage, OneSeedGivesTheSameBytesAndAnotherSeedOthers)
{
    Quad look;
    look.emission = glm::vec3(1.0f);
    const auto walls = box_walls(glm::vec3(-1.0f), glm::vec3(1.0f), true, look);
    const HandMade made = make_quads({walls.begin(), walls.end()});
    ReferenceImageOptions options{.width = 3, .height = 3, .samples_per_pixel = 8};
    const Image first = render(made.scene, {}, options);
    EXPECT_EQ(first.values, render(made.scene, {}, options).values);
    options.seed = 2;
    EXPECT_NE(first.values, render(made.scene, {}, options).values);
}

TEST(ReferenceImage, AStopBeforeAllPixelsHaveASampleGivesNone)
{
    const HandMade made = make_quads({Quad{}});
    const Image image = reference_image(made.scene, RayScene(made.scene), {.aspect = 1.0f},
                                        {.width = 200, .height = 200, .samples_per_pixel = 1},
                                        [](double) { return false; });
    EXPECT_TRUE(image.values.empty());
}

TEST(ReferenceImage, AStoppedPictureKeepsWhatItHas)
{
    Quad lamp{{-1.0f, -1.0f, -1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}};
    lamp.emission = glm::vec3(support::kPi);
    const HandMade made = make_quads({lamp});
    const Image image = reference_image(
        made.scene, RayScene(made.scene), {.aspect = 1.0f, .orthographic_height = 1.0f},
        {.width = 2, .height = 2, .samples_per_pixel = 1 << 30}, [](double) { return false; });
    EXPECT_NEAR(image.at(1, 1)[0], 1.0f, 1e-6f);
    EXPECT_EQ(image.at(1, 1)[3], 1.0f);
}

}  // namespace
}  // namespace lumel
