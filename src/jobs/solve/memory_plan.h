#pragma once
// Estimates the memory of a bake before its long work, and compares it with the limits.

#include <cstdint>
#include <string>

#include "atlas/prepare/solve_scene.h"
#include "gpu/device.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/host_memory.h"

namespace lumel {

/// GPU memory by use [bytes]. Direct light is freed before the solver is made.
struct GraphicsMemory {
    std::uint64_t staging = 0, world = 0, rays = 0, direct_light = 0, solver = 0, directional = 0;
    std::uint64_t sweeps = 0;  ///< optional: without it, the CPU sweeps

    std::uint64_t least() const;
    std::uint64_t most() const { return least() + sweeps; }
};
/// device: without a type if there is none.
GraphicsMemory graphics_memory(const SolveScene& prepared, const BakeOptions& options,
                               const gpu::DeviceInfo& device);

/// Memory limits of a bake [bytes], 0: unknown.
struct MemoryLimits {
    std::uint64_t device = 0, host = 0;
    bool shared = false;  ///< the device is the CPU: its memory is host memory
    bool given = false;   ///< by BakeOptions::max_memory; false: available memory
    gpu::DeviceInfo of;   ///< without a type if there is no device
};
/// available: free memory of the machine [bytes], 0: unknown.
MemoryLimits memory_limits(std::uint64_t max_memory, const gpu::DeviceInfo& device,
                           std::uint64_t available);
MemoryLimits memory_limits(const BakeOptions& options, const gpu::DeviceInfo& device);
/// device: null if there is none.
MemoryLimits memory_limits(const BakeOptions& options, const gpu::Device* device);

/// A sentence if a bake with an atlas of `side` [texels] exceeds the limits, with a size that would
/// fit; empty if it fits.
std::string shortage(const GraphicsMemory& device, const HostMemory& host, int side,
                     const MemoryLimits& limits);

/// Throws Error{device} with that sentence: before charts are built, as far as the options
/// determine the atlas size; and afterwards, with all data.
void check_memory(const Scene& scene, const BakeOptions& options, const MemoryLimits& limits);
void check_memory(const SolveScene& prepared, const BakeOptions& options,
                  const MemoryLimits& limits);

/// Sets SolverOptions::max_bytes and max_device_bytes to the memory that is left for links.
void limit_links(BakeOptions& options, const SolveScene& prepared, const MemoryLimits& limits);

}  // namespace lumel
