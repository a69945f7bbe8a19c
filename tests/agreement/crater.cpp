#include "crater.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "../scene/gltf_builder.h"

namespace lumel::test {
namespace {

constexpr double kAlbedo = 0.8, kSunlight = 1000.0;  // [lx] across the beam
/// From the bottom to the rim, seen from the centre of a sphere of 1 m.
constexpr double kReach = 75.0 * std::numbers::pi / 180.0;
constexpr double kElevation = 25.0 * std::numbers::pi / 180.0;
constexpr int kRings = 32, kAround = 64;
/// Lumels are narrower [m].
constexpr double kMargin = 0.12;

/// The centre of the sphere is the origin, +y is up.
glm::dvec3 point_at(int ring, int step)
{
    const double theta = kReach * ring / kRings;
    const double phi = 2.0 * std::numbers::pi * step / kAround;
    return {std::sin(theta) * std::cos(phi), -std::cos(theta), std::sin(theta) * std::sin(phi)};
}

glm::dvec3 toward_sun()
{
    return {std::cos(kElevation), std::sin(kElevation), 0.0};
}

struct Bowl {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    double area = 0.0;

    std::uint32_t add(const glm::dvec3& position)
    {
        positions.emplace_back(position);
        return std::uint32_t(positions.size()) - 1;
    }
    /// Seen from inside.
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        const glm::dvec3 u(positions[b] - positions[a]), v(positions[c] - positions[a]);
        area += 0.5 * glm::length(glm::cross(u, v));
        indices.insert(indices.end(), {a, b, c});
    }
};

Bowl bowl()
{
    Bowl made;
    made.add(point_at(0, 0));
    for (int ring = 1; ring <= kRings; ++ring)
        for (int step = 0; step < kAround; ++step)
            made.add(point_at(ring, step));
    const auto at = [](int ring, int step) {
        return ring == 0 ? 0u : std::uint32_t(1 + (ring - 1) * kAround + step % kAround);
    };
    for (int ring = 0; ring < kRings; ++ring)
        for (int step = 0; step < kAround; ++step) {
            made.add(at(ring, step), at(ring + 1, step + 1), at(ring + 1, step));
            if (ring > 0)
                made.add(at(ring, step), at(ring, step + 1), at(ring + 1, step + 1));
        }
    return made;
}

}  // namespace

Crater::Crater()
{
    const Bowl made = bowl();
    area_ = made.area;
    opening_ = 0.5 * kAround * std::pow(std::sin(kReach), 2.0) *
               std::sin(2.0 * std::numbers::pi / kAround);
    GltfBuilder builder;
    const int positions = builder.add_positions(made.positions);
    const int indices = builder.add_accessor(made.indices, "SCALAR", 5125, made.indices.size());
    // Diffuse to glossy methods too.
    const int material = builder.push(
        "materials",
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {kAlbedo, kAlbedo, kAlbedo, 1.0}}, {"metallicFactor", 0.0}}},
         {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.0}}}}}});
    builder.show(
        {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", material}});
    constexpr const char* kLights = "KHR_lights_punctual";
    builder.json["extensionsUsed"] = {kLights, "KHR_materials_specular"};
    builder.json["extensions"][kLights]["lights"] = {
        {{"name", "sun"}, {"type", "directional"}, {"intensity", kSunlight}}};
    const glm::vec3 toward(toward_sun());
    const glm::quat turn = glm::quat_cast(
        glm::inverse(glm::mat3(glm::lookAt(toward, glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f)))));
    const int sun = builder.push("nodes", {{"rotation", {turn.x, turn.y, turn.z, turn.w}},
                                           {"extensions", {{kLights, {{"light", 0}}}}}});
    builder.json["scenes"][0]["nodes"].push_back(sun);
    path_ = folder_ / "crater.glb";
    const Bytes bytes = builder.glb();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

double Crater::mean_sunlight() const
{
    return kSunlight * std::sin(kElevation) * opening_ / area_;
}

double Crater::reflected() const
{
    const double seen = kAlbedo * (1.0 - opening_ / area_);
    return seen * mean_sunlight() / (1.0 - seen);
}

bool Crater::in_shadow(const Lumel& lumel)
{
    // The ray from x towards the sun s leaves the sphere at x - 2 (x·s) s: through the cap, or
    // through the opening above the rim.
    const glm::dvec3 x = glm::normalize(glm::dvec3(lumel.position));
    const double below = glm::dot(x, toward_sun());
    const double exit = x.y - 2.0 * below * toward_sun().y;
    return below > kMargin || (below < 0.0 && exit < -std::cos(kReach) - kMargin);
}

}  // namespace lumel::test
