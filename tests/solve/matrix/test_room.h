#pragma once
// A closed room of which the form factors are known: a sphere.

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

}  // namespace lumel
