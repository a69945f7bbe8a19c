#pragma once
// Lights added to a scene by options.

#include <optional>
#include <string>
#include <vector>

#include "scene/sky/cie_sky.h"
#include "scene/sky/sun.h"
#include "scene/values/scene.h"

namespace lumel {

/// A photometric file for lights by name.
struct LightProfile {
    std::string light;  ///< PunctualLight::name; * matches any letters
    std::string path;   ///< an IES LM-63 file
};

/// Time and location of an observation of the sun.
struct SunSighting {
    double latitude = 0.0, longitude = 0.0;  ///< [degrees] north and east
    std::string time;                        ///< format of seconds_since_2000()
};

struct LightOptions {
    std::string sky_file;                ///< see read_sky; empty: none
    std::optional<glm::vec3> sky_color;  ///< uniform radiance [cd/m²], if no file
    std::optional<CieSky> cie;           ///< if neither; without a sun that of `sun` counts
    std::optional<SunPosition> sun;      ///< sun of a clear day; also sets the sky if none is given
    std::optional<SunSighting> sun_seen;  ///< source of `sun`, for the record only
    float sky_scale = 1.0f;               ///< factor for the sky, not for the sun
    float ground = 0.0f;             ///< albedo below the horizon of a sky without a file; 0: none
    double sky_rotation = 0.0;       ///< about +y, counter-clockwise from above [rad]
    float light_radius = 0.0f;       ///< [m] for point and spot lights without one
    std::optional<float> sun_angle;  ///< [rad] for `sun`, and for directional lights without one
    std::vector<LightProfile> profiles;
    float max_albedo = kMaxAlbedo;  ///< see cap_albedo()
};

/// Adds the lights to a scene or changes its own, and updates its hash. A sky replaces the file's.
/// Throws Error{input} for unreadable files and unknown lights.
void add_lights(Scene& scene, const LightOptions& options);

/// Parses "R,G,B" [cd/m²] as a colour, "cie:N", "cie:N:LUX" and "cie:N:LUX@AZIMUTH,ELEVATION"
/// [degrees] as a sky of the CIE, "overcast" and "overcast:LUX" as the overcast one, other texts as
/// a file. Throws Error{input}.
void set_sky(LightOptions& options, const std::string& text);

/// Parses "AZIMUTH,ELEVATION" [degrees] or "LATITUDE,LONGITUDE,DATETIME" [degrees north and east,
/// as in seconds_since_2000]. Throws Error{input}.
void set_sun(LightOptions& options, const std::string& text);

/// Parses "light=file". Throws Error{input}.
void add_profile(LightOptions& options, const std::string& text);

}  // namespace lumel
