#pragma once
// Binary data as text within a page.

#include <cstdint>
#include <span>
#include <string>

namespace lumel {

/// Base 64 (RFC 4648) of the gzipped bytes (RFC 1952), which browsers can unpack themselves.
std::string packed_text(std::span<const std::uint8_t> bytes);

}  // namespace lumel
