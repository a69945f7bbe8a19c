#pragma once
// What the benchmark can do. All throw Error and print to stdout.

#include "bench/settings.h"
#include "gpu/device.h"

namespace lumel::bench {

/// The scoreboard: the solver and the path tracer on one atlas, error against time.
void race(const Settings& settings);

/// Time per shooter and lumel for atlases of growing sides.
void grow(const Settings& settings);

/// Both projections of what eyes see: errors against rays and device time, by triangle count.
void compare_projections(const Settings& settings);

/// Processor time of edits of a scene that is kept lit over links.
void time_edits(const Settings& settings);

/// Processor time until the light of a scene has followed a change: over links, by redistribution,
/// and solved anew.
void time_following(const Settings& settings);

/// Processor time that rays and close pairs take to follow a thing that moves.
void time_moves(const Settings& settings);

/// Rays per second of the host and of the device, by each way to cast them, sweeps over links by
/// either, and bakes.
void time_casters(const Settings& settings);

/// Time of sweeps over links, by the host and by the device.
void time_sweeps(const gpu::Device& device, const SolveScene& world);

/// Time, memory and efficiency of a bake on many machines, predicted from reports of two bakes.
void predict_ranks(const Settings& settings);

/// Seams of the map before and after they are matched, as numbers and as a picture.
void show_seams(const Settings& settings);

}  // namespace lumel::bench
