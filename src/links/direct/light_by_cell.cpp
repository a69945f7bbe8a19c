// DirectEstimator's results: halves of lumels, and light by cell where it varies.

#include <algorithm>
#include <span>

#include "base/core/luminance.h"
#include "base/ranks/rank_blocks.h"
#include "links/direct/found_light.h"

namespace lumel {
namespace {

/// Light is stored per cell if cells differ by more than kDiffers × the brightest cell, and by more
/// than kCounts × the mean of all lumels.
constexpr float kDiffers = 0.25f, kCounts = 0.01f;

}  // namespace

/// True if the light of cells differs significantly.
bool DirectEstimator::differ(const OfCells& cells)
{
    const auto by_light = [](const glm::vec3& one, const glm::vec3& other) {
        return luminance(one) < luminance(other);
    };
    const auto [least, most] = std::minmax_element(cells.begin(), cells.end(), by_light);
    return luminance(*most) - luminance(*least) > double(kDiffers) * luminance(*most);
}

/// Keeps light by cell where it varies. Across a cut, cells of other lamps can be equally bright.
void DirectEstimator::keep_by_cell(std::uint32_t i, const Found& found, float before,
                                   Block& block) const
{
    const auto mixed = [&](const OfCells& cells, const auto& light_before) {
        OfCells result;
        for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
            result[c] = before * light_before(c) + (1.0f - before) * cells[c];
        return result;
    };
    const OfCells cells = mixed(found.light.cells, [&](std::uint32_t c) { return at(i, c); });
    const bool any = differ(cells);
    if (any) {
        block.light.lumel.push_back(i);
        block.light.cells.insert(block.light.cells.end(), cells.begin(), cells.end());
    }
    if (lamps_ == 0 || (!any && !is_cut(i)))
        return;
    std::vector<OfCells> of_lamps;
    for (std::size_t lamp = 0; lamp < lamps_; ++lamp)
        of_lamps.push_back(mixed(found.of_lamps[lamp].cells, [&](std::uint32_t c) {
            return varies_by_lamp(i) ? lamps_in(i, c)[lamp] : mean_of_lamp(i, lamp);
        }));
    if (!any && std::ranges::none_of(of_lamps, differ))
        return;
    block.of_lamps.lumel.push_back(i);
    for (std::size_t c = 0; c < std::size_t(kCells); ++c)
        for (const OfCells& cells_of_lamp : of_lamps)
            block.of_lamps.cells.push_back(cells_of_lamp[c]);
}

/// Stores the results of lumel i: the mean over its passes of many rays, weighted by rays.
void DirectEstimator::keep(std::uint32_t i, const Found& found, Block& block)
{
    const std::uint32_t taken = taken_[i], more = more_[i];
    const float before = taken > 0 ? float(taken) / float(taken + more) : 0.0f;
    keep_by_cell(i, found, before, block);
    for (int h = 0; h < 2; ++h) {
        half_[h][i] = before * half_[h][i] + (1.0f - before) * found.light.half[h];
        for (std::size_t lamp = 0; lamp < lamps_; ++lamp) {
            glm::vec3& half = lamp_half_[h][i * lamps_ + lamp];
            half = before * half + (1.0f - before) * found.of_lamps[lamp].half[h];
        }
    }
    taken_[i] += more;
    if (first_pass_) {
        uncertain_[i] = found.uncertain;
        seen_[i] = found.seen;
    }
    block.rays += found.rays;
}

/// Gives each rank what the others have found in blocks of a list.
void DirectEstimator::share(const std::vector<std::uint32_t>& lumels, std::size_t first,
                            std::size_t last)
{
    share_blocks(work_.ranks, first, last, [&](auto& archive, std::size_t b) {
        archive(blocks_[b]);
        const std::size_t end = std::min((b + 1) * kBlock, lumels.size());
        for (std::size_t k = b * kBlock; k < end; ++k) {
            const std::uint32_t i = lumels[k];
            archive(half_[0][i], half_[1][i], taken_[i], seen_[i], uncertain_[i]);
            for (std::size_t lamp = 0; lamp < lamps_; ++lamp)
                archive(lamp_half_[0][i * lamps_ + lamp], lamp_half_[1][i * lamps_ + lamp]);
        }
    });
}

bool DirectEstimator::ByCell::fits(std::size_t lumels) const
{
    const auto has_cells = [&](std::uint32_t at) {
        return at == kSame || (at + std::size_t(1)) * size() <= cells.size();
    };
    return index.size() == lumels && std::ranges::all_of(index, has_cells);
}

bool DirectEstimator::FoundCells::fits(std::size_t lumels, std::size_t kinds) const
{
    return cells.size() == kCells * kinds * lumel.size() &&
           std::ranges::all_of(lumel, [&](std::uint32_t i) { return i < lumels; });
}

/// Replaces the cells of lumels of this pass by those that its blocks found. keeps(lumel, its
/// cells): false if they are not worth it.
template <class Keeps>
void DirectEstimator::renew(ByCell& kept, FoundCells Block::*found, const Keeps& keeps) const
{
    std::vector<char> again(first_pass_ ? 0 : kept.index.size(), 0);
    if (!first_pass_)
        for (const std::uint32_t i : many_)
            again[i] = 1;
    ByCell next{kept.kinds, std::vector<std::uint32_t>(kept.index.size(), kSame), {}};
    const auto keep = [&](std::uint32_t i, const glm::vec3* cells) {
        if (!keeps(i, cells))
            return;
        next.index[i] = std::uint32_t(next.cells.size() / next.size());
        next.cells.insert(next.cells.end(), cells, cells + next.size());
    };
    if (!first_pass_)
        for (std::uint32_t i = 0; i < kept.index.size(); ++i)
            if (kept.index[i] != kSame && !again[i])
                keep(i, kept.of(i));
    for (const Block& block : blocks_) {
        const FoundCells& of_block = block.*found;
        for (std::size_t k = 0; k < of_block.lumel.size(); ++k)
            keep(of_block.lumel[k], &of_block.cells[k * kept.size()]);
    }
    kept = std::move(next);
}

/// Stores the cells that the blocks of a pass found.
void DirectEstimator::keep_cells()
{
    const double mean = mean_of_all();
    renew(by_cell_, &Block::light, [&](std::uint32_t i, const glm::vec3* cells) {
        double most = 0.0;
        for (const glm::vec3& cell : std::span(cells, kCells))
            most = std::max(most, luminance(cell));
        return most > double(kCounts) * mean || is_cut(i);
    });
    if (lamps_ > 0)
        renew(lamps_by_cell_, &Block::of_lamps,
              [&](std::uint32_t i, const glm::vec3*) { return varies(i) || is_cut(i); });
    for (Block& block : blocks_) {
        rays_ += block.rays;
        block = {};
    }
}

}  // namespace lumel
