#include "base/core/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "base/core/error.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// [bytes] Twice the largest .glb.
constexpr std::streamoff kLargestFile = std::streamoff(1) << 33;

}  // namespace

Bytes read_file(const std::string& path, const std::string& place)
{
    const auto fail = [&](const char* what) { throw Error(ErrorKind::input, place, what); };
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (!fs::exists(status))
        fail("there is no such file");
    if (fs::is_directory(status))
        fail("is a folder, not a file");
    if (!fs::is_regular_file(status))
        fail("is not a regular file");

    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
    if (size < 0)
        fail("cannot be opened for reading");
    if (size == 0)
        fail("is empty");
    if (size > kLargestFile)
        fail("is larger than 8 GiB");
    Bytes bytes(static_cast<std::size_t>(size));
    stream.seekg(0);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), size))
        fail("cannot be read");
    return bytes;
}

void check_format(const std::string& path, std::uint64_t format, std::uint64_t read)
{
    if (format != read)
        throw Error(ErrorKind::input, path,
                    "was written by another version of lumel (its format is " +
                        std::to_string(format) + ", this one reads " + std::to_string(read) +
                        "); bake the scene again");
}

void write_bytes(const std::string& path, std::span<const std::byte> bytes)
{
    errno = 0;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                         &std::fclose);
    const bool written =
        file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    // A full disk may be reported only when the last buffer is flushed.
    const bool flushed = written && std::fclose(file.release()) == 0;
    if (!flushed)
        throw Error(ErrorKind::output, path,
                    std::string("cannot be written: ") + std::strerror(errno));
}

void write_text(const std::string& path, const std::string& text)
{
    write_bytes(path, std::as_bytes(std::span(text)));
}

}  // namespace lumel
