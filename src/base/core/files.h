#pragma once
// One way to take bytes from the disk and one to put them there, for every reader and writer.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lumel {

using Bytes = std::vector<std::uint8_t>;

/// The whole of a regular file. `place` names it in messages. Throws Error{input} if it is
/// missing, a directory, not a regular file, empty, larger than 8 GiB or unreadable.
Bytes read_file(const std::string& path, const std::string& place);

/// Writes a whole file. Throws Error{output} with the system's reason if a byte cannot be written.
void write_bytes(const std::string& path, std::span<const std::byte> bytes);

/// The same for text.
void write_text(const std::string& path, const std::string& text);

}  // namespace lumel
