#pragma once
// Lights that a scene file does not bring itself.

#include <optional>
#include <string>
#include <vector>

#include "scene/sky/sun.h"
#include "scene/values/scene.h"

namespace lumel {

/// A photometric file for lights of a name.
struct LightProfile {
    std::string light;  ///< PunctualLight::name; each * in it stands for any letters
    std::string path;   ///< of an IES LM-63 file
};

/// From where and when the sun is seen.
struct SunSighting {
    double latitude = 0.0, longitude = 0.0;  ///< [degrees] north and east
    std::string time;                        ///< as of seconds_since_2000()
};

struct LightOptions {
    std::string sky_file;                ///< see read_sky; empty: none
    std::optional<glm::vec3> sky_color;  ///< radiance from everywhere [cd/m²], if no file
    std::optional<float>
        overcast;  ///< of an open plane under the CIE overcast sky [lx], if neither
    std::optional<SunPosition> sun;       ///< of a clear day; the sky too, if no other is given
    std::optional<SunSighting> sun_seen;  ///< from where `sun` was computed, for the record only
    float sky_scale = 1.0f;               ///< factor to whatever sky there is, not to the sun
    double sky_rotation = 0.0;  ///< of sky and `sun` about +y, counter-clockwise from above [rad]
    float light_radius = 0.0f;  ///< of point and spot lights that have none [m]
    std::optional<float> sun_angle;  ///< of `sun`, and of directional lights that have none [rad]
    std::vector<LightProfile> profiles;
};

/// Adds the lights to a scene, or changes its own, and renews its hash. A sky given here takes the
/// place of the file's. Throws Error{input} for files that cannot be read and lights that are not
/// there.
void add_lights(Scene& scene, const LightOptions& options);

/// "R,G,B" [cd/m²] becomes the colour, "overcast" or "overcast:LUX" the overcast sky, anything else
/// the file. Throws Error{input}.
void set_sky(LightOptions& options, const std::string& text);

/// "AZIMUTH,ELEVATION" [degrees] or "LATITUDE,LONGITUDE,DATETIME" [degrees north and east, as in
/// seconds_since_2000]. Throws Error{input}.
void set_sun(LightOptions& options, const std::string& text);

/// "light=file". Throws Error{input}.
void add_profile(LightOptions& options, const std::string& text);

}  // namespace lumel
