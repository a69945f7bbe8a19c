#pragma once
// The hours of a year whose maps give those of all others.

#include <cstdint>
#include <span>
#include <vector>

namespace lumel {

struct ChosenHours {
    std::vector<std::size_t> hours;  ///< [K]
    /// [hours][K] The light of each hour is that of the chosen ones with these weights, of any
    /// sign, with the least error.
    std::vector<float> weights;
    std::vector<double> errors;  ///< [hours] RMS over the places, relative to the hour's RMS light
    double error = 0.0;          ///< RMS over all hours with light
};

/// Light at some places as as many numbers as there are sources: root [n][n] times the strengths of
/// n sources has the products that their light has over the places. coefficients: light of each
/// source at the places [rows][n]. Throws Error{input} without OpenBLAS.
std::vector<float> light_root(std::span<const float> coefficients, std::uint32_t n);

/// Hours taken one after the other, each that which leaves the least error, until the error is
/// reached; at most `most`. root: by light_root(); sources: strength of each source in each hour
/// [hours][sources].
ChosenHours choose_hours(std::span<const float> root, std::span<const float> sources,
                         std::uint32_t source_count, double error, std::size_t most);

/// [hours] RMS difference over the places of the light of two descriptions of the hours, relative
/// to the RMS light of the first; 0 without light. Arguments as above.
std::vector<double> relative_difference(std::span<const float> root, std::span<const float> sources,
                                        std::span<const float> others, std::uint32_t source_count);

}  // namespace lumel
