#pragma once
// Dense linear algebra by the system's OpenBLAS. All matrices are row-major, without gaps. Throws
// Error{input} if it cannot be loaded.

#include <cstdint>
#include <span>
#include <string>

namespace lumel::blas {

/// values [rows][columns], or what they are when rows and columns change places.
struct Operand {
    std::span<const float> values;
    std::uint32_t rows = 0, columns = 0;  ///< as stored
    bool transposed = false;
};

/// `values` [rows][columns], transposed in what is made of it.
inline Operand transposed(std::span<const float> values, std::uint32_t rows, std::uint32_t columns)
{
    return {values, rows, columns, true};
}

/// c ← scale a b + keep c
void product(const Operand& a, const Operand& b, std::span<float> c, float scale = 1.0f,
             float keep = 0.0f);

/// Solves X A = B in place: b becomes X. a [n][n] is lost, b [rows][n]. False: A is singular.
bool solve_from_right(std::span<float> a, std::span<float> b, std::uint32_t n);

/// a [n][n], symmetric, becomes its eigenvectors, one a row, that of the largest eigenvalue first.
void eigenvectors(std::span<float> a, std::uint32_t n);

/// Loads the library now, for work that will need it. Without this the first call does.
void open();

/// "0.3.21"; empty before the first of these calls.
std::string openblas_version();

}  // namespace lumel::blas
