#pragma once
// A baked scene under any light, for host programs and for lumel relight.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017. Eq. (8).

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/array.h"
#include "matrix/multiply.h"
#include "relight/last_bounce.comp.h"
#include "relight/relightable.h"

namespace lumel {

/// Factors to the light of sources, by the sources' names or by those of materials that shine.
struct LightState {
    glm::vec3 others{1.0f};  ///< of sources that are not named
    std::map<std::string, glm::vec3> lights;
};

/// Holds the matrix on the device. All factors are 1 at first. For one thread at a time.
class RelightSession {
public:
    /// The device must outlive this. Throws Error{device} if there is no room.
    RelightSession(const gpu::Device& device, Relightable light);
    /// Reads scene.lumelmat first; nothing is computed anew. Throws Error{input} too, see
    /// read_relightable().
    RelightSession(const gpu::Device& device, const std::string& path);

    const Relightable& light() const { return light_; }
    std::size_t size() const { return light_.size(); }  ///< N
    std::vector<std::string> names() const;             ///< of the sources

    /// Multiplies what a source, or all that a material makes shine, sends; factors may be
    /// anything from 0. Throws Error{input}, with the names that there are, for another name, and
    /// for factors that are negative or no numbers.
    void set_light(const std::string& name, const glm::vec3& factor);

    /// Throws Error{input} as irradiance(states) would for this state.
    void check(const LightState& state) const { factors_of(state); }

    /// H [N] [lx] of the factors set: by one multiply on the device.
    std::vector<glm::vec3> irradiance();
    /// H [states][N] [lx], whatever is set. Throws as set_light does, and where two names of one
    /// state mean the same source.
    std::vector<std::vector<glm::vec3>> irradiance(std::span<const LightState> states);

private:
    using Factors = std::vector<glm::vec3>;  // [sources]

    std::vector<std::size_t> sources_of(const std::string& name) const;
    Factors factors_of(const LightState& state) const;
    std::vector<std::vector<glm::vec3>> irradiance_of(std::span<const Factors> states);
    std::vector<glm::vec3> reflected(std::span<const Factors> states);
    std::vector<glm::vec3> with_direct(const Factors& factors,
                                       std::span<const glm::vec3> reflected) const;

    const gpu::Device* device_;
    Relightable light_;
    std::vector<std::vector<glm::vec3>> means_;  ///< [sources][n] reflected_means() [lx]
    Factors factors_;
    std::optional<Multiply> multiply_;  ///< none where nothing reflects
    std::optional<gpu::Kernel<shaders::LastBounce>> last_bounce_;
    std::optional<gpu::Array<std::uint32_t>> first_;  ///< of the rows
    std::optional<gpu::Array<RowEntry>> entries_;
    std::optional<gpu::Array<glm::vec3>> color_;               ///< [n]
    std::optional<gpu::Array<glm::vec3>> direct_, reflected_;  ///< [kStatesAtOnce][n]
    std::optional<gpu::Array<glm::vec3>> result_;              ///< [kStatesAtOnce][N]
};

}  // namespace lumel
