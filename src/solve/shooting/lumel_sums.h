#pragma once
// Reductions over all lumels on the GPU, read back with a fixed delay.

#include <functional>
#include <optional>

#include "gpu/pacer.h"
#include "solve/shooting/lumel_sums.shared.h"
#include "solve/shooting/lumel_sums.total.comp.h"

namespace lumel {

/// Sums the parts that a kernel with workgroups of kSumGroup lumels wrote (sum.glsl). Reads sums
/// back a fixed number of iterations after the request: timing cannot change a result, and nothing
/// waits for the device.
class LumelSums {
public:
    LumelSums(const gpu::Device& device, std::size_t lumel_count);

    static std::uint64_t device_bytes(std::size_t lumel_count);

    /// [groups of kSumGroup lumels]
    const gpu::Array<Terms>& parts() const { return parts_; }
    /// totals[0] = Σ parts.
    void add_up(gpu::Commands& commands, const gpu::Array<Terms>& totals) const;
    /// Adds up into the sums that are read back.
    void add_up(gpu::Commands& commands) const { add_up(commands, sums_); }

    /// If a readback is due: records `evaluate`, which must end with add_up(), and requests the
    /// sums.
    void request(gpu::Pacer& pacer, std::uint64_t iteration,
                 const std::function<void(gpu::Commands&)>& evaluate);
    /// The sums due at this iteration, if any. Throws Error{input} if the first two of column 0 are
    /// not finite.
    std::optional<Terms> poll(gpu::Pacer& pacer, std::uint64_t iteration);

    /// Evaluates and reads the sums at once. Waits for the device.
    Terms read_now(gpu::Pacer& pacer, const std::function<void(gpu::Commands&)>& evaluate);

    /// Discards a pending readback. Requires that the pacer has finished.
    void drop() { waiting_ = false; }

    /// The sums last added up. Waits for the device.
    Terms now() const { return sums_.download()[0]; }

private:
    gpu::Array<Terms> parts_, sums_, host_;
    gpu::Kernel<shaders::LumelSumsTotal> total_;
    bool waiting_ = false;
    std::uint64_t ticket_ = 0;
    std::uint64_t read_at_ = 0, next_ = 0;  ///< iterations
};

}  // namespace lumel
