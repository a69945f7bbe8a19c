// The visibility that eyes find by either projection, compared with rays.

#include <random>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "raster/eyes/probe.h"
#include "rays/cast/ray_scene.h"

namespace lumel {
namespace {

/// Answers of all eyes to all questions, [eye][question].
std::vector<std::vector<std::uint32_t>> look_and_ask(const gpu::Device& device, const World& world,
                                                     const std::vector<Eye>& eyes,
                                                     const std::vector<Question>& questions,
                                                     Projection projection, bool in_parts)
{
    const gpu::Array<Eye> eye_array(device, std::span<const Eye>(eyes));
    const gpu::Array<Question> question_array(device, std::span<const Question>(questions));
    EyeViews views(device, world, projection, 256, std::uint32_t(eyes.size()));
    gpu::Commands commands(device);
    if (in_parts)
        for (std::uint32_t face = 0; face < eyes.size() * views.faces_per_eye(); ++face)
            views.look_from_faces(commands, eye_array, face, face + 1);
    else
        views.look_from(commands, eye_array, std::uint32_t(eyes.size()));
    commands.run();
    return ask(device, views, eye_array, question_array);
}

/// A room of 2 m with two blocks standing in it.
support::HandMade room_with_blocks()
{
    std::vector<support::Quad> quads;
    const auto add = [&](const glm::vec3& low, const glm::vec3& high, bool inward, int res) {
        for (support::Quad wall : support::box_walls(low, high, inward)) {
            wall.res_u = wall.res_v = res;
            quads.push_back(wall);
        }
    };
    add(glm::vec3(-1.0f), glm::vec3(1.0f), true, 24);
    add({-0.6f, -1.0f, -0.5f}, {-0.1f, 0.1f, 0.0f}, false, 12);
    add({0.2f, -1.0f, 0.1f}, {0.7f, -0.5f, 0.6f}, false, 12);
    return support::make_quads(quads);
}

struct Agreement {
    double wrong = 0.0;  ///< share of all tested
    double wrongly_seen = 0.0;
    double wrong_light = 0.0;  ///< share of cosθ cosθ' / r², of all that is seen
};

Agreement agreement(Projection projection, bool in_parts)
{
    const support::HandMade room = room_with_blocks();
    const RayScene rays(room.scene);
    const gpu::Device device;
    const World world(device, room.scene, room.lumels);
    std::mt19937 random(3);
    std::vector<Eye> eyes;
    std::vector<Question> questions;
    for (const Lumel& lumel : room.lumels.lumels)
        questions.push_back({lumel.position, lumel.normal});
    for (int i = 0; i < 12; ++i) {
        const Lumel& lumel = room.lumels.lumels[random() % room.lumels.lumels.size()];
        eyes.push_back(eye_at(lumel.position, lumel.normal));
    }
    const auto answers = look_and_ask(device, world, eyes, questions, projection, in_parts);
    std::size_t tested = 0, wrong = 0, wrongly_seen = 0;
    double light = 0.0, wrong_light = 0.0;
    for (std::size_t e = 0; e < eyes.size(); ++e)
        for (std::size_t q = 0; q < questions.size(); ++q) {
            const glm::vec3 d = questions[q].position - eyes[e].position;
            if (glm::dot(d, eyes[e].normal) <= 1e-3f || glm::dot(d, questions[q].facing) >= -1e-3f)
                continue;
            const bool truth = rays.sees(eyes[e].position, questions[q].position, 1e-4f, 1);
            const bool answer = answers[e][q] != 0;
            ++tested;
            wrong += truth != answer;
            wrongly_seen += answer && !truth;
            const double r2 = double(glm::dot(d, d));
            const double factor = -double(glm::dot(d, eyes[e].normal)) *
                                  double(glm::dot(d, questions[q].facing)) / (r2 * r2);
            light += truth ? factor : 0.0;
            wrong_light += truth != answer ? factor : 0.0;
        }
    EXPECT_GT(tested, 10000u);
    EXPECT_EQ(device.validation_messages(), "");
    return {double(wrong) / double(tested), double(wrongly_seen) / double(tested),
            wrong_light / light};
}

struct Bounds {
    const char* name;
    Projection projection;
    double wrong;  ///< share of all pairs
};

void PrintTo(const Bounds& bounds, std::ostream* out)
{
    *out << bounds.name;
}

class Views : public testing::TestWithParam<Bounds> {};

// Pixels of 1/256 of a face leave some doubt at the edges of shadows, and nowhere else. On the disc
// of a hemisphere pixels are high toward the horizon, where there are many pairs and little light.
TEST_P(Views, AgreeWithRaysButAtTheEdgesOfShadows)
{
    const Agreement result = agreement(GetParam().projection, false);
    EXPECT_LT(result.wrong, GetParam().wrong);
    EXPECT_LT(result.wrongly_seen, 0.004);
    EXPECT_LT(result.wrong_light, 0.003);
}

TEST_P(Views, DrawnFaceByFaceSeeTheSame)
{
    EXPECT_DOUBLE_EQ(agreement(GetParam().projection, true).wrong,
                     agreement(GetParam().projection, false).wrong);
}

/// Of the light that eyes low above an open floor send to it below a cosine of 0.1: the share seen.
double grazing_light_seen(Projection projection)
{
    constexpr float kGrazing = 0.1f;
    // Only what has something on both sides is drawn.
    const support::HandMade place = support::make_quads(
        {{.corner = {-1.0f, -1.0f, 0.0f}, .edge_u = {5, 0, 0}, .edge_v = {0, 2, 0}},
         {.corner = {-1.0f, -1.0f, -0.5f}, .edge_u = {5, 0, 0}, .edge_v = {0, 2, 0}},
         {.corner = {-1.0f, -1.0f, 1.0f}, .edge_u = {5, 0, 0}, .edge_v = {0, 2, 0}}});
    EXPECT_EQ(find_occluders(place.scene).inner_indices().size() / 3, 2u);
    const gpu::Device device;
    const World world(device, place.scene, place.lumels);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Eye> eyes;
    std::vector<Question> questions;
    for (int i = 0; i < 24; ++i) {
        const glm::vec3 direction(1.0f, unit(random) - 0.5f, 0.4f * (unit(random) - 0.5f));
        eyes.push_back(
            eye_at({0.0f, 0.0f, 0.005f + 0.1f * unit(random)}, glm::normalize(direction)));
    }
    for (int i = 0; i < 20000; ++i)
        questions.push_back(
            {{4.0f * unit(random), 1.8f * unit(random) - 0.9f, 0.0f}, {0.0f, 0.0f, 1.0f}});
    const auto answers = look_and_ask(device, world, eyes, questions, projection, false);
    double light = 0.0, seen = 0.0;
    for (std::size_t e = 0; e < eyes.size(); ++e)
        for (std::size_t q = 0; q < questions.size(); ++q) {
            const glm::vec3 d = questions[q].position - eyes[e].position;
            const float r = glm::length(d), toward = glm::dot(d, eyes[e].normal);
            if (toward <= 0.0f || -d.z > kGrazing * r)
                continue;
            const double factor = double(toward * -d.z) / std::pow(double(r), 4.0);
            light += factor;
            seen += answers[e][q] ? factor : 0.0;
        }
    EXPECT_EQ(device.validation_messages(), "");
    return seen / light;
}

// Between two pixels a plane that is met at a grazing angle comes nearer by a large part.
TEST_P(Views, ShowAnOpenFloorAtAnyAngle)
{
    EXPECT_GT(grazing_light_seen(GetParam().projection), 0.99);
}

// Eyes outside that lie almost in the plane of an inner wall see it edge-on, through the outer one.
TEST_P(Views, ShowNothingInsideAClosedBox)
{
    constexpr float kInner = 0.28f, kOuter = 0.3f;
    std::vector<support::Quad> quads;
    for (support::Quad wall : support::box_walls(glm::vec3(-kInner), glm::vec3(kInner), true)) {
        wall.res_u = wall.res_v = 48;
        quads.push_back(wall);
    }
    for (const support::Quad& wall :
         support::box_walls(glm::vec3(-kOuter), glm::vec3(kOuter), false))
        quads.push_back(wall);
    for (const support::Quad& wall : support::box_walls(glm::vec3(-3.0f), glm::vec3(3.0f), true))
        quads.push_back(wall);
    const support::HandMade place = support::make_quads(quads);
    const gpu::Device device;
    const World world(device, place.scene, place.lumels);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Eye> eyes;
    for (int i = 0; i < 120; ++i) {
        const int axis = i % 3;
        glm::vec3 place_of_eye, toward;
        for (int c = 0; c < 3; ++c)
            place_of_eye[c] = 2.0f * (unit(random) - 0.5f);
        place_of_eye[axis] = (i % 2 == 0 ? -1.0f : 1.0f) * (kInner - 0.03f * unit(random));
        place_of_eye[(axis + 1) % 3] = i % 4 < 2 ? -0.35f - 1.2f * unit(random) : kOuter + 0.05f;
        for (int c = 0; c < 3; ++c)
            toward[c] = 0.6f * (unit(random) - 0.5f) - place_of_eye[c];
        eyes.push_back(eye_at(place_of_eye, glm::normalize(toward)));
    }
    std::vector<Question> questions;
    for (std::size_t i = 0; i < place.first[6]; ++i)
        questions.push_back({place.lumels.lumels[i].position, place.lumels.lumels[i].normal});
    const auto answers = look_and_ask(device, world, eyes, questions, GetParam().projection, false);
    std::size_t tested = 0, seen = 0;
    for (std::size_t e = 0; e < eyes.size(); ++e)
        for (std::size_t q = 0; q < questions.size(); ++q) {
            const glm::vec3 d = questions[q].position - eyes[e].position;
            if (glm::dot(d, eyes[e].normal) <= 0.0f || glm::dot(d, questions[q].facing) >= 0.0f)
                continue;
            ++tested;
            seen += answers[e][q];
        }
    EXPECT_GT(tested, 100000u);
    EXPECT_EQ(seen, 0u);
    EXPECT_EQ(device.validation_messages(), "");
}

/// The room with a screen across its middle: 4 x 4 fields, every other one with alpha 0.
support::HandMade room_with_screen(AlphaMode mode)
{
    std::vector<support::Quad> quads;
    for (support::Quad wall : support::box_walls(glm::vec3(-1.0f), glm::vec3(1.0f), true)) {
        wall.res_u = wall.res_v = 40;
        quads.push_back(wall);
    }
    quads.push_back({.corner = {-0.8f, -0.9f, 0.05f},
                     .edge_u = {1.6f, 0.0f, 0.1f},
                     .edge_v = {0.0f, 1.8f, 0.1f}});
    support::HandMade room = support::make_quads(quads);
    Texture screen{.width = 64, .height = 64};
    for (int i = 0; i < 64 * 64; ++i) {
        const bool open = (i % 64 / 16 + i / 64 / 16) % 2 != 0;
        screen.rgba.insert(screen.rgba.end(), {255, 255, 255, std::uint8_t(open ? 0 : 255)});
    }
    room.scene.textures.push_back(screen);
    Material& material = room.scene.materials.back();
    material.alpha_mode = mode;
    material.base_color_texture.texture = 0;
    if (mode == AlphaMode::blend) {
        material.base_color.a = 0.25f;
        material.base_color_texture.texture = -1;
    }
    return room;
}

/// Of the pairs from the wall at z = -1 to that at z = 1: the share that rays see, that is seen,
/// and on which both disagree.
struct Through {
    double by_rays = 0.0, seen = 0.0, wrong = 0.0;
};

Through look_through(AlphaMode mode, Projection projection)
{
    constexpr std::size_t near_wall = 4, far_wall = 5;
    const support::HandMade room = room_with_screen(mode);
    const RayScene rays(room.scene);
    const gpu::Device device;
    const World world(device, room.scene, room.lumels);
    std::vector<Eye> eyes;
    std::vector<Question> questions;
    for (std::size_t i = room.first[near_wall]; i < room.first[near_wall + 1]; i += 101) {
        eyes.push_back(eye_at(room.lumels.lumels[i].position, room.lumels.lumels[i].normal));
        eyes.back().random = std::uint32_t(i);
    }
    for (std::size_t i = room.first[far_wall]; i < room.first[far_wall + 1]; ++i)
        questions.push_back({room.lumels.lumels[i].position, room.lumels.lumels[i].normal});
    const auto answers = look_and_ask(device, world, eyes, questions, projection, false);
    Through through;
    const double share = 1.0 / double(eyes.size() * questions.size());
    for (std::size_t e = 0; e < eyes.size(); ++e)
        for (std::size_t q = 0; q < questions.size(); ++q) {
            const bool truth = rays.sees(eyes[e].position, questions[q].position, 1e-4f,
                                         std::uint32_t(e * questions.size() + q));
            through.by_rays += truth ? share : 0.0;
            through.seen += answers[e][q] ? share : 0.0;
            through.wrong += truth != (answers[e][q] != 0) ? share : 0.0;
        }
    EXPECT_EQ(device.validation_messages(), "");
    return through;
}

TEST_P(Views, ShowWhatIsCutOutOfASurface)
{
    const Through through = look_through(AlphaMode::mask, GetParam().projection);
    EXPECT_GT(through.by_rays, 0.4);
    EXPECT_LT(through.by_rays, 0.7);
    EXPECT_LT(through.wrong, 0.02);
    EXPECT_NEAR(through.seen, through.by_rays, 0.005);
}

TEST_P(Views, LetABlendedSurfacesShareOfLightThrough)
{
    const Through through = look_through(AlphaMode::blend, GetParam().projection);
    EXPECT_LT(through.by_rays, 0.9);
    EXPECT_NEAR(through.seen, through.by_rays, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Of, Views,
                         testing::Values(Bounds{"Hemicubes", Projection::hemicube, 0.006},
                                         Bounds{"Hemispheres", Projection::hemisphere, 0.008}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Occluders, WallsOfAConvexRoomHideNothing)
{
    std::vector<support::Quad> quads;
    for (const support::Quad& wall : support::box_walls(glm::vec3(0.0f), glm::vec3(1.0f), true))
        quads.push_back(wall);
    const support::HandMade empty = support::make_quads(quads);
    EXPECT_EQ(find_occluders(empty.scene).inner_indices().size(), 0u);
    EXPECT_EQ(find_occluders(empty.scene, std::vector<char>(empty.scene.instances.size(), 1))
                  .inner_indices()
                  .size(),
              36u);
    // The room with blocks keeps the blocks' 24 triangles but for the bottoms, which lie in the
    // floor's plane.
    EXPECT_EQ(find_occluders(room_with_blocks().scene).inner_indices().size() / 3, 20u);
}

}  // namespace
}  // namespace lumel
