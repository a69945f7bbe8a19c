// [HMT11] algorithms 4.4 and 5.1: a basis U for what the matrix sends random vectors to, after a
// few rounds through it. The balanced matrix K is symmetric, so that one basis serves both sides,
// and its channels are nearly the same, so that one basis serves all three.

#include "bench/papers/matrix_low_rank.h"

#include <algorithm>
#include <random>

#include "solve/matrix/balanced.h"
#include "solve/matrix/blas.h"
#include "solve/matrix/half.h"

// LAPACK's own symbols: OpenBLAS has them, without a header in C.
extern "C" void sgeqrf_(const int* rows, const int* columns, float* a, const int* stride,
                        float* factors, float* work, const int* work_size, int* info);
extern "C" void sorgqr_(const int* rows, const int* columns, const int* reflectors, float* a,
                        const int* stride, const float* factors, float* work, const int* work_size,
                        int* info);

namespace lumel::bench {
namespace {

/// Floats per column that LAPACK works in; its block size, so that it need not go column by column.
constexpr int kWorkPerColumn = 64;

constexpr std::uint32_t kMoreThanRank = 16;  // random vectors beyond the rank, cut off at the end
constexpr int kRounds = 3;                   // through K; values of a room fall slowly
constexpr unsigned kSeed = 1;

SquareMatrix mean_of_channels(const ColorMatrix& matrix)
{
    SquareMatrix mean = matrix.channel[0];
    for (std::size_t i = 0; i < mean.values.size(); ++i)
        mean.values[i] = (matrix.channel[0].values[i] + matrix.channel[1].values[i] +
                          matrix.channel[2].values[i]) /
                         3.0f;
    return mean;
}

/// Makes the rows of a [rows][columns], rows ≤ columns, orthonormal; they span what they did.
void orthonormalise(std::span<float> a, std::uint32_t rows, std::uint32_t columns)
{
    const int length = int(columns), count = int(rows), work_size = kWorkPerColumn * count;
    std::vector<float> factors(rows), work(std::max(work_size, 1));
    int info = 0;
    sgeqrf_(&length, &count, a.data(), &length, factors.data(), work.data(), &work_size, &info);
    sorgqr_(&length, &count, &count, a.data(), &length, factors.data(), work.data(), &work_size,
            &info);
}

/// U^T [rank][n]
std::vector<float> find_basis(const SquareMatrix& k, std::uint32_t rank)
{
    const std::uint32_t n = k.size, tried = std::min(n, rank + kMoreThanRank);
    std::mt19937 random(kSeed);
    std::normal_distribution<float> normal;
    std::vector<float> rows(std::size_t(tried) * n), next(rows.size());
    for (float& value : rows)
        value = normal(random);
    for (int round = 0; round < kRounds; ++round) {
        blas::product({rows, tried, n}, blas::transposed(k.values, n, n), next);
        std::swap(rows, next);
        orthonormalise(rows, tried, n);
    }
    // The best of what they span: eigenvectors of K seen through them, by K² so that signs are
    // equal.
    blas::product({rows, tried, n}, blas::transposed(k.values, n, n), next);
    std::vector<float> energy(std::size_t(tried) * tried);
    blas::product({next, tried, n}, blas::transposed(next, tried, n), energy);
    blas::eigenvectors(energy, tried);
    blas::product({energy, tried, tried}, {rows, tried, n}, next);
    next.resize(std::size_t(rank) * n);
    return next;
}

std::vector<std::uint16_t> to_halves(std::span<const float> values, float unit)
{
    std::vector<std::uint16_t> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(),
                   [&](float value) { return to_half(value / unit); });
    return halves;
}

std::vector<float> to_floats(std::span<const std::uint16_t> halves, float unit)
{
    std::vector<float> values(halves.size());
    std::transform(halves.begin(), halves.end(), values.begin(),
                   [&](std::uint16_t half) { return from_half(half) * unit; });
    return values;
}

}  // namespace

std::size_t LowRankMatrix::bytes() const
{
    return (basis.size() + core[0].size() * 3) * sizeof(std::uint16_t) +
           color.size() * sizeof(glm::vec3) + root_area.size() * sizeof(float);
}

LowRankMatrix compress_low_rank(const ColorMatrix& matrix, const Elements& elements,
                                std::uint32_t rank)
{
    const std::uint32_t n = matrix.size();
    LowRankMatrix result{.size = n, .rank = std::min(rank, n)};
    const ColorMatrix balance = balanced(matrix, elements);
    result.color = elements.color;
    result.root_area = root_areas(elements);
    result.basis = to_halves(find_basis(mean_of_channels(balance), result.rank), 1.0f);
    const std::vector<float> basis = to_floats(result.basis, 1.0f);  // as it will be read
    std::vector<float> sent(basis.size()), core(std::size_t(result.rank) * result.rank);
    for (int c = 0; c < 3; ++c) {
        blas::product({basis, result.rank, n}, {balance.channel[c].values, n, n}, sent);
        blas::product({sent, result.rank, n}, blas::transposed(basis, result.rank, n), core);
        result.unit[c] = half_unit(core);
        result.core[c] = to_halves(core, result.unit[c]);
    }
    return result;
}

ColorMatrix decompress(const LowRankMatrix& compressed)
{
    const std::uint32_t n = compressed.size, rank = compressed.rank;
    const std::vector<float> basis = to_floats(compressed.basis, 1.0f);
    std::vector<float> sent(basis.size());
    ColorMatrix result;
    for (int c = 0; c < 3; ++c) {
        const std::vector<float> core = to_floats(compressed.core[c], compressed.unit[c]);
        result.channel[c] = {n, std::vector<float>(std::size_t(n) * n)};
        blas::product({core, rank, rank}, {basis, rank, n}, sent);
        blas::product(blas::transposed(basis, rank, n), {sent, rank, n}, result.channel[c].values);
    }
    return unbalanced(result, compressed.color, compressed.root_area);
}

}  // namespace lumel::bench
