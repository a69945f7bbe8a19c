// What hemicubes say about visibility, held against rays.

#include <random>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "rays/ray_scene.h"
#include "visibility/hemicube.h"

namespace lumel {
namespace {

constexpr std::uint32_t kProbeSpirv[] = {
#include "../tests/visibility/probe.comp.inc"
};

struct Question {
    glm::vec3 position;
    glm::vec3 facing;
};

struct ProbeParams {
    HemicubeLayout layout;
    std::uint32_t eye, count;
};

Eye eye_at(const glm::vec3& position, const glm::vec3& normal)
{
    const glm::vec3 other = std::abs(normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 t = glm::normalize(glm::cross(other, normal) +
                                       0.3f * glm::cross(normal, glm::cross(other, normal)));
    return {position, t, glm::cross(normal, t), normal, 1u};
}

/// Answers of all eyes to all questions, [eye][question].
std::vector<std::vector<std::uint32_t>> ask(const gpu::Device& device, const World& world,
                                            const std::vector<Eye>& eyes,
                                            const std::vector<Question>& questions, bool in_parts)
{
    constexpr gpu::Slot slots[] = {gpu::Slot::array, gpu::Slot::array, gpu::Slot::texture,
                                   gpu::Slot::array};
    const gpu::Kernel probe(device, "probe", kProbeSpirv, slots, sizeof(ProbeParams), 64);
    const gpu::Array<Eye> eye_array(device, std::span<const Eye>(eyes));
    const gpu::Array<Question> question_array(device, std::span<const Question>(questions));
    const gpu::Array<std::uint32_t> answers(device, questions.size());
    Hemicubes hemicubes(device, world, 256, std::uint32_t(eyes.size()));
    gpu::Commands commands(device);
    if (in_parts)
        for (std::uint32_t face = 0; face < eyes.size() * kHemicubeFaces; ++face)
            hemicubes.look_from_faces(commands, eye_array, face, face + 1);
    else
        hemicubes.look_from(commands, eye_array, std::uint32_t(eyes.size()));
    commands.run();
    std::vector<std::vector<std::uint32_t>> all;
    for (std::uint32_t eye = 0; eye < eyes.size(); ++eye) {
        commands.dispatch(
            probe, {eye_array, question_array, {hemicubes.image(), hemicubes.sampler()}, answers},
            ProbeParams{hemicubes.layout(), eye, std::uint32_t(questions.size())},
            questions.size());
        commands.run();
        all.push_back(answers.download());
    }
    return all;
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
    double wrong = 0.0;  ///< share of all asked
    double wrongly_seen = 0.0;
};

Agreement agreement(bool in_parts)
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
    const auto answers = ask(device, world, eyes, questions, in_parts);
    std::size_t asked = 0, wrong = 0, wrongly_seen = 0;
    for (std::size_t e = 0; e < eyes.size(); ++e)
        for (std::size_t q = 0; q < questions.size(); ++q) {
            const glm::vec3 d = questions[q].position - eyes[e].position;
            if (glm::dot(d, eyes[e].normal) <= 1e-3f || glm::dot(d, questions[q].facing) >= -1e-3f)
                continue;
            const bool truth = rays.sees(eyes[e].position, questions[q].position, 1e-4f, 1);
            const bool answer = answers[e][q] != 0;
            ++asked;
            wrong += truth != answer;
            wrongly_seen += answer && !truth;
        }
    EXPECT_GT(asked, 10000u);
    EXPECT_EQ(device.validation_messages(), "");
    return {double(wrong) / double(asked), double(wrongly_seen) / double(asked)};
}

// Pixels of 1/256 of a face leave some doubt at the edges of shadows, and nowhere else.
TEST(Hemicube, AgreesWithRaysButAtTheEdgesOfShadows)
{
    const Agreement result = agreement(false);
    EXPECT_LT(result.wrong, 0.006);
    EXPECT_LT(result.wrongly_seen, 0.004);
}

TEST(Hemicube, DrawnFaceByFaceSeesTheSame)
{
    EXPECT_DOUBLE_EQ(agreement(true).wrong, agreement(false).wrong);
}

TEST(Occluders, WallsOfAConvexRoomHideNothing)
{
    std::vector<support::Quad> quads;
    for (const support::Quad& wall : support::box_walls(glm::vec3(0.0f), glm::vec3(1.0f), true))
        quads.push_back(wall);
    const support::HandMade empty = support::make_quads(quads);
    EXPECT_EQ(find_occluders(empty.scene).indices.size(), 0u);
    EXPECT_EQ(find_occluders(empty.scene, false).indices.size(), 36u);
    // The room with blocks keeps the blocks' 24 triangles but for the bottoms, which lie in the
    // floor's plane.
    EXPECT_EQ(find_occluders(room_with_blocks().scene).indices.size() / 3, 20u);
}

}  // namespace
}  // namespace lumel
