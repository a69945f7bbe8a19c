#pragma once
// View, size and file of an image.

#include <optional>
#include <string>

#include "gpu/device.h"
#include "jobs/render/render.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/view.h"

namespace lumel {

bool is_exr(const std::string& path);

/// The requested view, with the aspect of the image. Sets options.height.
View view_for(const Scene& scene, const RayScene& rays, RenderOptions& options);

/// Throws Error{input} if an image of this size is too large for the device or for the numbers of
/// its points.
void check_size(const gpu::Device& device, const RenderOptions& options);

/// Divides colours by alpha, as for PNG.
Image unmultiplied(Image image);

/// Writes radiance [cd/m²] as EXR.
void write_radiance(const std::string& path, const Image& image);

/// Writes radiance as EXR or tone-mapped as PNG. Returns the exposure of a PNG [m²/cd]: `given` if
/// there is one.
std::optional<float> write_picture(const std::string& path, const Image& image,
                                   std::optional<float> given = {});

}  // namespace lumel
