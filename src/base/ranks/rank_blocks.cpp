#include "base/ranks/rank_blocks.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <streambuf>

#include "base/core/parallel.h"

namespace lumel {
namespace {

/// The blocks of [first, last) that are a rank's.
std::vector<std::size_t> blocks_of(std::size_t rank, std::size_t count, std::size_t first,
                                   std::size_t last)
{
    std::vector<std::size_t> blocks;
    for (std::size_t b = first + (rank + count - first % count) % count; b < last; b += count)
        blocks.push_back(b);
    return blocks;
}

/// Reads bytes in place.
class SpanBuffer : public std::streambuf {
public:
    explicit SpanBuffer(std::span<const std::byte> bytes)
    {
        char* const first = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
        setg(first, first, first + bytes.size());
    }
};

/// The sizes of blocks, then the blocks.
std::vector<std::byte> joined(const std::vector<std::string>& blocks)
{
    std::size_t size = blocks.size() * sizeof(std::uint64_t);
    std::vector<std::byte> bytes(size);
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const std::uint64_t of_block = blocks[n].size();
        std::memcpy(&bytes[n * sizeof of_block], &of_block, sizeof of_block);
        size += of_block;
    }
    bytes.reserve(size);
    for (const std::string& block : blocks) {
        const auto of_block = std::as_bytes(std::span(block));
        bytes.insert(bytes.end(), of_block.begin(), of_block.end());
    }
    return bytes;
}

/// `count` blocks as joined() has made them.
std::vector<std::span<const std::byte>> parted(std::span<const std::byte> bytes, std::size_t count)
{
    std::vector<std::span<const std::byte>> blocks;
    std::size_t at = count * sizeof(std::uint64_t);
    for (std::size_t n = 0; n < count; ++n) {
        std::uint64_t size = 0;
        std::memcpy(&size, &bytes[n * sizeof size], sizeof size);
        blocks.push_back(bytes.subspan(at, size));
        at += size;
    }
    return blocks;
}

}  // namespace

void parallel_for_own(const Ranks* ranks, std::size_t first, std::size_t last, std::size_t grain,
                      const std::function<void(std::size_t, std::size_t)>& body)
{
    if (count_of(ranks) == 1) {
        parallel_for(last - first, grain,
                     [&](std::size_t from, std::size_t to) { body(first + from, first + to); });
        return;
    }
    const std::vector<std::size_t> own = blocks_of(ranks->rank(), ranks->count(), first, last);
    parallel_for(own.size(), grain, [&](std::size_t from, std::size_t to) {
        for (std::size_t n = from; n < to; ++n)
            body(own[n], own[n] + 1);
    });
}

void parallel_for_others(const Ranks* ranks, std::size_t first, std::size_t last, std::size_t grain,
                         const std::function<void(std::size_t, std::size_t)>& body)
{
    if (count_of(ranks) == 1)
        return;
    parallel_for(last - first, grain, [&](std::size_t from, std::size_t to) {
        for (std::size_t b = first + from; b < first + to; ++b)
            if (!is_own(ranks, b))
                body(b, b + 1);
    });
}

void share_blocks(Ranks* ranks, std::size_t first, std::size_t last, const BlockArchives& archives)
{
    if (count_of(ranks) == 1)
        return;
    const std::size_t count = ranks->count();
    const std::vector<std::size_t> own = blocks_of(ranks->rank(), count, first, last);
    std::vector<std::string> written(own.size());
    parallel_for(own.size(), 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t n = from; n < to; ++n) {
            std::ostringstream stream;
            StateWriter writer(stream);
            archives.write(writer, own[n]);
            written[n] = std::move(stream).str();
        }
    });
    const Ranks::Gathered all = ranks->all_gather(joined(written));
    for (std::size_t r = 0; r < count; ++r) {
        if (r == ranks->rank())
            continue;
        const std::vector<std::size_t> blocks = blocks_of(r, count, first, last);
        const std::vector<std::span<const std::byte>> bytes = parted(all.of(r), blocks.size());
        parallel_for(blocks.size(), 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) {
                SpanBuffer buffer(bytes[n]);
                std::istream stream(&buffer);
                StateReader reader(stream, bytes[n].size(), "rank " + std::to_string(r),
                                   "has sent damaged data");
                archives.read(reader, blocks[n]);
            }
        });
    }
}

void share_bytes(Ranks* ranks, std::size_t first, std::size_t last,
                 const std::function<std::span<std::byte>(std::size_t)>& of)
{
    if (count_of(ranks) == 1)
        return;
    const std::size_t count = ranks->count();
    std::vector<std::byte> own;
    for (const std::size_t b : blocks_of(ranks->rank(), count, first, last)) {
        const std::span<std::byte> block = of(b);
        own.insert(own.end(), block.begin(), block.end());
    }
    const Ranks::Gathered all = ranks->all_gather(own);
    for (std::size_t r = 0; r < count; ++r) {
        if (r == ranks->rank())
            continue;
        const std::byte* from = all.of(r).data();
        for (const std::size_t b : blocks_of(r, count, first, last)) {
            const std::span<std::byte> block = of(b);
            std::copy_n(from, block.size(), block.begin());
            from += block.size();
        }
    }
}

void add_up(Ranks* ranks, std::span<std::int64_t> sums)
{
    if (count_of(ranks) == 1)
        return;
    const Ranks::Gathered all = ranks->all_gather(std::as_bytes(sums));
    for (std::size_t r = 0; r < ranks->count(); ++r) {
        if (r == ranks->rank())
            continue;
        for (std::size_t k = 0; k < sums.size(); ++k) {
            std::int64_t one = 0;
            std::memcpy(&one, all.of(r).data() + k * sizeof one, sizeof one);
            sums[k] += one;
        }
    }
}

}  // namespace lumel
