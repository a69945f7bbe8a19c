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
#include "lights/light_state.h"
#include "methods/matrix/last_bounce.comp.h"
#include "methods/matrix/relightable.h"
#include "raster/shadow_maps/direct_light.h"
#include "solve/matrix/multiply.h"

namespace lumel {

/// A scene on the device, in which lamps may move.
struct LitWorld {
    const World& world;
    const Lumels& lumels;               ///< lumels of `world`
    std::vector<std::uint32_t> number;  ///< index of each in the matrix, or kNoLumel
    DirectLightOptions options;
};

/// Keeps the matrix on the device. All factors are 1 at first. Not thread-safe.
class RelightSession {
public:
    /// The device must outlive this. Throws Error{device} if there is no room.
    RelightSession(const gpu::Device& device, Relightable light);
    /// Reads scene.lumelmat; recomputes nothing. Throws Error{input} too, see read_relightable().
    RelightSession(const gpu::Device& device, const std::string& path);

    /// Lets lamps move; the members of `world` must outlive this.
    void set_world(LitWorld world) { world_.emplace(std::move(world)); }

    const Relightable& light() const { return light_; }
    std::size_t size() const { return light_.size(); }                 ///< N
    std::vector<std::string> names() const { return names_.names(); }  ///< names of the sources

    /// Scales the light of a source, or of all surfaces of an emissive material. Throws
    /// Error{input}, with the existing names, for another name, and for factors that are negative
    /// or not finite.
    void set_light(const std::string& name, const glm::vec3& factor);

    /// Moves or turns a lamp. Its shadow maps are rendered by the next irradiance(). Throws
    /// Error{input} unless the name is of a single lamp, for positions of directional lights,
    /// invalid directions, and without a world.
    void move_light(const std::string& name, const LampPlace& place);

    /// Throws Error{input} as irradiance(states) would for this state.
    void check(const LightState& state) const;

    /// H [N] [lx] for the current factors and places: shadow maps of moved lamps, and one product
    /// on the device.
    std::vector<glm::vec3> irradiance();
    /// H [states][N] [lx], independent of the current factors. Throws as set_light does, and if two
    /// names of a state are the same source.
    std::vector<std::vector<glm::vec3>> irradiance(std::span<const LightState> states);

private:
    using Factors = std::vector<glm::vec3>;  // [sources]

    /// Light of a source whose lamp has moved.
    struct Moved {
        std::size_t source;
        std::vector<glm::vec3> direct;  ///< [N] lx
        std::vector<glm::vec3> mean;    ///< [n] reflected_means() [lx]
    };
    struct State {
        Factors factors;
        std::vector<Moved> moved;
    };

    PunctualLight lamp_at(std::size_t source, const LampPlace& place) const;
    std::size_t lamp_of(const std::string& name, const LampPlace& place) const;
    Moved moved(std::size_t source, const LampPlace& place) const;
    State state_of(const LightState& state) const;
    static const Moved* moved_of(const State& state, std::size_t source);
    std::vector<std::vector<glm::vec3>> irradiance_of(std::span<const State> states);
    std::vector<glm::vec3> reflected(std::span<const State> states);
    std::vector<glm::vec3> with_direct(const State& state,
                                       std::span<const glm::vec3> reflected) const;

    const gpu::Device* device_;
    Relightable light_;
    SourceNames names_;
    std::vector<std::vector<glm::vec3>> means_;  ///< [sources][n] reflected_means() [lx]
    std::optional<LitWorld> world_;
    State now_;
    std::map<std::size_t, LampPlace> to_move_;  ///< lamps to recompute, by source
    std::optional<Multiply> multiply_;          ///< empty if nothing reflects
    std::optional<gpu::Kernel<shaders::LastBounce>> last_bounce_;
    std::optional<gpu::Array<std::uint32_t>> first_;  ///< starts of rows
    std::optional<gpu::Array<RowEntry>> entries_;
    std::optional<gpu::Array<glm::vec3>> color_;               ///< [n]
    std::optional<gpu::Array<glm::vec3>> direct_, reflected_;  ///< [kStatesAtOnce][n]
    std::optional<gpu::Array<glm::vec3>> result_;              ///< [kStatesAtOnce][N]
};

}  // namespace lumel
