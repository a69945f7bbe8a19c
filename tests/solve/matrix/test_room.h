#pragma once
// Closed rooms of which the form factors are known: a sphere, and about, a box.

#include <algorithm>
#include <cmath>
#include <random>

#include "solve/matrix/bounces.h"
#include "solve/matrix/elements.h"

namespace lumel {

/// n patches of a sphere, all of different areas and colours. From everywhere in a sphere, every
/// part of it is seen by its share of the area: F_ij = A_j / ΣA. Occluders, which would make it
/// less simple, are a dividing wall that light passes only between patches of the same `room`.
struct TestRoom {
    Elements elements;
    SquareMatrix form_factors;
};

inline TestRoom sphere_room(std::uint32_t n, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    TestRoom room;
    float whole = 0.0f;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float z = 1.0f - 2.0f * (float(i) + 0.5f) / float(n), angle = 2.4f * float(i);
        const float side = std::sqrt(1.0f - z * z);
        const glm::vec3 place(side * std::cos(angle), side * std::sin(angle), z);
        room.elements.place.push_back(place);
        room.elements.normal.push_back(-place);
        room.elements.area.push_back(0.5f + unit(random));
        room.elements.color.emplace_back(0.8f * unit(random), 0.7f * unit(random), 0.0f);
        whole += room.elements.area.back();
    }
    room.form_factors = {n, std::vector<float>(std::size_t(n) * n)};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            room.form_factors.values[i * n + j] = room.elements.area[j] / whole;
    return room;
}

/// A box of unit walls whose patches are seen at their middles: smooth, with sharp edges.
inline TestRoom box_room(std::uint32_t side)
{
    TestRoom room;
    Elements& e = room.elements;
    for (int axis = 0; axis < 3; ++axis)
        for (const float wall : {0.0f, 1.0f})
            for (std::uint32_t i = 0; i < side * side; ++i) {
                glm::vec3 place(wall), normal(0.0f);
                const std::uint32_t column = i % side, row = i / side;
                place[(axis + 1) % 3] = (float(column) + 0.5f) / float(side);
                place[(axis + 2) % 3] = (float(row) + 0.5f) / float(side);
                normal[axis] = 1.0f - 2.0f * wall;
                e.place.push_back(place);
                e.normal.push_back(normal);
                e.area.push_back(1.0f / float(side * side));
                e.color.emplace_back(axis == 0 ? 0.6f : 0.3f, 0.5f, i % 7 == 0 ? 0.0f : 0.7f);
            }
    const std::size_t n = e.place.size();
    room.form_factors = {std::uint32_t(n), std::vector<float>(n * n)};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const glm::vec3 to = e.place[j] - e.place[i];
            const float square = std::max(glm::dot(to, to), 1e-12f);
            const float cosines = std::max(glm::dot(to, e.normal[i]), 0.0f) *
                                  std::max(-glm::dot(to, e.normal[j]), 0.0f) / square;
            room.form_factors.values[i * n + j] =
                cosines * e.area[j] / (3.14159265f * square + e.area[j]);
        }
    return room;
}

/// Relative error of light, over patches by area, where each patch in turn is the lit one.
inline double relative_error(const ColorMatrix& found, const ColorMatrix& truth,
                             const Elements& elements)
{
    double off = 0.0, all = 0.0;
    for (int c = 0; c < 3; ++c)
        for (std::uint32_t i = 0; i < truth.size(); ++i)
            for (std::uint32_t j = 0; j < truth.size(); ++j) {
                const double value = double(truth.channel[c].at(i, j));
                off += double(elements.area[i]) *
                       std::pow(double(found.channel[c].at(i, j)) - value, 2);
                all += double(elements.area[i]) * value * value;
            }
    return std::sqrt(off / all);
}

inline ColorMatrix all_bounces(const TestRoom& room)
{
    return bounces(color_matrix(room.form_factors, room.elements.color), kAllBounces);
}

}  // namespace lumel
