#pragma once
// Light from glossy surfaces to an eye, [BSS05] Eq. (6), at points of its image.

#include <span>
#include <vector>

#include "gpu/pacer.h"
#include "methods/glossy/eye_image.receive.comp.h"
#include "methods/glossy/eye_image.shared.h"
#include "methods/glossy/lobes.shared.h"
#include "raster/eyes/eye_views.h"

namespace lumel {

/// Sampling of the image's points. They are in sets, one of which is used per iteration: a pixel
/// with points in all sets is anti-aliased at the cost of one.
struct EyeSampling {
    std::vector<std::uint32_t> first;  ///< [S + 1] start of each set; the last one: P
    std::uint64_t shots = 0;           ///< total number of shooters: determines their weights
    std::uint32_t rays = 0;            ///< rays per lobe, traced by the caller; 0: none

    std::size_t sets() const { return first.size() - 1; }
    /// n_A: number of shooters that a point receives from.
    float shooters() const { return float(shots) / float(sets()); }
};

/// The accumulation texture C of the paper, one value per point.
class EyeImage {
public:
    /// Maximum points of one set that fit an array of the device.
    static std::uint64_t most_points(const gpu::Device& device);

    /// brightness [N]: 𝓛(B_j) / Φ [1/m²], the density by which shooters will be drawn.
    EyeImage(const gpu::Device& device, Projection projection, std::span<const EyePoint> points,
             std::span<const float> brightness, const EyeSampling& sampling);

    /// Restarts the accumulation.
    void restart(gpu::Pacer& pacer);

    /// Adds the light of an iteration's shooters.
    void receive(gpu::Pacer& pacer, const EyeViews& views, const gpu::Array<Eye>& eyes,
                 const gpu::Array<GlossyShot>& shots, const gpu::Array<GlossyLobe>& lobes,
                 std::uint32_t count);

    /// [P] radiance reflected by the lobes toward the eye [cd/m²]. Requires that the device has
    /// finished.
    std::vector<glm::vec3> radiance() const;

private:
    EyeSampling sampling_;
    std::vector<gpu::Array<EyePoint>> points_;  ///< per set
    gpu::Array<float> brightness_;
    std::vector<gpu::Array<glm::vec3>> sums_;  ///< per set
    gpu::Kernel<shaders::EyeImageReceive> receive_;
    std::uint64_t iterations_ = 0;
};

}  // namespace lumel
