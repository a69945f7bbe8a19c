// [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. 2017. Equations (5) to (8).
// Unlike there, powers are not multiplied one by one: sums of 2m bounces come from sums of m,
//
//     S_2m = S_m + X^m S_m,     S_k+1 = X + X S_k,
//
// and all bounces together from a system of equations: S = X + S X, so S (I − X) = X.

#include "solve/matrix/bounces.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "solve/matrix/blas.h"
#include "solve/matrix/rows_per_task.h"

namespace lumel {
namespace {

/// More than this many times its own light no patch may get back: beyond, half of a float's digits
/// are lost in the solution, and the room would have to reflect 99.99 % of all light.
constexpr float kLargestGain = 1e4f;

blas::Operand operand(const SquareMatrix& matrix)
{
    return {matrix.values, matrix.size, matrix.size};
}

Error diverges()
{
    return {ErrorKind::input, "form-factor matrix",
            "its light does not fade from bounce to bounce; check that no albedo is above 1 and "
            "that a closed scene reflects less than all of its light, or limit the bounces"};
}

void check_numbers(const SquareMatrix& once)
{
    for (const float value : once.values)
        if (!(value >= 0.0f) || !std::isfinite(value))
            throw Error(ErrorKind::input, "form-factor matrix",
                        "has an entry that is negative or not finite; make it again");
}

SquareMatrix some_bounces(const SquareMatrix& once, std::uint32_t k)
{
    SquareMatrix sum = once, power = once, next = once;
    if (k == 0)
        sum.values.assign(sum.values.size(), 0.0f);
    // k's binary digits after the first: each doubles the bounces, a 1 adds one more.
    for (int digit = std::bit_width(k) - 2; digit >= 0; --digit) {
        next = sum;
        blas::product(operand(power), operand(sum), next.values, 1.0f, 1.0f);
        std::swap(sum, next);
        blas::product(operand(power), operand(power), next.values);
        std::swap(power, next);
        if (k >> digit & 1u) {
            next = once;
            blas::product(operand(once), operand(sum), next.values, 1.0f, 1.0f);
            std::swap(sum, next);
            blas::product(operand(once), operand(power), next.values);
            std::swap(power, next);
        }
    }
    for (const float value : sum.values)
        if (!std::isfinite(value))
            throw diverges();
    return sum;
}

// v = (I − X)^-1 1 is 1 + the row sums of S, and X v = v − 1. With X ≥ 0 and v > 0 no eigenvalue is
// larger than max (X v)_i / v_i = max 1 − 1 / v_i < 1 (Collatz and Wielandt): the sum converges.
void check_convergence(const SquareMatrix& sum)
{
    for (std::uint32_t i = 0; i < sum.size; ++i) {
        double gain = 1.0;
        for (std::uint32_t j = 0; j < sum.size; ++j)
            gain += double(sum.at(i, j));
        if (!(gain > 0.0) || gain > double(kLargestGain))
            throw diverges();
    }
}

SquareMatrix all_bounces(const SquareMatrix& once)
{
    SquareMatrix system = once, sum = once;
    for (std::uint32_t i = 0; i < once.size; ++i)
        for (std::uint32_t j = 0; j < once.size; ++j) {
            float& value = system.values[std::size_t(i) * once.size + j];
            value = (i == j ? 1.0f : 0.0f) - value;
        }
    if (!blas::solve_from_right(system.values, sum.values, once.size))
        throw diverges();
    check_convergence(sum);
    // What the solver's rounding made a little less than no light.
    for (float& value : sum.values)
        value = std::max(value, 0.0f);
    return sum;
}

}  // namespace

ColorMatrix color_matrix(const SquareMatrix& form_factors, std::span<const glm::vec3> color)
{
    assert(color.size() == form_factors.size);
    ColorMatrix result;
    for (int c = 0; c < 3; ++c) {
        SquareMatrix& channel = result.channel[c];
        channel = form_factors;
        for (std::uint32_t i = 0; i < channel.size; ++i)
            for (std::uint32_t j = 0; j < channel.size; ++j)
                channel.values[std::size_t(i) * channel.size + j] *= color[j][c];
    }
    return result;
}

ColorMatrix bounces(const ColorMatrix& once, std::uint32_t k)
{
    ColorMatrix result;
    for (int c = 0; c < 3; ++c) {
        check_numbers(once.channel[c]);
        result.channel[c] =
            k == kAllBounces ? all_bounces(once.channel[c]) : some_bounces(once.channel[c], k);
    }
    return result;
}

std::vector<glm::vec3> multiply(const ColorMatrix& matrix, std::span<const glm::vec3> x)
{
    assert(x.size() == matrix.size());
    std::vector<glm::vec3> y(matrix.size());
    parallel_for(y.size(), kRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            glm::dvec3 sum(0.0);
            for (std::size_t j = 0; j < x.size(); ++j)
                for (int c = 0; c < 3; ++c)
                    sum[c] += double(matrix.channel[c].values[i * x.size() + j]) * double(x[j][c]);
            y[i] = glm::vec3(sum);
        }
    });
    return y;
}

}  // namespace lumel
