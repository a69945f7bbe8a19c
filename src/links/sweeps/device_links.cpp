#include "links/sweeps/device_links.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "base/core/bytes.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Blocks that are packed at a time, and per task.
constexpr std::size_t kBlocksAtATime = 64, kPackedPerTask = 8;

/// Slices of a block. Their `first` counts from the first word here.
struct PackedBlock {
    std::vector<LinkSlice> slices;
    std::vector<std::uint32_t> words;
};

/// Packs the links of blocks.
class LinkPacking {
public:
    explicit LinkPacking(const DeviceLinks::Numbering& of)
        : work_(of.work),
          parts_(of.parts),
          numbers_(of.numbers)
    {
    }

    PackedBlock pack(const LinkBlock& block, std::size_t index)
    {
        const std::size_t begin = index * kLinkBlock,
                          end = std::min(begin + kLinkBlock, work_.order.size());
        has_weights_ = !block.weights.empty();
        rows_.clear();
        ends_.clear();
        weights_.clear();
        colors_.clear();
        LinkRows rows(block);
        for (std::size_t o = begin; o < end; ++o) {
            const std::uint32_t i = work_.order[o];
            const LinkRow row = rows.next(parts_.has_hidden(i));
            for (std::uint32_t p = parts_.first(i); p < parts_.end(i); ++p)
                if (row.from)
                    add(p, row, [&](std::size_t k) {
                        return parts_.first(i) + row.leaves(parts_, i, k) == p;
                    });
                else
                    add(p, row, [](std::size_t) { return true; });
        }
        // Rows with near links first, then by the number of links: slices are short.
        std::ranges::stable_sort(
            rows_, {}, [](const Row& row) { return std::pair(row.near == 0, row.count); });
        PackedBlock packed;
        for (std::uint32_t first = 0; first < rows_.size(); first += kSliceRows)
            add_slice(first, packed);
        return packed;
    }

private:
    /// Links of a sub-lumel: their range in `ends_` and `weights_`. The last have the range of near
    /// links in `colors_`.
    struct Row {
        std::uint32_t part, first, count, first_near, near;
    };

    /// Adds a row of those links to sub-lumels that leaves(k) is true for, in the order in which
    /// the CPU adds their light.
    template <class Leaves>
    void add(std::uint32_t part, const LinkRow& row, const Leaves& leaves)
    {
        const auto first = std::uint32_t(ends_.size()), first_near = std::uint32_t(colors_.size());
        // One too many, so that all are written, and those to keep stay.
        const std::size_t most = first + row.ends.size() + row.near.size() + 1;
        ends_.resize(most);
        if (has_weights_)
            weights_.resize(most);
        std::size_t count = first;
        const auto keep = [&](std::size_t k, LinkEnd end) {
            ends_[count] = numbers_.part(end.number());
            if (has_weights_)
                weights_[count] = row.weight(k);
            const bool is_kept = leaves(k) && numbers_.is_part(end.number());
            count += is_kept ? 1 : 0;
            return is_kept;
        };
        for (std::size_t k = 0; k < row.ends.size(); ++k)
            keep(k, row.ends[k]);
        for (const NearLink& near : row.near)
            if (keep(near.slot - row.first_slot, near.end))
                colors_.push_back(near.packed_weight);
        ends_.resize(count);
        if (has_weights_)
            weights_.resize(count);
        rows_.push_back({part, first, std::uint32_t(count) - first, first_near,
                         std::uint32_t(colors_.size()) - first_near});
    }

    void add_slice(std::uint32_t first, PackedBlock& packed) const
    {
        const std::span<const Row> rows = std::span(rows_).subspan(
            first, std::min<std::size_t>(kSliceRows, rows_.size() - first));
        std::uint32_t columns = 0;
        bool has_colors = false;
        for (const Row& row : rows) {
            columns = std::max(columns, row.count);
            has_colors = has_colors || row.near > 0;
        }
        const auto words_before = std::uint32_t(packed.words.size());
        packed.slices.push_back(
            {.rows = std::uint32_t(rows.size()),
             .first = words_before,
             .columns = columns,
             .kinds = (has_weights_ ? kWeights : 0u) | (has_colors ? kColors : 0u)});
        packed.words.resize(words_before + kSliceRows);
        for (std::size_t r = 0; r < rows.size(); ++r)
            packed.words[words_before + r] = rows[r].part;
        // Appends a word of each link, column by column.
        const auto append = [&](std::uint32_t of_others, const auto& word_of) {
            const std::size_t begin = packed.words.size();
            packed.words.resize(begin + std::size_t(columns) * kSliceRows, of_others);
            for (std::size_t r = 0; r < rows.size(); ++r)
                for (std::uint32_t k = 0; k < rows[r].count; ++k)
                    packed.words[begin + std::size_t(k) * kSliceRows + r] = word_of(rows[r], k);
        };
        append(std::uint32_t(parts_.count()),
               [&](const Row& row, std::uint32_t k) { return ends_[row.first + k]; });
        if (has_weights_)
            append(0u, [&](const Row& row, std::uint32_t k) {
                return std::bit_cast<std::uint32_t>(weights_[row.first + k]);
            });
        if (has_colors)
            append(kNearWeightOne, [&](const Row& row, std::uint32_t k) {
                const std::uint32_t plain = row.count - row.near;
                return k < plain ? kNearWeightOne : colors_[row.first_near + k - plain];
            });
    }

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    // Of the block:
    bool has_weights_ = false;
    std::vector<Row> rows_;  ///< [sub-lumels]
    std::vector<std::uint32_t> ends_;
    std::vector<float> weights_;
    std::vector<std::uint32_t> colors_;  ///< of near links
};

/// Joins packed blocks to slabs.
class Slabs {
public:
    Slabs(const gpu::Device& device, const DeviceLinkLimits& limits)
        : device_(device),
          most_bytes_(limits.bytes),
          most_words_(std::min(limits.slab_bytes, device.max_array_bytes()) / sizeof(std::uint32_t))
    {
    }

    void add(const PackedBlock& block)
    {
        // Slices take less than their words.
        if (words_.size() + block.words.size() > most_words_)
            upload();
        for (LinkSlice slice : block.slices) {
            slice.first += std::uint32_t(words_.size());
            slices_.push_back(slice);
        }
        words_.insert(words_.end(), block.words.begin(), block.words.end());
    }

    /// Sub-lumels of the next blocks are those of the first again.
    void end_round() { upload(); }

    std::vector<DeviceLinks::Slab>& slabs() { return slabs_; }
    std::uint64_t bytes() const { return bytes_; }

private:
    void upload()
    {
        if (slices_.empty())
            return;
        bytes_ += bytes_of(slices_) + bytes_of(words_);
        if (most_bytes_ > 0 && bytes_ > most_bytes_)
            throw gpu::OutOfMemory(device_.info().name,
                                   "has too little memory for links beside all else");
        slabs_.push_back({{device_, slices_, "slices of links"}, {device_, words_, "links"}});
        slices_.clear();
        words_.clear();
    }

    const gpu::Device& device_;
    const std::uint64_t most_bytes_;
    const std::size_t most_words_;
    std::vector<DeviceLinks::Slab> slabs_;
    std::uint64_t bytes_ = 0;
    std::vector<LinkSlice> slices_;     ///< of the next slab
    std::vector<std::uint32_t> words_;  ///< of the next slab
};

}  // namespace

void DeviceLinks::update(const gpu::Device& device, const Numbering& numbering,
                         const LinkTable& links, const DeviceLinkLimits& limits)
{
    Slabs added(device, limits);
    for (const std::vector<LinkBlock>& round : std::span(links.rounds).subspan(rounds_)) {
        for (std::size_t begin = 0; begin < round.size(); begin += kBlocksAtATime) {
            std::vector<PackedBlock> packed(std::min(kBlocksAtATime, round.size() - begin));
            parallel_for(packed.size(), kPackedPerTask, [&](std::size_t first, std::size_t last) {
                LinkPacking packing(numbering);
                for (std::size_t b = first; b < last; ++b)
                    packed[b] = packing.pack(round[begin + b], begin + b);
            });
            for (const PackedBlock& block : packed)
                added.add(block);
        }
        added.end_round();
    }
    rounds_ = links.rounds.size();
    bytes_ += added.bytes();
    std::ranges::move(added.slabs(), std::back_inserter(slabs_));
}

}  // namespace lumel
