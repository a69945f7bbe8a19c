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

/// The fewest hours, by one after the other that leaves the least error, until the error is
/// reached; at most `most`. coefficients: light of each source at some places [rows][sources];
/// sources: strength of each source in each hour [hours][sources]. Throws Error{input} without
/// OpenBLAS.
ChosenHours choose_hours(std::span<const float> coefficients, std::span<const float> sources,
                         std::uint32_t source_count, double error, std::size_t most);

/// [hours] RMS difference over the places of the light of two descriptions of the hours, relative
/// to the RMS light of the first; 0 without light. Arguments as above.
std::vector<double> apart(std::span<const float> coefficients, std::span<const float> sources,
                          std::span<const float> others, std::uint32_t source_count);

}  // namespace lumel
