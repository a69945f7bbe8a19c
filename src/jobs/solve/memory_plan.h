#pragma once
// The memory that a bake takes, known before its long work, and compared with what there is.

#include <cstdint>
#include <string>

#include "atlas/prepare/prepare.h"
#include "gpu/device.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/host_memory.h"
#include "raster/world/occluders.h"

namespace lumel {

/// Bytes on the device, by what takes them. Direct light is gone before the solver is made.
struct GraphicsMemory {
    std::uint64_t staging = 0, world = 0, direct_light = 0, solver = 0, directional = 0;

    std::uint64_t most() const;
};
GraphicsMemory graphics_memory(const Prepared& prepared, const Occluders& occluders,
                               const BakeOptions& options);

/// What a bake may take at most [bytes], 0: nobody knows.
struct MemoryLimits {
    std::uint64_t device = 0, host = 0;
    bool shared = false;  ///< the device is a processor: what it takes, it takes of the host
    bool given = false;   ///< by BakeOptions::max_memory, else what there is
    std::string name;     ///< of the device
};
/// available: what the machine has left [bytes], 0: not known.
MemoryLimits memory_limits(std::uint64_t max_memory, const gpu::DeviceInfo& device,
                           std::uint64_t available);
MemoryLimits memory_limits(const BakeOptions& options, const gpu::DeviceInfo& device);

/// A sentence if a bake on an atlas of `side` [texels] takes more than it may, with a size that
/// would do; empty if it fits.
std::string shortage(const GraphicsMemory& device, const HostMemory& host, int side,
                     const MemoryLimits& limits);

/// Throws Error{device} with that sentence: before charts are laid out, as far as the options say
/// how large the atlas becomes, and with all that is known behind that.
void check_memory(const Scene& scene, const BakeOptions& options, const MemoryLimits& limits);
void check_memory(const Prepared& prepared, const BakeOptions& options, const MemoryLimits& limits);

/// What links may take beside all else [bytes], as SolverOptions::max_bytes.
std::uint64_t bytes_for_links(const Prepared& prepared, const BakeOptions& options,
                              const MemoryLimits& limits);

}  // namespace lumel
