// Finds out whether mpirun or srun has started this process, and opens the module for MPI.

#include <cstdlib>
#include <filesystem>
#include <optional>

#include <dlfcn.h>
#include <sched.h>
#include <unistd.h>

#include "base/core/error.h"
#include "base/ranks/ranks.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "liblumel-mpi.so";
/// Variables that hold the number of ranks: of Open MPI, of MPICH and Intel MPI, of Slurm.
constexpr const char* kCounts[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
/// Slurm sets the second for every job step, the first only for one that uses MPI.
constexpr const char *kOfPmix = "PMIX_RANK", *kSlurmCount = "SLURM_STEP_NUM_TASKS";

/// Ranks of which this process was started as one; empty if it was started alone.
std::optional<int> started_count()
{
    for (const char* name : kCounts)
        if (const char* const count = std::getenv(name))
            return std::atoi(count);
    const char* const count = std::getenv(kSlurmCount);
    return std::getenv(kOfPmix) && count ? std::optional(std::atoi(count)) : std::nullopt;
}

/// Beside the program's own libraries; null if it is not there.
void* open_module()
{
    const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
    for (const fs::path& place : {folder / "lib", folder / LUMEL_MODULE_FOLDER})
        // Open MPI opens modules of its own, which use its symbols.
        if (void* const module = dlopen((place / kModule).c_str(), RTLD_NOW | RTLD_GLOBAL))
            return module;
    return nullptr;
}

/// Cores that a process may use.
int cores_of(pid_t process)
{
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return sched_getaffinity(process, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 0;
}

}  // namespace

std::unique_ptr<Ranks> started_ranks(const std::string& version)
{
    const std::optional<int> count = started_count();
    if (!count)
        return nullptr;
    void* const module = open_module();
    if (!module && *count <= 1)
        return nullptr;
    if (!module) {
        const char* const reason = dlerror();
        throw Error(ErrorKind::input, kModule,
                    "cannot be loaded, and without it Lumel runs as one process only; install the "
                    "package lumel-mpi, or build with -DLUMEL_MPI=ON: " +
                        std::string(reason ? reason : ""));
    }
    const auto open = reinterpret_cast<OpenTransport>(dlsym(module, kOpenTransport));
    std::unique_ptr<RankTransport> transport(open ? open(version.c_str()) : nullptr);
    if (!transport)
        throw Error(ErrorKind::input, kModule, "is of another version of Lumel");
    return std::make_unique<Ranks>(std::move(transport));
}

std::string bound_cores(const Ranks& ranks)
{
    // The parent process, mpirun or a daemon of it, is not bound to cores.
    const int own = cores_of(0), all = cores_of(getppid());
    if (own * int(ranks.local_count()) >= all)
        return {};
    return "each rank may use " + std::to_string(own) + " of " + std::to_string(all) +
           " cores; mpirun --bind-to none lets it use all";
}

}  // namespace lumel
