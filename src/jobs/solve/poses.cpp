#include "jobs/solve/poses.h"

#include <fmt/format.h>

#include "atlas/near/still_part.h"
#include "base/core/error.h"

namespace lumel {
namespace {

/// Larger coordinates overflow in later computations [m].
constexpr double kFarthest = 1e9;

}  // namespace

void check_poses(const Scene& start, const Animation& animation, int frames, double fps)
{
    const std::vector<std::uint32_t> movers = movers_of(animation, start);
    for (int frame = 0; frame < frames; ++frame)
        for (const std::uint32_t i : movers) {
            const Instance& instance = start.instances[i];
            const double time = double(frame) / fps;
            const glm::mat4 place = place_in(start, animation, instance.node, time);
            const std::string at =
                fmt::format("{}: \"{}\" at {:.3g} s", start.path, instance.name, time);
            if (!is_rigid(instance.transform, place))
                throw Error(
                    ErrorKind::input, at,
                    "is stretched by the animation; objects can be rotated and moved, but not "
                    "stretched");
            if (!(glm::length(glm::dvec3(place[3])) <= kFarthest))
                throw Error(ErrorKind::input, at, "is too far out to be computed");
        }
}

}  // namespace lumel
