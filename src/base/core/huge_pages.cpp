#include "base/core/huge_pages.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace lumel {
namespace {

/// True if Linux grants huge pages to programs that ask for them, and to no others.
bool are_on_request()
{
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    std::string line;
    return std::getline(file, line) && line.find("[madvise]") != std::string::npos;
}

}  // namespace

void use_huge_pages(char** arguments)
{
    constexpr const char* kTunables = "GLIBC_TUNABLES";
    // Arrays up to 64 MB are taken from what was freed, up to 128 MB of it stay: no faults anew.
    constexpr const char* kWishes = "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=67108864:"
                                    "glibc.malloc.trim_threshold=134217728";
    if (std::getenv(kTunables) || !are_on_request())
        return;
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error)
        return;
    ::setenv(kTunables, kWishes, 1);
    ::execv(program.c_str(), arguments);  // returns only if it fails
}

}  // namespace lumel
