#pragma once
// Image of lumel why.

#include <span>

#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "gpu/device.h"

namespace lumel {

/// The lit scene in dim grey, with contributors coloured from red to white by density [N], and
/// `lumel` in cyan. Display-referred, `width` pixels wide. irradiance [N] [lx].
Image why_picture(const gpu::Device& device, const SolveScene& prepared,
                  std::span<const glm::vec3> irradiance, std::span<const float> density,
                  std::uint32_t lumel, int width);

}  // namespace lumel
