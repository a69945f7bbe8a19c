// Ranks exchange bytes in order, learn of failures, and share loops over blocks.

#include <array>
#include <numeric>

#include <gtest/gtest.h>

#include "../../support/thread_ranks.h"
#include "base/core/error.h"
#include "base/ranks/rank_blocks.h"

namespace lumel {
namespace {

using support::run_ranks;

/// Bytes of a rank: of another number on each, and none on rank 0.
std::vector<std::byte> bytes_of(std::size_t rank)
{
    return std::vector<std::byte>(11 * rank, std::byte(rank + 1));
}

/// The sentence with which work ends on a rank; empty if it does not.
std::string failure_in(Ranks& ranks, const std::function<void()>& work)
{
    try {
        ranks.together(work);
        return {};
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST(Ranks, GatherInTheirOrderInPiecesOfAnySize)
{
    for (const std::size_t piece : {std::size_t(1), std::size_t(20), Ranks::kMaxPiece})
        run_ranks(
            3,
            [](Ranks& ranks) {
                const Ranks::Gathered all = ranks.all_gather(bytes_of(ranks.rank()));
                for (std::size_t r = 0; r < 3; ++r)
                    EXPECT_TRUE(std::ranges::equal(all.of(r), bytes_of(r)));
                EXPECT_EQ(ranks.all(10 * int(ranks.rank())), (std::vector{0, 10, 20}));
                ranks.finish(0);
            },
            piece);
}

TEST(Ranks, CountWhatTheyReceive)
{
    run_ranks(2, [](Ranks& ranks) {
        ranks.all_gather(bytes_of(ranks.rank()));
        const std::vector<RankCost> costs = ranks.costs();
        constexpr std::uint64_t kHeader = 16;
        EXPECT_EQ(costs[0].bytes, kHeader + 11);
        EXPECT_EQ(costs[1].bytes, kHeader);
        EXPECT_EQ(costs[0].messages, 2u);
        ranks.finish(0);
    });
}

TEST(Ranks, StopTogether)
{
    run_ranks(3, [](Ranks& ranks) {
        EXPECT_FALSE(ranks.any(false));
        EXPECT_TRUE(ranks.any(ranks.rank() == 2));
        ranks.finish(0);
    });
}

TEST(Ranks, DisagreeInTheSameSentence)
{
    run_ranks(3, [](Ranks& ranks) {
        EXPECT_EQ(failure_in(ranks, [&] { ranks.agree(7, "differs"); }), "");
        EXPECT_EQ(failure_in(ranks, [&] { ranks.agree(ranks.rank() / 2, "differs"); }),
                  "rank 2 differs");
        ranks.finish(2);
    });
}

TEST(Ranks, LearnTheErrorOfAnother)
{
    run_ranks(3, [](Ranks& ranks) {
        try {
            ranks.together([&] {
                if (ranks.rank() == 1)
                    throw Error(ErrorKind::output, "disk", "is full");
                ranks.all_gather(bytes_of(1));
            });
            ADD_FAILURE() << "of rank " << ranks.rank();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::output);
            EXPECT_STREQ(error.what(),
                         ranks.rank() == 1 ? "disk: is full" : "rank 1: disk: is full");
            EXPECT_EQ(ranks.speaks(), ranks.is_first());
        }
        ranks.finish(4);
    });
}

TEST(Ranks, LearnThatAnotherHasNoMemory)
{
    run_ranks(2, [](Ranks& ranks) {
        EXPECT_THROW(ranks.together([&] {
            if (ranks.rank() == 1)
                throw std::bad_alloc();
            ranks.any(false);
        }),
                     std::bad_alloc);
        ranks.finish(3);
    });
}

TEST(Ranks, EndOthersThatDoNotListen)
{
    constexpr double kShort = 0.05;  // [s]
    run_ranks(
        2,
        [](Ranks& ranks) {
            if (ranks.rank() == 0)
                return;  // works on
            EXPECT_EQ(failure_in(ranks, [] { throw Error(ErrorKind::device, "", "lost"); }),
                      "lost");
            EXPECT_TRUE(ranks.speaks());
            EXPECT_THROW(ranks.finish(3), support::Aborted);
        },
        Ranks::kMaxPiece, kShort);
}

TEST(Ranks, ShareBlocksFromAnyOnesToAnyOnes)
{
    constexpr std::size_t kBlocks = 11;
    for (const std::size_t count : {1u, 2u, 3u, 5u, 16u})
        run_ranks(count, [&](Ranks& ranks) {
            std::vector<std::vector<int>> lists(kBlocks);
            std::array<std::array<int, 3>, kBlocks> places{};
            std::array<int, kBlocks> worked{};
            for (const auto& [first, last] : {std::pair(0u, 4u), std::pair(4u, 11u)}) {
                parallel_for_own(&ranks, first, last, 1, [&](std::size_t from, std::size_t to) {
                    for (std::size_t b = from; b < to; ++b) {
                        lists[b].assign(b, int(b));
                        places[b].fill(int(b));
                        ++worked[b];
                    }
                });
                parallel_for_others(&ranks, first, last, 1, [&](std::size_t from, std::size_t to) {
                    for (std::size_t b = from; b < to; ++b)
                        ++worked[b];
                });
                share_blocks(&ranks, first, last,
                             [&](auto& archive, std::size_t b) { archive(lists[b]); });
                share_bytes(&ranks, first, last, [&](std::size_t b) {
                    return std::as_writable_bytes(std::span(places[b]));
                });
            }
            for (std::size_t b = 0; b < kBlocks; ++b) {
                EXPECT_EQ(lists[b], std::vector(b, int(b)));
                EXPECT_EQ(places[b], (std::array{int(b), int(b), int(b)}));
                EXPECT_EQ(worked[b], 1);
            }
            ranks.finish(0);
        });
}

TEST(Ranks, AddUpWhatAllHave)
{
    run_ranks(3, [](Ranks& ranks) {
        const auto own = std::int64_t(ranks.rank());
        std::vector<std::int64_t> sums = {1, own, -own, std::int64_t(1) << 40};
        add_up(&ranks, sums);
        EXPECT_EQ(sums, (std::vector<std::int64_t>{3, 3, -3, std::int64_t(3) << 40}));
        ranks.finish(0);
    });
}

}  // namespace
}  // namespace lumel
