#pragma once
// Bytes as a file with a path, without a disk.

#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "readers.h"

namespace lumel::fuzz {

class MemoryFile {
public:
    explicit MemoryFile(Input bytes) : file_(memfd_create("input", MFD_CLOEXEC))
    {
        require(file_ >= 0 && write(file_, bytes.data(), bytes.size()) == ssize_t(bytes.size()),
                "memory holds a small file");
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

private:
    int file_;
};

}  // namespace lumel::fuzz
