#pragma once
// Direct and indirect light.

namespace lumel {

/// Components of a lumel's irradiance.
enum class Parts {
    all,
    direct,    ///< from emissive surfaces, lamps and the sky without reflection
    indirect,  ///< reflected at least once
};

}  // namespace lumel
