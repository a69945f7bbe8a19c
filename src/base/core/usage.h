#pragma once
// Resources used by the process.

#include <cstdint>

namespace lumel {

/// CPU time of all threads, user and system together [s]. Includes software Vulkan devices, which
/// compute in this process.
double cpu_seconds();

/// Steady wall-clock time [s], from an arbitrary origin.
double wall_seconds();

/// Memory available to programs without swapping [bytes]; 0 if unknown.
std::uint64_t available_memory_bytes();

/// Peak resident memory [bytes].
std::uint64_t peak_memory_bytes();

}  // namespace lumel
