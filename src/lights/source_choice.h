#pragma once
// Reservoir sampling of one source by its unoccluded light.

#include <glm/glm.hpp>

#include "base/core/luminance.h"
#include "lights/shadow_rays.h"

namespace lumel {

/// Keeps each offered source with a probability proportional to the luminance of its light.
class SourceChoice {
public:
    /// number: uniform sample in [0, 1).
    explicit SourceChoice(double number) : number_(number) {}

    /// light: of the sample, unoccluded.
    void offer(const SourceSample& sample, const glm::vec3& light)
    {
        const double weight = luminance(light);
        if (!(weight > 0.0))
            return;
        total_ += weight;
        const double share = weight / total_;
        if (number_ < share) {
            sample_ = sample;
            light_ = light;
            weight_ = weight;
            number_ /= share;
        } else {
            number_ = (number_ - share) / (1.0 - share);
        }
    }

    bool empty() const { return !(total_ > 0.0); }
    const SourceSample& sample() const { return sample_; }
    /// Estimate of the light of all sources: that of the chosen one / its probability.
    glm::vec3 light() const { return light_ * float(total_ / weight_); }

private:
    SourceSample sample_;
    glm::vec3 light_{0.0f};
    double weight_ = 0.0, total_ = 0.0, number_;
};

}  // namespace lumel
