#pragma once
// Sweeps over links on a GPU, with the same results as the CPU's, bit for bit.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/pacer.h"
#include "links/sweeps/device_links.h"
#include "links/sweeps/level_groups.h"
#include "links/sweeps/light_change.h"
#include "links/sweeps/source_term.h"
#include "links/sweeps/sweeps.correct.comp.h"
#include "links/sweeps/sweeps.gather.comp.h"
#include "links/sweeps/sweeps.groups.comp.h"
#include "links/sweeps/sweeps.receive.comp.h"

namespace lumel {

/// Sizes of dispatches [workgroups].
struct SweepDispatches {
    std::uint32_t probe = 256;  ///< the first of each kernel, to time it
    std::uint32_t most = ~0u;   ///< fewer if the device allows fewer
};

/// Sweeps of one solution at a time. Light stays on the device; of each sweep it returns only sums.
class DeviceSweeps {
public:
    /// albedo: [P]. Arguments must outlive this. Throws gpu::OutOfMemory.
    DeviceSweeps(const gpu::Device& device, const std::vector<glm::vec3>& albedo,
                 const SweepDispatches& dispatches = {});

    /// GPU memory of these sub-lumels, without links [bytes].
    static std::uint64_t bytes(std::size_t parts);

    /// Starts with new links and sources, which must outlive the sweeps, from X [P]; empty: none.
    void begin(const DeviceLinks& links, const SourceTerm& source,
               const std::vector<glm::vec3>& received);
    /// Sent by all at the start, summed over channels. lane: 0.
    double light(std::size_t lane) const;
    /// Computes X from the light that all send, and the light that they then send. darkest: as for
    /// sweep_sums().
    std::array<LightChange, 1> sweep(const std::array<float, 1>& darkest);
    /// Corrects the light after a sweep. Returns the residual. lane: 0.
    double correct(const LevelCorrection& levels, std::size_t lane);
    /// Goes on to the next sweep.
    void advance();
    /// X [P] of the last sweep [lx].
    std::vector<glm::vec3> received();
    /// GPU time per kernel [ms].
    const gpu::StageTimes& times() const { return pacer_.times(); }

private:
    /// Groups and sums over them.
    struct Levels {
        Levels(const gpu::Device& device, const LevelCorrection& levels);

        gpu::Array<std::uint32_t> group_of_part, members;
        gpu::Array<GroupSpan> spans;
        gpu::Array<float> areas;
        gpu::Array<glm::vec4> factors;  ///< mapped
        gpu::Array<GroupSums> sums;     ///< mapped
    };

    template <class Shader>
    void dispatch(const char* kind, std::size_t threads, const gpu::Kernel<Shader>& kernel,
                  const typename Shader::Bindings& given, typename Shader::Params params);

    const gpu::Device& device_;
    const std::vector<glm::vec3>& albedo_;
    const std::size_t parts_;
    const SweepDispatches dispatches_;
    gpu::Kernel<shaders::SweepsGather> gather_;
    gpu::Kernel<shaders::SweepsReceive> receive_;
    gpu::Kernel<shaders::SweepsGroups> sum_groups_;
    gpu::Kernel<shaders::SweepsCorrect> correct_;
    gpu::Array<glm::vec3> albedo_of_part_;  ///< [P]
    gpu::Array<glm::vec4> source_;          ///< [P]
    gpu::Array<float> share_of_ray_;        ///< [P]
    gpu::Array<glm::vec4> gathered_;        ///< [P] of the sweep in progress, from `source_` on
    gpu::Array<glm::vec4> sent_, next_;     ///< [P + 1] of a sweep, of the next; the last is dark
    gpu::Array<glm::vec3> received_;        ///< [P]
    gpu::Array<SweepSums> sums_;            ///< mapped
    std::optional<Levels> levels_;
    const DeviceLinks* links_ = nullptr;
    double light_ = 0.0;
    gpu::Pacer pacer_;  ///< last, so that its work ends before the arrays
};

}  // namespace lumel
