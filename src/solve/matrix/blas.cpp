// OpenBLAS is opened when it is needed: it and its dependencies have 40 MB, and only method
// "matrix" and maps of daylight use it.

#include "solve/matrix/blas.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <sstream>
#include <vector>

#include <cblas.h>
#include <dlfcn.h>

#include "base/core/error.h"

namespace lumel::blas {
namespace {

/// Floats per column that LAPACK works in; its block size, so that it need not go column by column.
constexpr int kWorkPerColumn = 64;

constexpr const char* kLibrary = "libopenblas.so.0";

/// True once the library is open.
std::atomic<bool> is_open = false;

void* open_library()
{
    void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        throw Error(
            ErrorKind::input, kLibrary,
            std::string("cannot be loaded; the matrix method and daylight need OpenBLAS (Debian "
                        "package libopenblas0-pthread): ") +
                dlerror());
    return library;
}

/// The functions that are called. The last two are LAPACK's own symbols, which have no C header.
struct OpenBlas {
    void* library = open_library();
    decltype(&cblas_sgemm) sgemm = find<decltype(&cblas_sgemm)>("cblas_sgemm");
    decltype(&openblas_get_config) config =
        find<decltype(&openblas_get_config)>("openblas_get_config");
    void (*sgesv)(const int* n, const int* columns, float* a, const int* stride_a, int* pivots,
                  float* b, const int* stride_b, int* info) = find<decltype(sgesv)>("sgesv_");
    void (*ssyev)(const char* vectors, const char* half, const int* n, float* a, const int* stride,
                  float* values, float* work, const int* work_size,
                  int* info) = find<decltype(ssyev)>("ssyev_");

    template <class Function>
    Function find(const char* name) const
    {
        const auto function = reinterpret_cast<Function>(dlsym(library, name));
        if (!function)
            throw Error(ErrorKind::input, kLibrary, std::string("has no function ") + name);
        return function;
    }
};

/// Stays open: its threads outlive any call.
const OpenBlas& openblas()
{
    static const OpenBlas functions;
    is_open = true;
    return functions;
}

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
    openblas().sgemm(CblasRowMajor, order(a.transposed), order(b.transposed), int(rows),
                     int(columns), int(inner), scale, a.values.data(), int(a.columns),
                     b.values.data(), int(b.columns), keep, c.data(), int(columns));
}

// LAPACK sees rows as columns, so that X A = B is Aᵀ Xᵀ = Bᵀ to it: just what it solves.
bool solve_from_right(std::span<float> a, std::span<float> b, std::uint32_t n)
{
    if (n == 0)
        return true;
    const int size = int(n), rows = int(b.size() / n);
    std::vector<int> pivots(n);
    int info = 0;
    openblas().sgesv(&size, &rows, a.data(), &size, pivots.data(), b.data(), &size, &info);
    return info == 0;
}

// LAPACK's columns are our rows; it sorts eigenvalues from the least to the largest.
void eigenvectors(std::span<float> a, std::uint32_t n)
{
    const int size = int(n), work_size = kWorkPerColumn * size;
    std::vector<float> values(n), work(std::max(work_size, 1));
    int info = 0;
    openblas().ssyev("V", "U", &size, a.data(), &size, values.data(), work.data(), &work_size,
                     &info);
    for (std::size_t row = 0; row < n / 2; ++row)
        std::swap_ranges(a.begin() + std::ptrdiff_t(row * n),
                         a.begin() + std::ptrdiff_t((row + 1) * n),
                         a.begin() + std::ptrdiff_t((n - 1 - row) * n));
}

void open()
{
    openblas();
}

std::string openblas_version()
{
    if (!is_open)
        return {};
    // "OpenBLAS 0.3.21 DYNAMIC_ARCH …"
    std::istringstream words(openblas().config());
    std::string name, version;
    words >> name >> version;
    return version;
}

}  // namespace lumel::blas
