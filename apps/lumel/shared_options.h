#pragma once
// Options that several commands take, and the titles that --help and docs/options.md put above
// options.

#include <string>

#include "arguments.h"

namespace CLI {
class App;
}

namespace lumel {

inline constexpr const char* kLightGroup = "Light";
inline constexpr const char* kLightmapGroup = "Lightmap";
inline constexpr const char* kStopGroup = "When to stop";
inline constexpr const char* kPictureGroup = "Pictures";
inline constexpr const char* kProgramGroup = "Device and messages";

inline constexpr int kLargestAtlas = 16384;  ///< side that common devices offer [texels]
inline constexpr int kMaxShots = 2'000'000'000;
inline constexpr int kMaxPaths = 100'000'000;

void add_atlas_options(CLI::App& app, AtlasOptions& atlas);

/// Of what writes or measures lightmaps.
void add_sides_option(CLI::App& app, AtlasOptions& atlas);

/// Light from outside, and what lamps are like.
void add_light_options(CLI::App& app, LightOptions& lights);

void add_json_flag(CLI::App& app, bool& json);

void add_talk_options(CLI::App& app, Talk& talk);

/// When to stop. Without any of the three the bake ends at the default error.
void add_stop_options(CLI::App& app, SolverOptions& solver);

void add_sky_directions_option(CLI::App& app, BakeOptions& options);

void add_keep_lights_option(CLI::App& app, bool& keep_lights);

void add_scene_file_options(CLI::App& app, BakeOptions& options);

void add_half_option(CLI::App& app, bool& half);

void add_only_option(CLI::App& app, Parts& parts);

void add_directional_option(CLI::App& app, Directional& directional);

void add_device_option(CLI::App& app, std::string& device);

/// How much memory a bake may take [bytes].
void add_memory_option(CLI::App& app, std::uint64_t& bytes);

void add_dump_option(CLI::App& app, std::string& folder);

void add_preview_option(CLI::App& app, int& width);

/// Who looks, and how finely.
void add_picture_options(CLI::App& app, int& camera, int& width);

}  // namespace lumel
