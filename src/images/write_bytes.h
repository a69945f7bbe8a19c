#pragma once
// One way to put bytes on the disk, for every writer.

#include <cstddef>
#include <span>
#include <string>

namespace lumel {

/// Writes a whole file. Throws Error{output} with the system's reason if a byte cannot be written.
void write_bytes(const std::string& path, std::span<const std::byte> bytes);

/// The same for text.
void write_text(const std::string& path, const std::string& text);

}  // namespace lumel
