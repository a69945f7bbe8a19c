#include "solve/matrix/local_bases.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "solve/matrix/blas.h"
#include "solve/matrix/rows_per_task.h"

namespace lumel {
namespace {

void append_rows(CodedBasis& basis, std::span<const float> values)
{
    for (std::size_t first = 0; first < values.size(); first += kCluster) {
        const auto row = values.subspan(first, kCluster);
        float unit = 0.0f;
        for (const float value : row)
            unit = std::max(unit, std::abs(value));
        basis.units.push_back(unit);
        for (const float value : row)
            basis.codes.push_back(unit > 0.0f ? std::int8_t(std::lround(value / unit * kCodes8))
                                              : std::int8_t(0));
    }
}

/// For each cluster [coefficient][place], the coefficient of most energy first.
std::vector<float> principal_components(const Coefficients& matrix)
{
    std::vector<float> bases(matrix.side / kCluster * kBasis);
    for (std::size_t b = 0; b < matrix.side / kCluster; ++b) {
        const std::span<const float> rows(&matrix.axis[0][b * kCluster * matrix.side],
                                          kCluster * matrix.side);
        const auto basis = std::span(bases).subspan(b * kBasis, kBasis);
        const auto width = std::uint32_t(matrix.side);
        blas::product({rows, kCluster, width}, blas::transposed(rows, kCluster, width), basis);
        blas::eigenvectors(basis, kCluster);
    }
    return bases;
}

/// row [side] ← Q row, cluster by cluster; or ← Q^T row.
void transform(std::span<const float> bases, std::span<float> row, bool back)
{
    std::array<float, kCluster> sum;
    for (std::size_t b = 0; b < row.size() / kCluster; ++b) {
        const auto part = row.subspan(b * kCluster, kCluster);
        const auto basis = bases.subspan(b * kBasis, kBasis);
        sum.fill(0.0f);
        for (std::size_t i = 0; i < kCluster; ++i)
            for (std::size_t j = 0; j < kCluster; ++j)
                if (back)
                    sum[j] += part[i] * basis[i * kCluster + j];
                else
                    sum[i] += part[j] * basis[i * kCluster + j];
        std::copy(sum.begin(), sum.end(), part.begin());
    }
}

void transpose(std::vector<float>& values, std::size_t side)
{
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < i; ++j)
            std::swap(values[i * side + j], values[j * side + i]);
}

}  // namespace

Coefficients by_axes(const ColorMatrix& balanced, std::span<const std::uint32_t> order)
{
    const std::size_t n = order.size();
    Coefficients result{whole_clusters(n), {}};
    for (int a = 0; a < 3; ++a) {
        result.axis[a].assign(result.side * result.side, 0.0f);
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    for (int c = 0; c < 3; ++c)
                        result.axis[a][i * result.side + j] +=
                            kColorAxes[a][c] * balanced.channel[c].at(order[i], order[j]);
        });
    }
    return result;
}

void symmetrise(Coefficients& matrix)
{
    for (std::vector<float>& values : matrix.axis)
        for (std::size_t i = 0; i < matrix.side; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                float& below = values[i * matrix.side + j];
                float& above = values[j * matrix.side + i];
                below = above = 0.5f * (below + above);
            }
}

CodedBasis find_bases(const Coefficients& matrix)
{
    CodedBasis bases;
    append_rows(bases, principal_components(matrix));
    return bases;
}

std::vector<float> duals(const CodedBasis& bases)
{
    std::vector<float> result(bases.codes.size());
    for (std::size_t b = 0; b < result.size() / kBasis; ++b) {
        std::vector<float> transposed(kBasis);
        const auto dual = std::span(result).subspan(b * kBasis, kBasis);
        for (std::size_t i = 0; i < kCluster; ++i) {
            dual[i * kCluster + i] = 1.0f;
            for (std::size_t j = 0; j < kCluster; ++j)
                transposed[j * kCluster + i] = bases.at(b * kCluster + i, j);
        }
        if (!blas::solve_from_right(transposed, dual, kCluster))
            throw Error(ErrorKind::input, "form-factor matrix",
                        "has patches that cannot be distinguished; use fewer patches");
    }
    return result;
}

void transform(std::span<const float> bases, Coefficients& matrix, bool back)
{
    for (std::vector<float>& values : matrix.axis)
        for (int side = 0; side < 2; ++side) {
            parallel_for(matrix.side, kRowsPerTask, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    transform(bases, std::span(values).subspan(i * matrix.side, matrix.side), back);
            });
            transpose(values, matrix.side);
        }
}

}  // namespace lumel
