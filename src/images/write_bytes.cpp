#include "images/write_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace lumel {

void write_bytes(const std::string& path, std::span<const std::byte> bytes)
{
    errno = 0;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                         &std::fclose);
    const bool written =
        file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    // A full disk may show only when the last buffer is flushed.
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
