#pragma once
// The interface to a message-passing library. The program and its module for MPI both include this
// header; nothing in it needs to be linked.

#include <cstddef>
#include <span>

namespace lumel {

/// Moves bytes between processes that all call the same operations in the same order.
class RankTransport {
public:
    virtual ~RankTransport() = default;

    virtual std::size_t rank() const = 0;
    virtual std::size_t count() const = 0;
    /// Ranks on this machine.
    virtual std::size_t local_count() const = 0;
    /// Concatenates the bytes of all ranks by rank. sizes [count]: of each, known to all; their sum
    /// is all.size(). Returns false if the others have not come within `patience` [s]; only abort()
    /// may then follow.
    virtual bool gather(std::span<const std::byte> own, std::span<const std::size_t> sizes,
                        std::span<std::byte> all, double patience) = 0;
    /// Ends all ranks at once, with this exit code.
    [[noreturn]] virtual void abort(int code) = 0;
};

/// The function of the module for MPI that makes its transport: null if the module is of another
/// version of Lumel. Its name is kOpenTransport.
using OpenTransport = RankTransport* (*)(const char* version);
inline constexpr const char* kOpenTransport = "lumel_open_transport";

}  // namespace lumel
