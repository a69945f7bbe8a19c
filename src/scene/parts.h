#pragma once
// Direct and indirect light apart.

namespace lumel {

/// Which of the light that arrives at a lumel is asked for.
enum class Parts {
    all,
    direct,    ///< straight from emissive surfaces, lamps and the sky
    indirect,  ///< what has been reflected on its way
};

}  // namespace lumel
