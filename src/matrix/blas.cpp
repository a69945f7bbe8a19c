#include "matrix/blas.h"

#include <cassert>
#include <vector>

#include <cblas.h>

// LAPACK's own symbols: OpenBLAS has them, without a header in C.
extern "C" void sgesv_(const int* n, const int* columns, float* a, const int* stride_a, int* pivots,
                       float* b, const int* stride_b, int* info);

namespace lumel::blas {

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

}  // namespace lumel::blas
