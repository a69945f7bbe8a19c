#pragma once
// Space that no light can reach, as links tell.

#include <cstdint>
#include <optional>
#include <vector>

#include "links/direct/link_work.h"
#include "links/kept/link_table.h"

namespace lumel {

/// Sub-lumels that links join, in either direction, over any number of links: light that is among
/// them stays among them, and light that is not cannot come in.
class SealedSpace {
public:
    /// All arguments must outlive this.
    SealedSpace(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers);

    /// Joins sub-lumels by the links of the rounds that it has not seen, of one of several tables.
    void join(const LinkTable& links, std::size_t table);

    /// [N] 1 for lumels of which no sub-lumel is joined with a lit one. lit [P]: 1 for sub-lumels
    /// that send or receive light.
    std::vector<char> sealed(const std::vector<char>& lit);

private:
    struct Pair {
        std::uint32_t part, other;
    };
    std::uint32_t root(std::uint32_t part);
    bool unite(std::uint32_t part, std::uint32_t other);
    void join_row(std::uint32_t lumel, const LinkRow& row);
    void share_joined();

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    std::vector<std::uint32_t> above_;  ///< [P] union-find
    std::vector<std::size_t> rounds_;   ///< [tables] seen
    std::vector<Pair> joined_;          ///< by this rank, in the present join()
};

}  // namespace lumel
