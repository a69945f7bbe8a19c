// How truly a hemisphere's disc shows a triangle, measured pixel by pixel in double precision.

#include <random>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "visibility/probe.h"

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

Truth truth_of(const Triangle& triangle, std::uint32_t seed)
{
    std::mt19937 random(seed);
    const Scene scene = scene_of(triangle);
    const gpu::Device device;
    const World world(device, scene, Lumels{});
    const std::vector<Eye> eyes = eyes_around(triangle, random);
    EyeViews views(device, world, Projection::hemisphere, kSide, kEyes);
    const gpu::Array<Eye> eye_array(device, std::span<const Eye>(eyes));
    gpu::Commands commands(device);
    views.look_from(commands, eye_array, kEyes);
    commands.run();
    const std::size_t row = views.image().width();
    std::vector<float> image(row * views.image().height());
    views.image().download(image.data());
    EXPECT_EQ(device.validation_messages(), "");
    Truth truth;
    for (std::size_t i = 0; i < kEyes; ++i) {
        const std::size_t column = i % views.layout().columns, line = i / views.layout().columns;
        compare(seen_from(eyes[i], triangle), &image[line * 2 * kSide * row + column * 2 * kSide],
                row, views.layout().near, truth);
    }
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

}  // namespace
}  // namespace lumel
