#pragma once
// states.json: states of the lights.

#include <functional>
#include <string>
#include <vector>

#include "lights/light_state.h"

namespace lumel {

struct NamedState {
    std::string name;  ///< valid as a file name, unique
    LightState light;
};

/// {"states": [{"name": …, "others": factor, "lights": {NAME: light, …}}, …]}, where a factor is a
/// number or [r, g, b], ≥ 0, and a light is a factor or {"factor": …, "position": [x, y, z],
/// "direction": [x, y, z]} [m]; instead of the direction, "azimuth" and "elevation" of the light's
/// origin [degrees], as for --sun; for the sky also "turn" [degrees]. Does not check the lights'
/// names. Throws Error{input} with the location of the error.
std::vector<NamedState> read_states(const std::string& path);

/// Calls check() for each state of the file at `path`; adds the state's name to its exceptions.
void check_states(const std::vector<NamedState>& states, const std::string& path,
                  const std::function<void(const LightState&)>& check);

}  // namespace lumel
