#include "scene/load/ies.h"
#include "readers.h"

namespace lumel::fuzz {

void read_ies(Input input)
{
    const Photometry profile = lumel::read_ies({input.begin(), input.end()}, "lamp.ies", "lamp");
    require(profile.candela.size() ==
                Photometry::kAzimuthSteps * (Photometry::kPolarSteps + std::size_t(1)),
            "a profile has all its directions");
    for (const float candela : profile.candela)
        require(candela >= 0.0f, "candela are not below 0");
}

}  // namespace lumel::fuzz
