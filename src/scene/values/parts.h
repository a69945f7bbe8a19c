#pragma once
// Direct and indirect light apart.

namespace lumel {

/// Which part of the light that arrives at a lumel counts.
enum class Parts {
    all,
    direct,    ///< straight from emissive surfaces, lamps and the sky
    indirect,  ///< light that was reflected before
};

}  // namespace lumel
