#include "base/core/usage.h"

#include <chrono>
#include <fstream>
#include <string>

#include <sys/resource.h>

namespace lumel {
namespace {

rusage own_usage()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

double seconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double cpu_seconds()
{
    const rusage usage = own_usage();
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double wall_seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::uint64_t available_memory_bytes()
{
    constexpr std::uint64_t kKibibyte = 1024;
    std::ifstream table("/proc/meminfo");
    std::string name, unit;
    for (std::uint64_t amount = 0; table >> name >> amount; std::getline(table, unit))
        if (name == "MemAvailable:")
            return amount * kKibibyte;
    return 0;
}

std::uint64_t peak_memory_bytes()
{
    constexpr std::uint64_t kKibibyte = 1024;  // unit of ru_maxrss on Linux
    return static_cast<std::uint64_t>(own_usage().ru_maxrss) * kKibibyte;
}

}  // namespace lumel
