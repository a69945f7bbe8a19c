#pragma once
// Compression that browsers can undo.

#include <cstdint>
#include <span>
#include <vector>

namespace lumel {

/// The bytes as gzip (RFC 1952).
std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes);

}  // namespace lumel
