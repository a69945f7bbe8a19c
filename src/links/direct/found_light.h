#pragma once
// Direct light that a pass of DirectEstimator found at a lumel.

#include <vector>

#include "links/direct/direct.h"

namespace lumel {

/// Direct light of a lumel: in two halves, and by cell.
struct DirectEstimator::OfLumel {
    glm::vec3 half[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    OfCells cells{};

    void add(const OfLumel& other)
    {
        for (int h = 0; h < 2; ++h)
            half[h] += other.half[h];
        for (std::size_t c = 0; c < cells.size(); ++c)
            cells[c] += other.cells[c];
    }
    void make_even() { cells.fill(0.5f * (half[0] + half[1])); }
};

struct DirectEstimator::Found {
    OfLumel light;
    std::vector<OfLumel> of_lamps;
    std::uint32_t seen = 0;
    bool uncertain = false;
    bool exact = true;  ///< unoccluded light of all sources is known exactly
    std::uint64_t rays = 0;
};

}  // namespace lumel
