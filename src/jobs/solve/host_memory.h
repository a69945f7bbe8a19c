#pragma once
// The memory of the host that a bake takes, counted by what it allocates.

#include <algorithm>
#include <cstdint>

#include "atlas/prepare/prepare.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

/// Side of a map if it is fixed [texels], else 0.
inline int fixed_side(const AtlasOptions& options)
{
    return std::min(options.size, options.max_size);
}

/// Triangles of all instances.
std::uint64_t triangle_count(const Scene& scene);

/// Bytes of the host, by what takes them.
struct HostMemory {
    std::uint64_t program = 0;  ///< with its libraries
    std::uint64_t scene = 0, trees = 0, atlas = 0, lumels = 0;
    std::uint64_t solver = 0;       ///< beside links
    std::uint64_t links = 0;        ///< of as many rays as most scenes take
    std::uint64_t first_links = 0;  ///< of the rays without which there is no light
    /// Of the stage that takes most beside all these: sweeps, the finish of maps, the preview or
    /// files. On a device that is a processor, what the preview takes of it is part of that.
    std::uint64_t working = 0;
    std::uint64_t fixed = 0;  ///< of all these, what a smaller map takes as well

    std::uint64_t most() const
    {
        return program + scene + trees + atlas + lumels + solver + links + working;
    }
    std::uint64_t without_links() const { return most() - links; }
    std::uint64_t least() const { return without_links() + first_links; }
};

/// shared: the device is a processor, so that what it takes, it takes of the host.
HostMemory host_memory(const Prepared& prepared, const BakeOptions& options, bool shared);

/// The same before charts are laid out, for as many lumels.
HostMemory host_memory(const Scene& scene, std::size_t lumels, const BakeOptions& options,
                       bool shared);

}  // namespace lumel
