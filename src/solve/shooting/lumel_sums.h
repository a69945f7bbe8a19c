#pragma once
// Sums over all lumels, and their way back to the host.

#include <functional>
#include <optional>

#include "gpu/pacer.h"
#include "solve/shooting/lumel_sums.shared.h"
#include "solve/shooting/lumel_sums.total.comp.h"

namespace lumel {

/// What a kernel of workgroups of kSumGroup lumels reduced (see sum.glsl), added up. Sums are
/// read a fixed number of iterations after they were requested, so that timing cannot change a
/// result and nothing waits for the device.
class LumelSums {
public:
    LumelSums(const gpu::Device& device, std::size_t lumel_count);

    static std::uint64_t device_bytes(std::size_t lumel_count);

    /// [groups of kSumGroup lumels]
    const gpu::Array<Terms>& parts() const { return parts_; }
    /// totals[0] = Σ parts.
    void add_up(gpu::Commands& commands, const gpu::Array<Terms>& totals) const;
    /// The same into the figures themselves.
    void add_up(gpu::Commands& commands) const { add_up(commands, sums_); }

    /// Records `evaluate`, which ends in add_up(), and starts the figures on their way, if it is
    /// time to.
    void request(gpu::Pacer& pacer, std::uint64_t iteration,
                 const std::function<void(gpu::Commands&)>& evaluate);
    /// Sums that are due at this iteration. Throws Error{input} if column 0's first two are
    /// not finite.
    std::optional<Terms> poll(gpu::Pacer& pacer, std::uint64_t iteration);

    /// The same at once. Waits for the device.
    Terms read_now(gpu::Pacer& pacer, const std::function<void(gpu::Commands&)>& evaluate);

    /// Forgets figures that are on their way. The pacer must have finished.
    void drop() { waiting_ = false; }

    /// The figures last added up. Waits for the device.
    Terms now() const { return sums_.download()[0]; }

private:
    gpu::Array<Terms> parts_, sums_, host_;
    gpu::Kernel<shaders::LumelSumsTotal> total_;
    bool waiting_ = false;
    std::uint64_t ticket_ = 0;
    std::uint64_t read_at_ = 0, next_ = 0;  ///< iterations
};

}  // namespace lumel
