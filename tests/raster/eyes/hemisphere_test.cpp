// How truly a hemisphere's disc shows a triangle, measured pixel by pixel in double precision.

#include <random>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "raster/eyes/probe.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSide = 256;
constexpr double kRadius = kSide;  // of the disc [pixels]
constexpr int kEyes = 60;

using Triangle = std::array<glm::dvec3, 3>;  // in an eye's frame

/// A triangle that is drawn: two tiny ones, on either side, keep it off the scene's hull.
Scene scene_of(const Triangle& triangle)
{
    Scene scene;
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        support::add_mesh(scene, {a, b, c}, {0, 1, 2}, Material{});
    };
    add(triangle[0], triangle[1], triangle[2]);
    for (const float side : {-3.0f, 3.0f})
        add({side, side, side}, {side, side, side + 1e-3f}, {side, side + 1e-3f, side});
    return scene;
}

double height_above(const Triangle& t)
{
    return glm::dot(t[0], glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0])));
}

/// Eyes around the triangle, from 2 mm before it to 2 m away, looking anywhere.
std::vector<Eye> eyes_around(const Triangle& triangle, std::mt19937& random)
{
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::normal_distribution<float> normal;
    const auto direction = [&] {
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    };
    std::vector<Eye> eyes;
    for (int i = 0; i < kEyes; ++i) {
        const float u = unit(random), v = unit(random) * (1.0f - u);
        const glm::vec3 on = glm::vec3(triangle[0]) + u * glm::vec3(triangle[1] - triangle[0]) +
                             v * glm::vec3(triangle[2] - triangle[0]);
        const float distance = 2.0f * std::pow(10.0f, -3.0f * unit(random));
        eyes.push_back(eye_at(on + distance * direction(), direction()));
    }
    return eyes;
}

Triangle seen_from(const Eye& eye, const Triangle& triangle)
{
    Triangle local;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 d = glm::dvec3(glm::vec3(triangle[k])) - glm::dvec3(eye.position);
        local[k] = {glm::dot(d, glm::dvec3(eye.tangent)), glm::dot(d, glm::dvec3(eye.bitangent)),
                    glm::dot(d, glm::dvec3(eye.normal))};
    }
    return local;
}

/// Distance at which a ray of length 1 meets the triangle [m]; 0: it does not.
double hit(const Triangle& t, const glm::dvec3& ray)
{
    const double e[3] = {glm::dot(ray, glm::cross(t[1], t[2])),
                         glm::dot(ray, glm::cross(t[2], t[0])),
                         glm::dot(ray, glm::cross(t[0], t[1]))};
    const bool inside = (e[0] > 0 && e[1] > 0 && e[2] > 0) || (e[0] < 0 && e[1] < 0 && e[2] < 0);
    const double distance = glm::dot(t[0], glm::cross(t[1], t[2])) / (e[0] + e[1] + e[2]);
    return inside && distance > 0.0 ? distance : 0.0;
}

/// Points of the triangle's edges on the disc [pixels], where they are above the horizon.
std::vector<glm::dvec2> outline(const Triangle& t)
{
    constexpr int samples = 4000;
    std::vector<glm::dvec2> points;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 a = glm::normalize(t[k]), b = glm::normalize(t[(k + 1) % 3]);
        const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
        for (int i = 0; i <= samples; ++i) {
            const double part = double(i) / samples;
            const glm::dvec3 direction =
                glm::normalize(a * std::sin((1.0 - part) * angle) + b * std::sin(part * angle));
            if (direction.z >= 0.0)
                points.emplace_back(glm::dvec2(direction) * kRadius + kRadius);
        }
    }
    return points;
}

double distance_to(const std::vector<glm::dvec2>& points, const glm::dvec2& at)
{
    double nearest = 1e30;
    for (const glm::dvec2& point : points)
        nearest = std::min(nearest, glm::dot(point - at, point - at));
    return std::sqrt(nearest);
}

struct Truth {
    double deviation = 0.0;  ///< how far a pixel that is wrongly drawn or not lies from an edge
    double off_plane = 0.0;  ///< how far what is stored lies off the triangle's plane [m]
    std::size_t hits = 0;
};

/// Compares one eye's disc with rays through the pixels' centres.
void compare(const Triangle& local, const float* tile, std::size_t row, float near, Truth& truth)
{
    const std::vector<glm::dvec2> edges = outline(local);
    for (std::size_t y = 0; y < 2 * kSide; ++y)
        for (std::size_t x = 0; x < 2 * kSide; ++x) {
            const glm::dvec2 at(double(x) + 0.5, double(y) + 0.5);
            const glm::dvec2 q = at / kRadius - 1.0;
            if (glm::length(q) > 1.0 - 0.5 / kRadius)
                continue;
            const double distance = hit(local, glm::dvec3(q, std::sqrt(1.0 - glm::dot(q, q))));
            const float stored = tile[y * row + x];
            truth.hits += distance > 0.0;
            if (distance > 0.0 && distance < 1.01 * double(near))
                continue;  // too near to be shown
            if ((distance > 0.0) != (stored > 0.0f))
                truth.deviation = std::max(truth.deviation, distance_to(edges, at));
            else if (distance > 0.0)
                truth.off_plane =
                    std::max(truth.off_plane, std::abs(double(near) / double(stored) - distance) *
                                                  std::abs(height_above(local)) / distance);
        }
}

/// What eyes see of a scene.
struct Discs {
    std::vector<float> image;
    std::size_t row, columns;
    float near;

    const float* tile(std::size_t eye) const
    {
        return &image[eye / columns * 2 * kSide * row + eye % columns * 2 * kSide];
    }
};

Discs look(const Scene& scene, const std::vector<Eye>& eyes)
{
    const gpu::Device device;
    const World world(device, scene, Lumels{});
    EyeViews views(device, world, Projection::hemisphere, kSide, std::uint32_t(eyes.size()));
    const gpu::Array<Eye> eye_array(device, std::span<const Eye>(eyes));
    gpu::Commands commands(device);
    views.look_from(commands, eye_array, std::uint32_t(eyes.size()));
    commands.run();
    Discs discs{{}, views.image().width(), views.layout().columns, views.layout().near};
    discs.image.resize(discs.row * views.image().height());
    views.image().download(discs.image.data());
    EXPECT_EQ(device.validation_messages(), "");
    return discs;
}

Truth truth_of(const Triangle& triangle, std::uint32_t seed)
{
    std::mt19937 random(seed);
    const std::vector<Eye> eyes = eyes_around(triangle, random);
    const Discs discs = look(scene_of(triangle), eyes);
    Truth truth;
    for (std::size_t i = 0; i < eyes.size(); ++i)
        compare(seen_from(eyes[i], triangle), discs.tile(i), discs.row, discs.near, truth);
    return truth;
}

// Triangles of some metres, some decimetres, and a sliver; the eyes come as near as 2 mm.
TEST(Hemisphere, CurvedEdgesStayWithinHalfAPixel)
{
    const Triangle triangles[] = {{{{-1, -1, 0.1}, {1.2, -0.8, 0}, {0.1, 1.4, -0.2}}},
                                  {{{0, 0, 0}, {0.3, 0, 0}, {0.1, 0.2, 0.2}}},
                                  {{{-2, 0, 0}, {2, 0, 0.1}, {2, 0.03, 0.1}}}};
    for (std::uint32_t i = 0; i < std::size(triangles); ++i) {
        const Truth truth = truth_of(triangles[i], i);
        EXPECT_GT(truth.hits, 100000u);
        EXPECT_LE(truth.deviation, 0.5);
        EXPECT_LE(truth.off_plane, 1e-6);
    }
}

// Where the lines run that cut the faces of the box below, so that they have large triangles,
// small ones and slivers side by side, and meet corner to corner.
constexpr float kLines[] = {-1.0f, -0.99f, -0.3f, -0.2f, -0.18f, 0.15f, 0.7f, 1.0f};
constexpr float kShell = 3.0f;  ///< half the side of the box around it, which shows through a crack

/// A face of a box [-half, half]³.
void add_face(Scene& scene, int axis, float side, float half, const std::vector<float>& lines)
{
    const auto count = std::uint32_t(lines.size());
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> indices;
    for (const float v : lines)
        for (const float u : lines) {
            glm::vec3 corner;
            corner[axis] = side * half;
            corner[(axis + 1) % 3] = u * half;
            corner[(axis + 2) % 3] = v * half;
            corners.push_back(corner);
        }
    for (std::uint32_t j = 0; j + 1 < count; ++j)
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            const std::uint32_t a = j * count + i, b = a + 1, c = a + count, d = c + 1;
            indices.insert(indices.end(), {a, b, c, b, d, c});
        }
    support::add_mesh(scene, corners, indices, Material{});
}

Scene box_in_a_shell()
{
    Scene scene;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            add_face(scene, axis, side, 1.0f, {std::begin(kLines), std::end(kLines)});
            add_face(scene, axis, side, kShell, {-1.0f, 1.0f});
        }
    return scene;
}

/// Eyes in the box: on its walls and anywhere.
std::vector<Eye> eyes_in_the_box(std::mt19937& random)
{
    constexpr float kOff = 1e-4f;  // the wall [m]
    std::uniform_real_distribution<float> place(-0.97f, 0.97f);
    std::normal_distribution<float> normal;
    std::vector<Eye> eyes;
    for (int i = 0; i < kEyes; ++i) {
        glm::vec3 at(place(random), place(random), place(random));
        glm::vec3 toward(normal(random), normal(random), normal(random));
        if (i % 2 == 0) {
            toward = glm::vec3(0.0f);
            toward[i / 4 % 3] = i % 4 == 0 ? 1.0f : -1.0f;
            at[i / 4 % 3] = (kOff - 1.0f) * toward[i / 4 % 3];
        }
        eyes.push_back(eye_at(at, glm::normalize(toward)));
    }
    return eyes;
}

/// From a point in the box, along a direction, to its wall [m].
double to_the_wall(const glm::dvec3& from, const glm::dvec3& direction)
{
    double distance = 1e30;
    for (int axis = 0; axis < 3; ++axis)
        if (direction[axis] != 0.0)
            distance = std::min(distance, (std::copysign(1.0, direction[axis]) - from[axis]) /
                                              direction[axis]);
    return distance;
}

struct Range {
    double least = 1e30, most = 0.0;
};

/// Of the distances through a pixel and half a pixel around it, and as much again on either side:
/// at an edge the plane of the wall beside it goes on.
Range distances_about(const Eye& eye, const glm::dvec2& at)
{
    Range range;
    for (double y = -0.5; y <= 0.5; y += 0.5)
        for (double x = -0.5; x <= 0.5; x += 0.5) {
            const glm::dvec2 q = (at + glm::dvec2(x, y)) / kRadius - 1.0;
            const glm::dvec3 ray(q, std::sqrt(std::max(1.0 - glm::dot(q, q), 0.0)));
            const double distance = to_the_wall(eye.position, glm::dmat3(glm::dvec3(eye.tangent),
                                                                         glm::dvec3(eye.bitangent),
                                                                         glm::dvec3(eye.normal)) *
                                                                  ray);
            range.least = std::min(range.least, distance);
            range.most = std::max(range.most, distance);
        }
    const double width = range.most - range.least;
    return {range.least - width, range.most + width};
}

// Triangles that are drawn whole, as strips, and by the tessellator, side by side.
TEST(Hemisphere, NothingShowsThroughWhereTrianglesMeet)
{
    constexpr double kRounding = 1e-4;
    std::mt19937 random(5);
    const std::vector<Eye> eyes = eyes_in_the_box(random);
    const Discs discs = look(box_in_a_shell(), eyes);
    std::size_t tested = 0, wrong = 0;
    for (std::size_t i = 0; i < eyes.size(); ++i)
        for (std::size_t y = 0; y < 2 * kSide; ++y)
            for (std::size_t x = 0; x < 2 * kSide; ++x) {
                const glm::dvec2 at(double(x) + 0.5, double(y) + 0.5);
                if (glm::length(at / kRadius - 1.0) > 1.0 - 0.5 / kRadius)
                    continue;
                const Range truth = distances_about(eyes[i], at);
                const double found = double(discs.near) / double(discs.tile(i)[y * discs.row + x]);
                ++tested;
                wrong += !(found >= truth.least * (1.0 - kRounding) &&
                           found <= truth.most * (1.0 + kRounding));
            }
    EXPECT_GT(tested, 10'000'000u);
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace lumel
