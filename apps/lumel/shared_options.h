#pragma once
// Options that several commands take, and the titles that --help and docs/options.md put above
// options.

#include <string>
#include <vector>

#include "arguments.h"
#include "command.h"

namespace lumel {

inline constexpr const char* kLightGroup = "Light";
inline constexpr const char* kLightmapGroup = "Lightmap";
inline constexpr const char* kStopGroup = "When to stop";
inline constexpr const char* kPictureGroup = "Pictures";
inline constexpr const char* kFilesGroup = "Files";
inline constexpr const char* kProgramGroup = "Device and messages";

inline constexpr int kLargestAtlas = 16384;  ///< side that common devices offer [texels]
inline constexpr int kMaxFrames = 100'000, kMaxAnimations = 1'000'000;
inline constexpr int kMinSamples = 64, kMaxSamples = 1 << 24;  ///< of a light meter
inline constexpr double kMaxErrorPercent = 100.0;              ///< of bakes between frames
inline constexpr double kMaxFps = 1000.0;                      ///< pictures a second
inline constexpr int kMaxShots = 2'000'000'000;
inline constexpr int kMaxPaths = 100'000'000;

// Arguments.

Option scene_argument(std::string& scene);

/// A folder to write to.
Option result_argument(std::string& folder);

/// The folder of a finished bake.
Option bake_argument(std::string& folder, const std::string& help = "Folder that lumel bake wrote");

// Options. The targets must outlive the command.

void add_atlas_options(Command& command, AtlasOptions& atlas);

/// For commands that write or measure lightmaps.
void add_sides_option(Command& command, AtlasOptions& atlas);

/// Sky, sun, and properties of lamps.
void add_light_options(Command& command, LightOptions& lights);

void add_json_flag(Command& command, bool& json);

void add_talk_options(Command& command, Talk& talk);

void add_stop_options(Command& command, SolverOptions& solver);

/// The target of a solve without --error: none beside another limit; else that of --quality good,
/// or the default error of methods that do not state it. Call when all values are known.
void set_default_target(const Command& command, SolverOptions& solver);

void add_sky_directions_option(Command& command, BakeOptions& options);

void add_keep_lights_option(Command& command, bool& keep_lights);

void add_scene_file_options(Command& command, BakeOptions& options);

void add_half_option(Command& command, bool& half);

void add_only_option(Command& command, Parts& parts);

void add_directional_option(Command& command, Directional& directional);

/// --group, which turns another option on. title: above it.
void add_group_option(Command& command, const char* title, const std::string& implied,
                      std::vector<LampGroup>& groups);

void add_device_option(Command& command, std::string& device);

/// Memory limit of a bake [bytes].
void add_memory_option(Command& command, std::uint64_t& bytes);

void add_dump_option(Command& command, std::string& folder);

void add_preview_option(Command& command, int& width);

/// Camera and resolution.
void add_picture_options(Command& command, int& camera, int& width);

}  // namespace lumel
