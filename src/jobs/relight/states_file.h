#pragma once
// states.json: lights as they are to be turned.

#include <functional>
#include <string>
#include <vector>

#include "lights/light_state.h"

namespace lumel {

struct NamedState {
    std::string name;  ///< that files can have, unlike all others
    LightState light;
};

/// {"states": [{"name": …, "others": factor, "lights": {NAME: light, …}}, …]}, a factor being a
/// number or [r, g, b], from 0, and a light a factor or {"factor": …, "position": [x, y, z],
/// "direction": [x, y, z]} [m], with "azimuth" and "elevation" [degrees] of where its light comes
/// from in place of the direction, as --sun has them, and of the sky "turn" [degrees]. Names of
/// lights are not looked up. Throws Error{input} with the place of what is wrong.
std::vector<NamedState> read_states(const std::string& path);

/// Calls check() for each state of the file at `path`. What it throws gets the state's name.
void check_states(const std::vector<NamedState>& states, const std::string& path,
                  const std::function<void(const LightState&)>& check);

}  // namespace lumel
