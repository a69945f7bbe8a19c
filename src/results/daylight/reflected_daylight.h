#pragma once
// Daylight that lumels send.

#include <functional>
#include <span>

#include <glm/glm.hpp>

#include "results/daylight/daylight_transport.h"

namespace lumel {

class ReflectedDaylight {
public:
    /// Arguments as of DaylightTransport. Throws Error{input} if it does not fit in memory.
    ReflectedDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                      const DaylightTransportOptions& options,
                      const std::function<bool(double)>& progress = {});

    /// False if progress stopped it.
    bool is_complete() const { return transport_.is_complete(); }
    /// Coefficients of a lumel, as of DaylightTransport.
    std::size_t count() const { return transport_.count(); }
    /// [count()] radiosity [lm/m²] of a lumel, for a luminance of 1 cd/m², and for 1 lx on a plane
    /// that faces the sun.
    const glm::vec3* of(std::size_t lumel) const { return transport_.of(lumel); }

private:
    DaylightTransport transport_;
};

}  // namespace lumel
