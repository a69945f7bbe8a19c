#pragma once
// Host memory of a bake, counted by its allocations.

#include <algorithm>
#include <cstdint>

#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

/// Side of the map if fixed [texels], else 0.
inline int fixed_side(const AtlasOptions& options)
{
    return std::min(options.size, options.max_size);
}

inline bool uses_links(const BakeOptions& options)
{
    return std::holds_alternative<LinksOptions>(options.solver.method);
}

inline bool keeps_lamps_apart(const BakeOptions& options)
{
    return uses_links(options) && std::get<LinksOptions>(options.solver.method).per_lamp;
}

/// True if the first of several ranks needs the links of all in the end.
inline bool gathers_links(const BakeOptions& options)
{
    return options.keep_links || keeps_lamps_apart(options);
}

/// Triangles of all instances.
std::uint64_t triangle_count(const Scene& scene);

/// Host memory by use [bytes].
struct HostMemory {
    std::uint64_t program = 0;  ///< with its libraries
    std::uint64_t scene = 0, trees = 0, atlas = 0, lumels = 0;
    std::uint64_t solver = 0;       ///< without links
    std::uint64_t links = 0;        ///< for the ray count of most scenes
    std::uint64_t first_links = 0;  ///< for the minimum ray count
    /// Largest temporary memory of a stage: sweeps, the finish of maps, the preview or files. On a
    /// CPU device it includes the preview's device memory.
    std::uint64_t working = 0;
    std::uint64_t fixed = 0;                  ///< part that does not depend on the map's size
    std::uint64_t matrices = 0, patches = 0;  ///< between this number of patches

    std::uint64_t most() const
    {
        return program + scene + trees + atlas + lumels + solver + links + working + matrices;
    }
    std::uint64_t without_links() const { return most() - links; }
    std::uint64_t least() const { return without_links() + first_links; }
};

/// shared: the device is the CPU, so its memory is host memory.
HostMemory host_memory(const SolveScene& prepared, const BakeOptions& options, bool shared);

/// Estimate before charts are built, for this number of lumels.
HostMemory host_memory(const Scene& scene, std::size_t lumels, const BakeOptions& options,
                       bool shared);

}  // namespace lumel
