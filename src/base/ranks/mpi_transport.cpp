// The module liblumel-mpi.so: the transport of ranks by MPI.

#include <algorithm>
#include <chrono>
#include <string_view>
#include <thread>
#include <vector>

#include <mpi.h>
#include <unistd.h>

#include "base/ranks/rank_transport.h"

namespace lumel {
namespace {

using Clock = std::chrono::steady_clock;

/// MPI waits by polling, which takes a core that other ranks could use: after kBusy, waits sleep,
/// each time for 1 / kNaps of the wait so far.
constexpr std::chrono::microseconds kBusy{500}, kShortest{50}, kLongest{2000};
constexpr int kNaps = 16;

int count_of(MPI_Comm group)
{
    int count = 0;
    MPI_Comm_size(group, &count);
    return count;
}

class MpiTransport final : public RankTransport {
public:
    MpiTransport()
    {
        int threads = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        count_ = count_of(MPI_COMM_WORLD);
        MPI_Comm local;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &local);
        local_count_ = count_of(local);
        MPI_Comm_free(&local);
    }
    ~MpiTransport() override { MPI_Finalize(); }

    std::size_t rank() const override { return std::size_t(rank_); }
    std::size_t count() const override { return std::size_t(count_); }
    std::size_t local_count() const override { return std::size_t(local_count_); }

    bool gather(std::span<const std::byte> own, std::span<const std::size_t> sizes,
                std::span<std::byte> all, double patience) override
    {
        std::vector<int> counts, first;
        int sum = 0;
        for (const std::size_t size : sizes) {
            counts.push_back(int(size));
            first.push_back(sum);
            sum += int(size);
        }
        MPI_Request request;
        MPI_Iallgatherv(own.data(), int(own.size()), MPI_BYTE, all.data(), counts.data(),
                        first.data(), MPI_BYTE, MPI_COMM_WORLD, &request);
        return wait(request, patience);
    }

    [[noreturn]] void abort(int code) override
    {
        MPI_Abort(MPI_COMM_WORLD, code);
        _exit(code);
    }

private:
    static bool wait(MPI_Request& request, double patience)
    {
        const Clock::time_point begin = Clock::now();
        for (;;) {
            int is_done = 0;
            MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
            if (is_done)
                return true;
            const auto waited = Clock::now() - begin;
            if (std::chrono::duration<double>(waited).count() > patience)
                return false;
            if (waited < kBusy)
                std::this_thread::yield();
            else
                std::this_thread::sleep_for(
                    std::clamp<Clock::duration>(waited / kNaps, kShortest, kLongest));
        }
    }

    int rank_ = 0, count_ = 1, local_count_ = 1;
};

}  // namespace
}  // namespace lumel

extern "C" __attribute__((visibility("default"))) lumel::RankTransport*
lumel_open_transport(const char* version)
{
    if (std::string_view(version) != LUMEL_VERSION)
        return nullptr;
    return new lumel::MpiTransport;
}
