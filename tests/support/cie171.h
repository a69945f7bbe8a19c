#pragma once
// Case 5.9 of CIE 171:2006, by quadrature of the formula of the sky.

#include <array>
#include <string>

namespace lumel::test {

/// A sky of the CIE through an unglazed, square opening in the roof of a black room of 4 × 3 × 4 m:
/// 100 E / E_outside at points A to F of the wall z = 0, downwards, and G to N of the floor, all at
/// x = 2 m. The sun stands in the south, 60° high; its direct light does not count.
struct RoofOpening {
    int sky;
    float opening;  ///< side [m]
    std::array<double, 14> expected;
};

inline constexpr RoofOpening kSky1Side1{
    1, 1, {.46, 1.64, 2.34, 2.26, 1.88, 1.47, 2.34, 3.11, 3.84, 4.29, 4.29, 3.84, 3.11, 2.34}};
inline constexpr RoofOpening kSky1Side4{1,
                                        4,
                                        {35.82, 31.54, 26.79, 22.08, 17.87, 14.36, 31.86, 37.28,
                                         41.25, 43.32, 43.32, 41.25, 37.28, 31.86}};
inline constexpr RoofOpening kSky5Side1{
    5, 1, {1.04, 2.39, 2.59, 2.20, 1.70, 1.27, 1.96, 2.52, 3.05, 3.37, 3.37, 3.05, 2.52, 1.96}};
inline constexpr RoofOpening kSky5Side4{5,
                                        4,
                                        {45.12, 35.90, 27.99, 21.64, 16.72, 12.97, 26.80, 30.94,
                                         33.98, 35.57, 35.57, 33.98, 30.94, 26.80}};
inline constexpr RoofOpening kSky12Side1{
    12, 1, {1.74, 3.76, 4.55, 4.61, 4.24, 3.63, 5.72, 6.00, 5.11, 3.97, 2.90, 2.03, 1.40, .96}};
inline constexpr RoofOpening kSky12Side4{12,
                                         4,
                                         {67.28, 54.43, 44.20, 36.07, 29.52, 24.20, 42.28, 43.88,
                                          43.49, 40.91, 35.90, 29.23, 22.57, 16.80}};
inline constexpr RoofOpening kSky16Side1{
    16, 1, {.56, 1.78, 2.32, 2.20, 1.82, 1.43, 2.29, 3.07, 3.82, 4.29, 4.29, 3.82, 3.07, 2.29}};
inline constexpr RoofOpening kSky16Side4{16,
                                         4,
                                         {37.36, 32.14, 26.72, 21.75, 17.50, 14.03, 31.35, 36.74,
                                          40.68, 42.74, 42.74, 40.68, 36.74, 31.35}};

/// Name of a test: "Type5Side1".
inline std::string name_of(const RoofOpening& one)
{
    return "Type" + std::to_string(one.sky) + "Side" + std::to_string(int(one.opening));
}

}  // namespace lumel::test
