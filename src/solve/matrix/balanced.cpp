// A_i F_ij = A_j F_ji makes D F D^-1 symmetric, and with it D (F C)^h C^-1 D^-1 for every h.

#include "solve/matrix/balanced.h"

#include <cmath>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "solve/matrix/rows_per_task.h"

namespace lumel {
namespace {

/// A darker colour leaves too little of a column to divide by it.
constexpr float kDarkest = 1e-3f;

void check(const ColorMatrix& matrix, const Elements& elements)
{
    const std::size_t n = matrix.size();
    if (elements.color.size() != n || elements.area.size() != n || elements.place.size() != n ||
        elements.normal.size() != n)
        throw Error(ErrorKind::input, "form-factor matrix",
                    "has " + std::to_string(n) + " rows, but not as many patches are described");
    for (const float area : elements.area)
        if (!(area > 0.0f) || !std::isfinite(area))
            throw Error(ErrorKind::input, "form-factor matrix", "has a patch without area");
}

/// D M C^-1 D^-1 at (i, j), or none.
struct Balance {
    const ColorMatrix& matrix;
    const Elements& elements;
    std::vector<float> root_area;

    bool known(std::size_t j, int c) const { return elements.color[j][c] >= kDarkest; }
    float at(std::size_t i, std::size_t j, int c) const
    {
        return matrix.channel[c].at(std::uint32_t(i), std::uint32_t(j)) * root_area[i] /
               (root_area[j] * elements.color[j][c]);
    }
    /// From either half.
    bool find(std::size_t i, std::size_t j, int c, float& value) const
    {
        if (known(j, c))
            value = at(i, j, c);
        else if (known(i, c))
            value = at(j, i, c);
        else
            return false;
        return true;
    }
    glm::vec3 entry(std::size_t i, std::size_t j) const
    {
        glm::vec3 values(0.0f), found(0.0f);
        for (int c = 0; c < 3; ++c)
            found[c] = find(i, j, c, values[c]) ? 1.0f : 0.0f;
        const float count = found.x + found.y + found.z;
        const float mean = count > 0.0f ? (values.x + values.y + values.z) / count : 0.0f;
        return glm::mix(glm::vec3(mean), values, found);
    }
};

}  // namespace

std::vector<float> root_areas(const Elements& elements)
{
    std::vector<float> roots(elements.area.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
        roots[i] = std::sqrt(elements.area[i]);
    return roots;
}

ColorMatrix balanced(const ColorMatrix& matrix, const Elements& elements)
{
    check(matrix, elements);
    const std::size_t n = matrix.size();
    const Balance balance{matrix, elements, root_areas(elements)};
    ColorMatrix result;
    for (SquareMatrix& channel : result.channel)
        channel = {matrix.size(), std::vector<float>(n * n)};
    parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const glm::vec3 entry = balance.entry(i, j);
                for (int c = 0; c < 3; ++c)
                    result.channel[c].values[i * n + j] = entry[c];
            }
    });
    return result;
}

std::vector<glm::vec3> sent_weights(std::span<const glm::vec3> color,
                                    std::span<const float> root_area)
{
    std::vector<glm::vec3> weights(color.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = color[i] * root_area[i];
    return weights;
}

std::vector<float> received_weights(std::span<const float> root_area)
{
    std::vector<float> weights(root_area.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = 1.0f / root_area[i];
    return weights;
}

ColorMatrix unbalanced(const ColorMatrix& balanced, std::span<const glm::vec3> color,
                       std::span<const float> root_area)
{
    ColorMatrix result = balanced;
    const std::size_t n = balanced.size();
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                result.channel[c].values[i * n + j] *= color[j][c] * root_area[j] / root_area[i];
    return result;
}

}  // namespace lumel
