#pragma once
// Processes that share the work of one bake: ranks, in the word of MPI.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/ranks/rank_transport.h"

namespace lumel {

/// Seconds and traffic of a rank.
struct RankCost {
    double working = 0.0, waiting = 0.0;  ///< since its start [s]
    std::uint64_t bytes = 0;              ///< received
    std::uint64_t messages = 0;           ///< operations that all ranks took part in
};

/// The ranks of a bake. All call its operations in the same order, from one thread. If one fails
/// inside together(), every other throws its error from the next operation.
class Ranks {
public:
    /// Bytes of one operation of the transport: MPI counts in int.
    static constexpr std::size_t kMaxPiece = std::size_t(1) << 30;
    /// Time after which a rank that failed stops waiting for the others, and ends them [s].
    static constexpr double kPatience = 2.0;

    explicit Ranks(std::unique_ptr<RankTransport> transport, std::size_t max_piece = kMaxPiece,
                   double patience = kPatience);
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    std::size_t rank() const { return rank_; }
    std::size_t count() const { return count_; }
    /// The first rank writes files and talks to the user.
    bool is_first() const { return rank_ == 0; }
    std::size_t local_count() const { return transport_->local_count(); }

    /// Bytes of all ranks.
    struct Gathered {
        std::vector<std::byte> bytes;
        std::vector<std::size_t> first;  ///< [count + 1]

        std::span<const std::byte> of(std::size_t rank) const
        {
            return std::span(bytes).subspan(first[rank], first[rank + 1] - first[rank]);
        }
    };
    Gathered all_gather(std::span<const std::byte> own);
    /// Values of all ranks [count].
    template <class T>
    std::vector<T> all(const T& own)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        const Gathered found = all_gather(std::as_bytes(std::span(&own, 1)));
        const auto* first = reinterpret_cast<const T*>(found.bytes.data());
        return {first, first + count_};
    }
    /// True on all ranks if it is on one.
    bool any(bool own);
    /// Throws Error{input} on all ranks if their values differ: "rank 2 WHAT".
    void agree(std::uint64_t value, const std::string& what);

    /// Runs work that uses these operations. If it throws, the other ranks learn the error.
    void together(const std::function<void()>& work);
    /// True if this rank is to print an error: the first is, and one whose error the others cannot
    /// learn.
    bool speaks() const { return is_first() || is_abandoned_; }
    /// Waits for the others and ends the ranks. After an error that the others have not learnt,
    /// ends them with `code` and does not return. Call it last.
    void finish(int code);

    /// Costs of all ranks so far [count].
    std::vector<RankCost> costs();

private:
    enum class Status : std::uint64_t { working, failed, finished };
    struct Header {
        Status status;
        std::uint64_t size;  ///< of what follows [bytes]
    };

    Gathered exchange(Status status, std::span<const std::byte> own, double patience);
    bool gather(std::span<const std::byte> own, std::span<const std::size_t> sizes,
                std::span<std::byte> all, double patience);
    void gather_pieces(std::span<const std::byte> own, Gathered& found);
    void tell(const std::string& failure);

    std::unique_ptr<RankTransport> transport_;
    const std::size_t rank_, count_, max_piece_;
    const double patience_, start_;
    RankCost cost_;
    bool is_between_ = false;    ///< the others expect the bytes that follow a header
    bool has_ended_ = false;     ///< no operation may follow
    bool is_abandoned_ = false;  ///< the others have not learnt this rank's error
};

/// The ranks that mpirun or srun has started, of which this process is one; null if it was started
/// alone. Throws Error{input} if there are several and the module for MPI is missing. version: of
/// Lumel, which the module must share.
std::unique_ptr<Ranks> started_ranks(const std::string& version);

/// A sentence if ranks are bound to fewer cores than the machine has for them; empty if not.
std::string bound_cores(const Ranks& ranks);

}  // namespace lumel
