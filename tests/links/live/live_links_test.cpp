// A scene that was edited is lit as one that always was so.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "alike.h"
#include "base/core/error.h"
#include "base/core/frame.h"
#include "links/live/direction_cells.h"
#include "links/live/live_links.h"
#include "open_box.h"

namespace lumel {
namespace {

using namespace test;

constexpr int kSide = 64;  // of the atlas [texels]
constexpr float kPi = 3.14159265358979f;
const std::string kBlock = "short block", kLight = "light";

Scene read(const std::string& name)
{
    return read_gltf(support::source_path("scenes/" + name));
}

LiveLinksOptions options_for(const std::vector<std::string>& things)
{
    return {.rays = 16, .things = things};
}

std::unique_ptr<SolveScene> laid_out(const Scene& scene, const std::vector<std::string>& things)
{
    return lay_out(scene, {.size = kSide}, things);
}

/// Each lumel's error, as a part of the mean light [largest].
double farthest(const Lights& values, const Lights& truth)
{
    double mean = 0.0, most = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        mean += double(truth[i].r + truth[i].g + truth[i].b) / (3.0 * double(values.size()));
        most = std::max(most, double(glm::length(values[i] - truth[i])));
    }
    EXPECT_GT(mean, 0.0);
    return most / mean;
}

/// Turned about a point, then shifted.
glm::mat4 motion(const glm::vec3& about, float angle, const glm::vec3& axis, const glm::vec3& shift)
{
    const glm::mat4 back = glm::translate(glm::mat4(1.0f), about + shift);
    return glm::translate(glm::rotate(back, angle, glm::normalize(axis)), -about);
}

/// The scene that a live one has come to, prepared from nothing on the same lumels.
LiveLinks anew(const LiveLinks& live, const LiveLinksOptions& options)
{
    return {copy_of(live.solve_scene()), options};
}

TEST(LiveLinks, ClosedRoomGlowsByItsLampDimmed)
{
    for (const auto& [name, albedo] :
         {std::pair("furnace-0.5.gltf", 0.5f), {"furnace-0.9.gltf", 0.9f}}) {
        const Scene scene = read(name);
        const float sent = kPi * scene.materials[0].emitted.r;
        LiveLinks live(lay_out(scene, {.size = 32}, {}), options_for({}));
        for (const float factor : {1.0f, 0.25f, 3.0f}) {
            live.set_lamp("wall", glm::vec3(factor));
            EXPECT_TRUE(live.settle().at_rest);
            double mean = 0.0;
            const Lights light = live.irradiance();
            for (const glm::vec3& one : light) {
                const float glow = one.r * (1.0f - albedo) / (sent * factor);
                EXPECT_NEAR(glow, 1.0f, 1e-2f) << name;  // the ends of some rays are in a corner
                mean += double(glow) / double(light.size());
            }
            EXPECT_NEAR(mean, 1.0, 1e-3) << name;
        }
    }
}

TEST(LiveLinks, RoomWhoseOnlyLampIsOffIsDark)
{
    LiveLinks live(laid_out(read("cornell-box.gltf"), {}), options_for({}));
    live.settle();
    live.set_lamp(kLight, glm::vec3(0.0f));
    live.settle();
    const Lights off = live.irradiance();
    live.set_lamp(kLight, glm::vec3(1.0f));
    live.settle();
    const Lights on = live.irradiance();
    double left = 0.0, all = 0.0;
    for (std::size_t i = 0; i < on.size(); ++i) {
        left += double(off[i].r + off[i].g + off[i].b);
        all += double(on[i].r + on[i].g + on[i].b);
    }
    EXPECT_LT(left, 1e-3 * all);
}

TEST(LiveLinks, LightIsTheSumOfWhatEachSenderSends)
{
    LiveLinks live(laid_out(open_box_in_the_sun(), {}), options_for({}));
    live.settle();
    const Lights all = live.irradiance();
    const auto only = [&](const std::string& name) {
        for (const std::string sender : {"lamp", "sun", "light"})
            live.set_lamp(sender, glm::vec3(sender == name ? 1.0f : 0.0f));
        live.set_sky(glm::vec3(name == "sky" ? 1.0f : 0.0f));
        live.settle();
        return live.irradiance();
    };
    Lights sum(all.size());
    for (const std::string name : {"lamp", "sun", "light", "sky"}) {
        const Lights of_one = only(name);
        double light = 0.0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += of_one[i];
            light += double(of_one[i].g);
        }
        EXPECT_GT(light, 0.0) << name;
    }
    EXPECT_LT(farthest(sum, all), 2e-3);
}

TEST(LiveLinks, EditsEndWhereASolutionFromNothingDoes)
{
    const LiveLinksOptions options = options_for({});
    Scene scene = open_box_in_the_sun();
    LiveLinks live(laid_out(scene, {}), options);
    live.settle();
    const glm::mat4 there = glm::translate(glm::mat4(1.0f), glm::vec3(0.4f, 0.45f, 0.1f));
    const glm::vec3 lamp(0.2f, 0.6f, 1.0f), sky(0.3f, 0.3f, 0.6f), blue(0.1f, 0.2f, 0.7f);
    live.set_albedo("red", glm::vec3(0.0f));
    live.set_lamp("lamp", glm::vec3(0.0f));
    live.advance(0.0);
    live.set_albedo("red", blue);
    live.set_lamp("lamp", lamp);
    live.set_sky(sky);
    live.move_lamp("lamp", there);
    EXPECT_TRUE(live.settle().at_rest);

    for (Material& material : scene.materials)
        if (material.name == "red")
            material.base_color = glm::vec4(blue, 1.0f);
    scene.lights[0].color *= lamp;
    scene.lights[0].transform = there;
    for (glm::vec3& radiance : scene.sky.radiance)
        radiance *= sky;
    LiveLinks fresh(laid_out(scene, {}), options);
    fresh.settle();
    EXPECT_LT(farthest(live.irradiance(), fresh.irradiance()), 1e-3);
    EXPECT_LT(dark_error(live.irradiance(), fresh.irradiance()), 1e-3);
}

TEST(LiveLinks, MovedAtRandomLinksAndDirectLightAreThoseOfTheLastPlace)
{
    const LiveLinksOptions options = options_for({kBlock, kLight});
    LiveLinks live(laid_out(open_box_in_the_sun(), options.things), options);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f);
    const auto vector = [&](float size) {
        return size * glm::vec3(any(random), any(random), any(random));
    };
    std::uint64_t retraced = 0;
    for (int k = 0; k < 20; ++k) {
        const std::string& thing = k % 4 == 2 ? kLight : kBlock;
        // Through walls too, and out of the box.
        retraced += live.move(thing, motion(glm::vec3(0.2f), kPi * any(random), vector(1.0f),
                                            vector(k % 5 == 4 ? 0.8f : 0.2f)))
                        .links.all();
        live.advance(0.0);
    }
    EXPECT_LT(retraced, 20 * live.lumels().lumels.size() * options.rays / 3);
    LiveLinks fresh = anew(live, options);
    EXPECT_EQ(different(live, fresh), 0u);
    live.settle();
    fresh.settle();
    EXPECT_LT(farthest(live.irradiance(), fresh.irradiance()), 1e-3);
}

TEST(LiveLinks, ShadowsOfABoxAlongTheAxesMoveToTheirEdges)
{
    const std::string box = "box";
    const LiveLinksOptions options = options_for({box});
    Scene scene = read("moving-small-lamp.gltf");
    PunctualLight lamp{.name = "lamp", .intensity = 20.0f, .radius = 0.1f};
    lamp.transform = glm::translate(glm::mat4(1.0f), glm::vec3(0.6f, 1.8f, 0.6f));
    scene.lights.push_back(lamp);
    scene.instances.erase(scene.instances.begin() + find_instance(scene, "wall -z"));
    PunctualLight sun{.kind = PunctualLight::Kind::directional, .name = "sun", .angle = 0.05f};
    sun.transform[2] = glm::vec4(glm::normalize(glm::vec3(0.1f, 0.3f, -1.0f)), 0.0f);
    scene.lights.push_back(sun);
    LiveLinks live(laid_out(scene, options.things), options);
    for (const glm::vec3& shift :
         {glm::vec3(0.1f, 0.0f, 0.0f), glm::vec3(0.0f, 0.3f, 0.2f), glm::vec3(-0.2f, 0.1f, 0.1f)}) {
        live.move(box, glm::translate(glm::mat4(1.0f), shift));
        LiveLinks fresh = anew(live, options);
        EXPECT_EQ(different(live, fresh), 0u);
    }
}

TEST(LiveLinks, MovedBackNothingIsDifferent)
{
    const LiveLinksOptions options = options_for({kBlock});
    LiveLinks live(laid_out(open_box_in_the_sun(), options.things), options),
        still = anew(live, options);
    live.move(kBlock,
              motion(glm::vec3(0.2f), 0.7f, glm::vec3(0, 1, 0), glm::vec3(0.1f, 0.0f, 0.1f)));
    EXPECT_GT(different(live, still), 0u);
    live.move(kBlock, glm::mat4(1.0f));
    EXPECT_EQ(different(live, still), 0u);
}

TEST(LiveLinks, SendersThatShareAGroupAreDimmedTheSame)
{
    LiveLinksOptions options = options_for({}), narrow = options;
    narrow.light.most_bytes = 1;
    LiveLinks apart(laid_out(open_box_in_the_sun(), {}), options),
        shared(laid_out(open_box_in_the_sun(), {}), narrow);
    for (LiveLinks* live : {&apart, &shared}) {
        live->set_lamp("lamp", glm::vec3(0.3f));
        live->set_lamp("sun", glm::vec3(0.1f, 0.2f, 0.3f));
        live->set_lamp("lamp", glm::vec3(0.5f));
    }
    EXPECT_LT(farthest(shared.direct(), apart.direct()), 1e-5);
}

/// Cosines at both ends by the square of the distance, over a quad of one triangle pair [sr].
double seen_by_cosine(const glm::vec3& place, const glm::vec3& normal, const glm::vec3& corner,
                      const glm::vec3& u, const glm::vec3& v)
{
    constexpr int kPoints = 64;  // along each side
    const glm::vec3 across = glm::cross(u, v);
    double sum = 0.0;
    for (int k = 0; k < kPoints * kPoints; ++k) {
        const glm::vec2 at = (glm::vec2(k % kPoints, k / kPoints) + 0.5f) / float(kPoints);
        const glm::vec3 way = corner + at.x * u + at.y * v - place;
        const double squared = glm::dot(way, way);
        sum += std::max(double(glm::dot(normal, way)), 0.0) *
               std::abs(double(glm::dot(across, way))) / (squared * squared);
    }
    return sum / double(kPoints * kPoints);
}

TEST(LiveLinks, AFaceThatSeesAPartOfALampAboveItsHorizonHasItsLightWithoutNoise)
{
    LiveLinks live(lay_out(read("cornell-box.gltf"), {.size = 2 * kSide}, {}), options_for({}));
    const Lights direct = live.direct();
    const Scene& scene = live.scene();
    const Primitive& lamp =
        scene.meshes[std::size_t(scene.instances[find_instance(scene, kLight)].mesh)].primitives[0];
    ASSERT_EQ(lamp.positions.size(), 4u);
    glm::vec3 low = lamp.positions[0], high = low;
    for (const glm::vec3& corner : lamp.positions) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    const std::uint32_t block = find_instance(scene, "tall block");
    const RayScene rays(scene);
    const WorldLumels world(scene, rays, live.lumels());
    double light = 0.0, form = 0.0;
    std::vector<glm::dvec2> pairs;
    for (std::size_t i = 0; i < direct.size(); ++i) {
        // The face towards the camera, above all that could stand before it.
        if (live.lumels().lumels[i].instance != block || !(world[i].normal.z < -0.9f) ||
            world[i].centre.y < 0.2f || world[i].centre.y > 0.31f)
            continue;
        const double seen = seen_by_cosine(world[i].centre, world[i].normal, low,
                                           glm::vec3(high.x - low.x, 0.0f, 0.0f),
                                           glm::vec3(0.0f, 0.0f, high.z - low.z));
        pairs.emplace_back(double(direct[i].g), seen);
        light += pairs.back().x;
        form += seen;
    }
    ASSERT_GT(pairs.size(), 30u);
    ASSERT_GT(form, 0.0);
    for (const glm::dvec2& pair : pairs)
        EXPECT_NEAR(pair.x / light, pair.y / form, 0.05 / double(pairs.size()));
}

TEST(LiveLinks, BudgetEndsACallAndLaterCallsFinish)
{
    LiveLinks live(laid_out(read("two-rooms.gltf"), {}), options_for({}));
    const LiveLinksState first = live.advance(0.0);
    EXPECT_FALSE(first.at_rest);
    EXPECT_LE(first.sweeps, 1);
    int calls = 1;
    while (!live.advance(0.0).at_rest)
        ++calls;
    EXPECT_GT(calls, 3);
    LiveLinks at_once(laid_out(read("two-rooms.gltf"), {}), options_for({}));
    at_once.settle();
    EXPECT_EQ(live.irradiance(), at_once.irradiance());
}

/// Direct light but for what the links bring of the sky.
Lights without_sky(LiveLinks& live)
{
    Lights light = live.direct();
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] -= live.links().sky_light()[i];
    return light;
}

TEST(LiveLinks, RequestedMovesEndWhereMovesAtOnceDo)
{
    const LiveLinksOptions options = options_for({kBlock, kLight});
    LiveLinks at_once(laid_out(open_box_in_the_sun(), options.things), options);
    LiveLinks spread(laid_out(open_box_in_the_sun(), options.things), options);
    at_once.settle();
    spread.settle();
    const Lights before = spread.irradiance();
    const glm::mat4 block = motion(glm::vec3(0.2f), 0.7f, glm::vec3(0, 1, 0), glm::vec3(0.1f)),
                    light = motion(glm::vec3(0.0f), 0.0f, glm::vec3(0, 1, 0),
                                   glm::vec3(0.05f, -0.02f, 0.0f));
    at_once.move(kBlock, block);
    at_once.move(kLight, light);
    spread.request(0, block);
    spread.request(1, light);
    int calls = 1, waited = 0;
    while (spread.advance(0.0).under_way) {
        if (spread.irradiance() == before)
            ++waited;
        else
            EXPECT_LT(farthest(without_sky(spread), without_sky(at_once)), 1e-5)
                << "shadows are shown when they are whole";
        ++calls;
    }
    EXPECT_GT(waited, 3);
    EXPECT_GT(calls, 2 * waited) << "links follow when shadows are shown";
    EXPECT_EQ(different(at_once, spread), 0u);
    at_once.settle();
    spread.settle();
    EXPECT_LT(farthest(spread.irradiance(), at_once.irradiance()), 1e-3);
}

TEST(LiveLinks, WhatIsShownOfTheSkyWaitsForTheNextSweepToo)
{
    LiveLinks live(laid_out(open_box_in_the_sun(), {}), options_for({}));
    live.settle();
    const Lights shown = live.shown();
    live.set_sky(glm::vec3(10.0f));
    EXPECT_EQ(live.shown(), shown);
    live.settle();
    EXPECT_NE(live.shown(), shown);
}

TEST(LiveLinks, ALampSetToWhatItIsChangesNothing)
{
    LiveLinks live(laid_out(open_box_in_the_sun(), {}), options_for({}));
    live.set_lamp("light", glm::vec3(0.5f));
    ASSERT_TRUE(live.settle().at_rest);
    const std::uint64_t sweeps = live.state().all_sweeps;
    live.set_lamp("light", glm::vec3(0.5f));
    live.set_sky(glm::vec3(1.0f));
    EXPECT_EQ(live.settle().all_sweeps, sweeps);
}

TEST(LiveLinks, RequestsThatComeFasterThanTheyAreFollowedEndInTheLast)
{
    const LiveLinksOptions options = options_for({kBlock});
    LiveLinks live(laid_out(open_box_in_the_sun(), options.things), options);
    live.settle();
    const Lights before = live.irradiance();
    int shown = 0;
    glm::mat4 last(1.0f);
    for (int k = 1; k <= 120; ++k) {
        const float far = 0.002f * float(k);
        last = motion(glm::vec3(0.2f), far, glm::vec3(0, 1, 0), glm::vec3(far));
        live.request(0, last);
        live.advance(0.0);
        shown += live.irradiance() != before;
    }
    EXPECT_GT(shown, 0) << "things that never stop are shown all the same";
    EXPECT_FALSE(live.state().at_rest);
    EXPECT_TRUE(live.settle().at_rest);
    LiveLinks fresh = anew(live, options);
    EXPECT_EQ(different(live, fresh), 0u);
    fresh.settle();
    EXPECT_LT(farthest(live.irradiance(), fresh.irradiance()), 1e-3);
    const std::uint32_t block = find_instance(live.scene(), kBlock);
    EXPECT_EQ(live.scene().instances[block].transform,
              last * open_box_in_the_sun().instances[block].transform);
}

/// Does a line meet the box from -1 to 1?
bool meets_unit_box(const glm::vec3& from, const glm::vec3& along)
{
    float enter = 0.0f, leave = std::numeric_limits<float>::max();
    for (int c = 0; c < 3; ++c) {
        const float a = (-1.0f - from[c]) / along[c], b = (1.0f - from[c]) / along[c];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

TEST(LiveLinks, CellsHoldAllDirectionsThatMeetABox)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f), unit(0.01f, 1.0f);
    constexpr std::uint32_t kCellsASide = 8;
    std::size_t met = 0, listed = 0, hit = 0;
    for (int k = 0; k < 2000; ++k) {
        const glm::vec3 centre(any(random), any(random), any(random));
        const glm::mat3 frame = frame_about(glm::normalize(glm::vec3(any(random), any(random), 1)));
        const float size = 0.8f * unit(random);
        const glm::mat3 half(size * unit(random) * frame[0], size * unit(random) * frame[1],
                             size * unit(random) * frame[2]);
        std::vector<char> has(kCellsASide * kCellsASide, 0);
        cells_towards(centre, half, kCellsASide).for_each(kCellsASide, [&](std::uint32_t cell) {
            has[cell] = 1;
            ++listed;
        });
        const glm::mat3 into = glm::inverse(half);
        std::vector<char> hits(has.size(), 0);
        for (int n = 0; n < 2000; ++n) {
            const glm::vec2 at(0.5f + 0.5f * any(random), 0.5f + 0.5f * any(random));
            const float r = std::sqrt(at.x), turn = 2.0f * kPi * at.y;
            const glm::vec3 d(r * std::cos(turn), r * std::sin(turn), std::sqrt(1.0f - at.x));
            if (!meets_unit_box(into * -centre, into * d))
                continue;
            ++met;
            const auto u = std::min(std::uint32_t(at.x * kCellsASide), kCellsASide - 1),
                       v = std::min(std::uint32_t(at.y * kCellsASide), kCellsASide - 1);
            EXPECT_TRUE(has[v * kCellsASide + u]) << k;
            hits[v * kCellsASide + u] = 1;
        }
        hit += std::size_t(std::count(hits.begin(), hits.end(), 1));
    }
    EXPECT_GT(met, 50000u);
    EXPECT_LT(listed, 3 * hit)
        << "of boxes that only touch a cell, few of 31 lines to it meet them";
}

TEST(Box, LiesBetweenBoxesIfALineFromOneToTheOtherMeetsIt)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f), unit(0.0f, 1.0f);
    const auto point = [&] { return glm::vec3(any(random), any(random), any(random)); };
    const auto box = [&](float size) {
        const glm::vec3 centre = point(), half = size * glm::abs(point());
        return Box{centre - half, centre + half};
    };
    const auto in = [&](const Box& of) {
        return glm::mix(of.low, of.high, glm::vec3(unit(random), unit(random), unit(random)));
    };
    // All places that lines have so far on their way are a box too.
    const auto overlap = [](const Box& from, const Box& to, const Box& with, float way) {
        const glm::vec3 low = glm::mix(from.low, to.low, way),
                        high = glm::mix(from.high, to.high, way);
        return glm::all(glm::lessThanEqual(low, with.high)) &&
               glm::all(glm::lessThanEqual(with.low, high));
    };
    int met = 0, possible = 0, told = 0;
    for (int k = 0; k < 2000; ++k) {
        const Box from = box(0.1f), to = box(0.5f), between = box(0.6f);
        bool meets = false, may = false;
        for (int n = 0; n <= 1000; ++n) {
            meets |= between.distance2(glm::mix(in(from), in(to), unit(random))) == 0.0f;
            may |= overlap(from, to, between, 1e-3f * float(n));
        }
        met += meets;
        possible += may;
        told += between.may_lie_between(from, to);
        EXPECT_TRUE(!(meets || may) || between.may_lie_between(from, to)) << k;
    }
    EXPECT_GT(met, 300);
    EXPECT_LT(told, 1.01 * possible) << "and else it does not";
}

TEST(LiveLinks, RefusesWhatItCannotDo)
{
    const Scene scene = read("cornell-box.gltf");
    EXPECT_THROW(lay_out(scene, {.size = kSide}, {"no such thing"}), Error);
    LiveLinksOptions options = options_for({kBlock});
    options.rays = 50;
    EXPECT_THROW(LiveLinks(laid_out(scene, {kBlock}), options), Error);
    LiveLinks live(laid_out(scene, {kBlock}), options_for({kBlock}));
    EXPECT_THROW(live.set_lamp("no such lamp", glm::vec3(1.0f)), Error);
    EXPECT_THROW(live.set_lamp(kLight, glm::vec3(-1.0f)), Error);
    EXPECT_THROW(live.set_sky(glm::vec3(1.0f)), Error);
    EXPECT_THROW(live.set_albedo("red", glm::vec3(1.5f)), Error);
    EXPECT_THROW(live.request(1, glm::mat4(1.0f)), Error);
    EXPECT_THROW(live.set_emission(99, glm::vec3(1.0f)), Error);
    EXPECT_THROW(live.set_light(0, glm::vec3(1.0f)), Error);
    EXPECT_THROW(live.move("tall block", glm::mat4(1.0f)), Error);
    EXPECT_THROW(live.move(kBlock, glm::scale(glm::mat4(1.0f), glm::vec3(2.0f))), Error);
}

}  // namespace
}  // namespace lumel
