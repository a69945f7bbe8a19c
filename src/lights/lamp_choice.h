#pragma once
// Reservoir sampling of one lamp by its unoccluded light.

#include <glm/glm.hpp>

#include "base/core/luminance.h"
#include "lights/lamps.h"

namespace lumel {

/// Keeps each offered lamp with a probability proportional to the luminance of its light.
class LampChoice {
public:
    /// number: uniform sample in [0, 1).
    explicit LampChoice(double number) : number_(number) {}

    /// light: unoccluded light of the lamp.
    void offer(const LampSample& lamp, const glm::vec3& light)
    {
        const double weight = luminance(light);
        if (!(weight > 0.0))
            return;
        total_ += weight;
        const double share = weight / total_;
        if (number_ < share) {
            lamp_ = lamp;
            light_ = light;
            weight_ = weight;
            number_ /= share;
        } else {
            number_ = (number_ - share) / (1.0 - share);
        }
    }

    bool empty() const { return !(total_ > 0.0); }
    const LampSample& lamp() const { return lamp_; }
    /// Estimate of the light of all lamps: that of the chosen one / its probability.
    glm::vec3 light() const { return light_ * float(total_ / weight_); }

private:
    LampSample lamp_;
    glm::vec3 light_{0.0f};
    double weight_ = 0.0, total_ = 0.0, number_;
};

}  // namespace lumel
