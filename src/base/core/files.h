#pragma once
// Reading and writing of whole files.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lumel {

using Bytes = std::vector<std::uint8_t>;

/// Contents of a regular file. `place` names it in messages. Throws Error{input} if it is missing,
/// not a regular file, empty, larger than 8 GiB or unreadable.
Bytes read_file(const std::string& path, const std::string& place);

/// Throws Error{input} if a file of a bake is of another format than the one that is read.
void check_format(const std::string& path, std::uint64_t format, std::uint64_t read);

/// Writes a file. Throws Error{output} with the system's reason on failure.
void write_bytes(const std::string& path, std::span<const std::byte> bytes);

/// Writes a text file. Throws Error{output}.
void write_text(const std::string& path, const std::string& text);

}  // namespace lumel
