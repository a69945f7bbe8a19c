#include "jobs/solve/memory_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/usage.h"
#include "gpu/staging.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/setting.h"
#include "jobs/solve/sources.h"
#include "jobs/solve/stages.h"
#include "links/trace/link_casters.h"
#include "links/trace/links.h"
#include "methods/matrix/option_table.h"
#include "methods/matrix/relight_solver.h"
#include "methods/methods.h"
#include "raster/world/world.h"

namespace lumel {
namespace {

/// Maximum fraction of lumels among the texels of an atlas of given size, as seen.
constexpr double kCovered = 0.85;

/// Proposed sizes use this fraction of the memory: charts pack differently.
constexpr double kSpare = 0.9;
constexpr int kSizeStep = 16;  ///< step of proposed sizes [texels]

/// Largest side that fits, given that a bake takes `needed` bytes at `side`, of which `fixed` do
/// not depend on it; 0: none.
int side_that_fits(int side, std::uint64_t needed, std::uint64_t fixed, std::uint64_t limit)
{
    if (limit <= fixed || needed <= fixed)
        return 0;
    const double share = double(limit - fixed) / double(needed - fixed);
    const auto fitting = int(double(side) * std::sqrt(kSpare * std::min(share, 1.0)));
    return fitting >= kSizeStep ? fitting / kSizeStep * kSizeStep : fitting;
}

std::string sentence(const char* kind, std::uint64_t needed, std::uint64_t fixed, int side,
                     std::uint64_t limit, const std::string& owner)
{
    const int fitting = side_that_fits(side, needed, fixed, limit);
    return fmt::format("a bake of {0} × {0} texels needs about {1} of {2} memory, but {3} {4}; {5}",
                       side, memory_text(needed), kind, owner, memory_text(limit),
                       fitting > 0 ? fmt::format("use --size {} or less", fitting)
                                   : fmt::format("any size needs at least {}", memory_text(fixed)));
}

/// A sentence if the bake would fit with fewer patches, else empty. needed: with those of `host`.
std::string patches_sentence(const HostMemory& host, std::uint64_t needed, std::uint64_t limit,
                             const char* owner)
{
    const std::uint64_t others = needed - host.matrices;
    if (host.matrices == 0 || others >= limit)
        return {};
    const double share = double(limit - others) / double(host.matrices);
    const auto fitting = std::int64_t(double(host.patches) * std::sqrt(kSpare * share));
    if (fitting < kMinPatches)
        return {};
    return fmt::format("a matrix of {} patches needs about {} of host memory with all else, but {} "
                       "{}; use --patches {} or fewer",
                       host.patches, memory_text(needed), owner, memory_text(limit), fitting);
}

void refuse(const std::string& shortage)
{
    if (!shortage.empty())
        throw Error(ErrorKind::device, "", shortage);
}

}  // namespace

std::uint64_t GraphicsMemory::least() const
{
    return staging + world + rays + std::max(direct_light, solver + directional);
}

GraphicsMemory graphics_memory(const SolveScene& prepared, const BakeOptions& options,
                               const gpu::DeviceInfo& device)
{
    const auto* links = std::get_if<LinksOptions>(&options.solver.method);
    const float diagonal = glm::length(prepared.rays.high() - prepared.rays.low());
    const SolveSize size{
        &prepared.lumels,
        near_pairs_for(prepared.scene, prepared.rays, prepared.lumels, options.solver), diagonal};
    const std::uint64_t ray_bytes = links ? caster_bytes(device, prepared.rays, links->rays) : 0;
    const bool uploads = needs_world(options) || ray_bytes > 0;
    return {
        .staging = uploads ? gpu::Staging::device_bytes() : 0,
        .world = needs_world(options) ? World::device_bytes(prepared.lumels, prepared.atlas) : 0,
        .rays = ray_bytes,
        .direct_light = method_of(options.solver.method).finds_lights
                            ? 0
                            : direct_light_bytes(prepared.scene, prepared.lumels, diagonal),
        .solver =
            keeps_sources_apart(options)
                ? RelightSolver::device_bytes(size, std::get<MatrixOptions>(options.solver.method))
                : solver_bytes(size, options.solver),
        .directional = directional_bytes(size, directional_options(options, 0)),
        .sweeps = ray_bytes > 0 ? LinkRadiosity::device_sweep_bytes(prepared.lumels.lumels.size(),
                                                                    options.solver.max_shots)
                                : 0};
}

MemoryLimits memory_limits(std::uint64_t max_memory, const gpu::DeviceInfo& device,
                           std::uint64_t available)
{
    const bool given = max_memory > 0, shared = device.type == "cpu";
    return {.device = given    ? max_memory
                      : shared ? available
                               : device.free_bytes,
            .host = given ? max_memory : available,
            .shared = shared,
            .given = given,
            .of = device};
}

MemoryLimits memory_limits(const BakeOptions& options, const gpu::DeviceInfo& device)
{
    return memory_limits(options.max_memory, device, available_memory_bytes());
}

MemoryLimits memory_limits(const BakeOptions& options, const gpu::Device* device)
{
    return memory_limits(options, device ? device->info() : gpu::DeviceInfo{});
}

std::string shortage(const GraphicsMemory& device, const HostMemory& host, int side,
                     const MemoryLimits& limits)
{
    const char* allowed = "--max-memory allows";
    if (limits.device > 0 && device.least() > limits.device)
        return sentence("graphics", device.least(), device.staging + device.rays, side,
                        limits.device,
                        limits.given    ? allowed
                        : limits.shared ? "this machine has"
                                        : limits.of.name + " has");
    const std::uint64_t software = limits.shared ? device.least() : 0;
    const std::uint64_t fixed = host.fixed + (limits.shared ? device.staging + device.rays : 0);
    const std::uint64_t needed = host.least() + software;
    if (limits.host == 0 || needed <= limits.host)
        return {};
    const char* owner = limits.given ? allowed : "this machine has";
    const std::string fewer = patches_sentence(host, needed, limits.host, owner);
    return fewer.empty() ? sentence("host", needed, fixed, side, limits.host, owner) : fewer;
}

void check_memory(const Scene& scene, const BakeOptions& options, const MemoryLimits& limits)
{
    const int side = fixed_side(options.atlas);
    if (side == 0)
        return;
    const double texels = double(options.atlas.pages) * double(side) * double(side);
    const HostMemory host =
        host_memory(scene, std::size_t(kCovered * texels), options, limits.shared);
    refuse(shortage({}, host, side, limits));
}

void check_memory(const SolveScene& prepared, const BakeOptions& options,
                  const MemoryLimits& limits)
{
    refuse(shortage(graphics_memory(prepared, options, limits.of),
                    host_memory(prepared, options, limits.shared), prepared.atlas.pages.side,
                    limits));
}

void limit_links(BakeOptions& options, const SolveScene& prepared, const MemoryLimits& limits)
{
    if (!uses_links(options))
        return;
    const GraphicsMemory graphics = graphics_memory(prepared, options, limits.of);
    SolverOptions& solver = options.solver;
    const bool in_host = graphics.sweeps > 0 && (limits.shared || limits.of.type == "integrated");
    solver.max_device_bytes = 0;
    if (limits.host > 0) {
        const HostMemory host = host_memory(prepared, options, limits.shared);
        std::uint64_t left = limits.host - std::min(host.without_links(), limits.host);
        // A device in the host's memory gets what most scenes need, if the links of these fit
        // beside it; else the CPU sweeps.
        if (in_host) {
            const bool fits = left >= host.links + graphics.sweeps;
            solver.max_device_bytes = fits ? graphics.sweeps : 1;
            left -= fits ? graphics.sweeps : 0;
        }
        solver.max_bytes = std::max(host.first_links, left);
    }
    if (solver.max_device_bytes == 0 && limits.device > 0)
        solver.max_device_bytes = limits.device - std::min(graphics.least(), limits.device - 1);
}

}  // namespace lumel
