#pragma once
// What the process has cost so far.

#include <cstdint>

namespace lumel {

/// Processor time of all threads, user and system together [s]. A software Vulkan device computes
/// in this process, so its work is included.
double cpu_seconds();

/// Steady wall-clock time [s], from an arbitrary origin.
double wall_seconds();

/// Memory that programs can still have, without swapping [bytes]; 0 where nobody says.
std::uint64_t available_memory_bytes();

/// Largest resident memory so far [bytes].
std::uint64_t peak_memory_bytes();

}  // namespace lumel
