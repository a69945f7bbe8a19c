#include "twins.h"

#include <algorithm>
#include <array>
#include <map>

#include <gtest/gtest.h>

namespace lumel::test {

namespace {

struct Corner {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec2 texcoord;
};
using Triangle = std::array<Corner, 3>;
using Cell = std::array<std::int64_t, 3>;

/// In the world; by material. set: of texture coordinates.
std::map<std::string, std::vector<Triangle>> triangles_of(const Scene& scene, std::size_t set)
{
    std::map<std::string, std::vector<Triangle>> all;
    for (const Instance& instance : scene.instances) {
        const glm::mat4 place = instance.transform;
        const glm::mat3 turn = glm::transpose(glm::inverse(glm::mat3(place)));
        for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives) {
            const std::string key =
                instance.name + ": " + scene.materials[std::size_t(p.material)].name;
            for (std::size_t i = 0; i < p.indices.size(); i += 3) {
                Triangle triangle;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t v = p.indices[i + k];
                    triangle[k].position = glm::vec3(place * glm::vec4(p.positions[v], 1.0f));
                    triangle[k].normal =
                        p.normals.empty() ? glm::vec3(0.0f) : glm::normalize(turn * p.normals[v]);
                    triangle[k].texcoord =
                        p.texcoords[set].empty() ? glm::vec2(0.0f) : p.texcoords[set][v];
                }
                all[key].push_back(triangle);
            }
        }
    }
    return all;
}

bool are_twins(const Triangle& a, const Triangle& b, const TwinSteps& steps)
{
    for (std::size_t turn = 0; turn < 3; ++turn) {
        bool same = true;
        for (std::size_t k = 0; k < 3 && same; ++k) {
            const Corner& left = a[k];
            const Corner& right = b[(k + turn) % 3];
            same = glm::distance(left.position, right.position) <= steps.position &&
                   glm::distance(left.normal, right.normal) <= steps.normal &&
                   glm::distance(left.texcoord, right.texcoord) <= steps.texcoord;
        }
        if (same)
            return true;
    }
    return false;
}

glm::vec3 middle_of(const Triangle& t)
{
    return (t[0].position + t[1].position + t[2].position) / 3.0f;
}

/// A step may flatten what is thinner; such triangles need no twin.
bool is_thin(const Triangle& t, float step)
{
    const glm::vec3 a = t[1].position - t[0].position, b = t[2].position - t[0].position;
    const float longest =
        std::max({glm::length(a), glm::length(b), glm::distance(t[1].position, t[2].position)});
    return glm::length(glm::cross(a, b)) <= 4.0f * step * longest;
}

/// How many of `from` have no twin in `to`.
std::size_t alone(const std::vector<Triangle>& from, const std::vector<Triangle>& to,
                  const TwinSteps& steps)
{
    const float side = std::max(2.0f * steps.position, 1e-3f);
    const auto cell_of = [&](const glm::vec3& p) {
        return Cell{std::int64_t(std::floor(p.x / side)), std::int64_t(std::floor(p.y / side)),
                    std::int64_t(std::floor(p.z / side))};
    };
    std::map<Cell, std::vector<const Triangle*>> cells;
    for (const Triangle& triangle : to)
        cells[cell_of(middle_of(triangle))].push_back(&triangle);
    const auto has_twin = [&](const Triangle& triangle) {
        const Cell home = cell_of(middle_of(triangle));
        for (std::int64_t i = 0; i < 27; ++i) {
            const auto found =
                cells.find({home[0] + i % 3 - 1, home[1] + i / 3 % 3 - 1, home[2] + i / 9 - 1});
            if (found != cells.end())
                for (const Triangle* other : found->second)
                    if (are_twins(triangle, *other, steps))
                        return true;
        }
        return false;
    };
    return std::size_t(std::count_if(from.begin(), from.end(), [&](const Triangle& triangle) {
        return !is_thin(triangle, steps.position) && !has_twin(triangle);
    }));
}

}  // namespace

double area_of(const Scene& scene)
{
    double sum = 0.0;
    for (const auto& [key, triangles] : triangles_of(scene, 0))
        for (const Triangle& t : triangles)
            sum += 0.5 * glm::length(glm::cross(t[1].position - t[0].position,
                                                t[2].position - t[0].position));
    return sum;
}

void expect_twins(const Scene& plain, const Scene& packed, const TwinSteps& steps)
{
    const auto left = triangles_of(plain, steps.set), right = triangles_of(packed, steps.set);
    ASSERT_EQ(left.size(), right.size());
    for (const auto& [key, triangles] : left) {
        SCOPED_TRACE(key);
        ASSERT_TRUE(right.contains(key));
        EXPECT_EQ(alone(triangles, right.at(key), steps), 0u) << "of " << triangles.size();
        EXPECT_EQ(alone(right.at(key), triangles, steps), 0u) << "of " << right.at(key).size();
    }
}

}  // namespace lumel::test
