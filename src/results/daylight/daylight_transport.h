#pragma once
// Daylight coefficients [TW83] of lumels: what arrives at each from every part of the sky and every
// position of the sun, direct and reflected.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/prepare/solve_scene.h"

namespace lumel {

class LinkRadiosity;

struct DaylightTransportOptions {
    std::uint32_t sky_rays = 128;  ///< of a lumel
    /// Shadow rays of all lumels to each position of the sun, at least one each: sunlit
    /// patches get as many whatever the size of lumels.
    std::uint32_t sun_rays = 100'000;
    std::uint32_t link_rays = 96;  ///< of a lumel
    std::uint32_t seed = 1;
    const char* asked_by{};  ///< the option that messages name
};

class DaylightTransport {
public:
    /// Finds direct light and the links. places: unit directions to the sun. progress: 0…1, returns
    /// false to stop; the light is then not complete. The scene must outlive this. Throws
    /// Error{input} if it does not fit in memory.
    DaylightTransport(const SolveScene& scene, std::span<const glm::vec3> places,
                      const DaylightTransportOptions& options,
                      const std::function<bool(double)>& progress = {});
    DaylightTransport(DaylightTransport&& from) noexcept;
    ~DaylightTransport();

    /// Host memory, about [bytes].
    static std::uint64_t bytes(std::size_t lumels, std::size_t places);

    /// False if progress stopped it.
    bool is_complete() const { return is_complete_; }
    /// Coefficients of a lumel: of the 145 patches of SkyPatches(1), then of the places.
    std::size_t count() const { return count_; }
    /// [count()] direct irradiance [lx], for a luminance of 1 cd/m², and for 1 lx on a plane that
    /// faces the sun. After reflect(): what that has put there.
    const glm::vec3* of(std::size_t lumel) const { return &light_[lumel * count_]; }

    /// Replaces all coefficients by kept(lumel, direct, reflected), those of buried lumels by 0;
    /// reflected: light after one bounce and more. progress: as above. Call it once.
    using Kept = std::function<glm::vec3(std::size_t lumel, const glm::vec3& direct,
                                         const glm::vec3& reflected)>;
    void reflect(const Kept& kept, const std::function<bool(double)>& progress = {});

private:
    const SolveScene& scene_;
    std::size_t count_;
    std::vector<glm::vec3> light_;  ///< [N][count_]
    std::unique_ptr<LinkRadiosity> links_;
    bool is_complete_ = false;
};

}  // namespace lumel
