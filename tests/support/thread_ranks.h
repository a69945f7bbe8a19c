#pragma once
// Ranks that are threads of one process.

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "base/ranks/ranks.h"

namespace lumel::support {

/// What RankTransport::abort() throws in place of ending the process.
struct Aborted {
    int code;
};

/// Where threads meet to exchange bytes.
class ThreadMeeting {
public:
    explicit ThreadMeeting(std::size_t count) : places_(count) {}

    std::size_t count() const { return places_.size(); }

    bool gather(std::size_t rank, std::span<const std::byte> own, std::span<std::byte> all,
                double patience)
    {
        std::unique_lock lock(mutex_);
        places_[rank] = {own, all};
        const std::size_t meeting = meetings_;
        if (++arrived_ == count()) {
            hand_out();
            arrived_ = 0;
            ++meetings_;
            all_arrived_.notify_all();
            return true;
        }
        constexpr double kLong = 3600.0;  // [s]
        return all_arrived_.wait_for(lock, std::chrono::duration<double>(std::min(patience, kLong)),
                                     [&] { return meetings_ != meeting; });
    }

private:
    struct Place {
        std::span<const std::byte> own;
        std::span<std::byte> all;
    };

    void hand_out()
    {
        for (const Place& to : places_) {
            auto next = to.all.begin();
            for (const Place& from : places_)
                next = std::ranges::copy(from.own, next).out;
        }
    }

    std::mutex mutex_;
    std::condition_variable all_arrived_;
    std::vector<Place> places_;
    std::size_t arrived_ = 0, meetings_ = 0;
};

class ThreadTransport final : public RankTransport {
public:
    ThreadTransport(ThreadMeeting& meeting, std::size_t rank) : meeting_(meeting), rank_(rank) {}

    std::size_t rank() const override { return rank_; }
    std::size_t count() const override { return meeting_.count(); }
    std::size_t local_count() const override { return count(); }
    bool gather(std::span<const std::byte> own, std::span<const std::size_t>,
                std::span<std::byte> all, double patience) override
    {
        return meeting_.gather(rank_, own, all, patience);
    }
    [[noreturn]] void abort(int code) override { throw Aborted{code}; }

private:
    ThreadMeeting& meeting_;
    std::size_t rank_;
};

/// Calls work(ranks) on `count` threads, each with its rank. max_piece, patience: see Ranks.
inline void run_ranks(std::size_t count, const std::function<void(Ranks&)>& work,
                      std::size_t max_piece = Ranks::kMaxPiece, double patience = Ranks::kPatience)
{
    ThreadMeeting meeting(count);
    std::vector<std::jthread> threads;
    for (std::size_t r = 0; r < count; ++r)
        threads.emplace_back([&, r] {
            Ranks ranks(std::make_unique<ThreadTransport>(meeting, r), max_piece, patience);
            work(ranks);
        });
}

}  // namespace lumel::support
