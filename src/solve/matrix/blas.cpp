#include "solve/matrix/blas.h"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <vector>

#include <cblas.h>

// LAPACK's own symbols: OpenBLAS has them, without a header in C.
extern "C" void sgesv_(const int* n, const int* columns, float* a, const int* stride_a, int* pivots,
                       float* b, const int* stride_b, int* info);
extern "C" void ssyev_(const char* vectors, const char* half, const int* n, float* a,
                       const int* stride, float* values, float* work, const int* work_size,
                       int* info);

namespace lumel::blas {
namespace {

/// Floats per column that LAPACK works in; its block size, so that it need not go column by column.
constexpr int kWorkPerColumn = 64;

}  // namespace

void product(const Operand& a, const Operand& b, std::span<float> c, float scale, float keep)
{
    const std::uint32_t rows = a.transposed ? a.columns : a.rows;
    const std::uint32_t inner = a.transposed ? a.rows : a.columns;
    const std::uint32_t columns = b.transposed ? b.rows : b.columns;
    assert(inner == (b.transposed ? b.columns : b.rows));
    assert(c.size() == std::size_t(rows) * columns);
    if (c.empty())
        return;
    const auto order = [](bool transposed) { return transposed ? CblasTrans : CblasNoTrans; };
    cblas_sgemm(CblasRowMajor, order(a.transposed), order(b.transposed), int(rows), int(columns),
                int(inner), scale, a.values.data(), int(a.columns), b.values.data(), int(b.columns),
                keep, c.data(), int(columns));
}

// LAPACK sees rows as columns, so that X A = B is Aᵀ Xᵀ = Bᵀ to it: just what it solves.
bool solve_from_right(std::span<float> a, std::span<float> b, std::uint32_t n)
{
    if (n == 0)
        return true;
    const int size = int(n), rows = int(b.size() / n);
    std::vector<int> pivots(n);
    int info = 0;
    sgesv_(&size, &rows, a.data(), &size, pivots.data(), b.data(), &size, &info);
    return info == 0;
}

// LAPACK's columns are our rows; it sorts eigenvalues from the least to the largest.
void eigenvectors(std::span<float> a, std::uint32_t n)
{
    const int size = int(n), work_size = kWorkPerColumn * size;
    std::vector<float> values(n), work(std::max(work_size, 1));
    int info = 0;
    ssyev_("V", "U", &size, a.data(), &size, values.data(), work.data(), &work_size, &info);
    for (std::size_t row = 0; row < n / 2; ++row)
        std::swap_ranges(a.begin() + std::ptrdiff_t(row * n),
                         a.begin() + std::ptrdiff_t((row + 1) * n),
                         a.begin() + std::ptrdiff_t((n - 1 - row) * n));
}

std::string openblas_version()
{
    // "OpenBLAS 0.3.21 DYNAMIC_ARCH …"
    std::istringstream words(openblas_get_config());
    std::string name, version;
    words >> name >> version;
    return version;
}

}  // namespace lumel::blas
