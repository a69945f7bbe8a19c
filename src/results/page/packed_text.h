#pragma once
// Bytes as text within a page.

#include <cstdint>
#include <span>
#include <string>

namespace lumel {

/// Base 64 (RFC 4648) of the bytes' gzip (RFC 1952), which browsers undo without a library.
std::string packed_text(std::span<const std::uint8_t> bytes);

}  // namespace lumel
