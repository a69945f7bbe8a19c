#include "jobs/inspect/measure_picture.h"

#include <algorithm>

#include "atlas/finish/finish.h"
#include "base/core/luminance.h"
#include "base/images/false_colour.h"
#include "results/preview/preview.h"

namespace lumel {
namespace {

/// Side of a plane's image, and maximum size of a point in it [pixels].
constexpr int kPlaneSide = 720, kMaxOfPoint = 96;
/// Minimum alpha of a covered pixel.
constexpr float kCoveredTexel = 0.5f;
constexpr float kNothing = -1.0f;  ///< see false_colour()

}  // namespace

Image plane_picture(const PlaneGrid& grid, std::span<const Reading> readings)
{
    const int pixels = std::clamp(kPlaneSide / std::max(grid.columns, grid.rows), 1, kMaxOfPoint);
    std::vector<float> lux;
    for (const Reading& reading : readings)
        lux.push_back(reading.inside ? kNothing : float(reading.lux));
    Image image(grid.columns * pixels, grid.rows * pixels, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.at(x, y)[0] =
                lux[std::size_t(y / pixels) * std::size_t(grid.columns) + std::size_t(x / pixels)];
    return false_colour(image, scale_for(lux));
}

Image preview_picture(const gpu::Device& device, const SolveScene& prepared,
                      std::span<const glm::vec3> irradiance, int width)
{
    const View view = choose_view(prepared.scene, prepared.rays);
    const Image map = finish_map(prepared.scene, prepared.atlas, prepared.lumels, irradiance);
    const Image seen =
        render_preview(device, prepared.scene, prepared.atlas, map, view, width, PreviewShows::map);
    Image lux(seen.width, seen.height, 1);
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const float* pixel = seen.at(x, y);
            lux.at(x, y)[0] = pixel[3] < kCoveredTexel
                                  ? kNothing
                                  : float(luminance({pixel[0], pixel[1], pixel[2]}));
        }
    return false_colour(lux, scale_for(lux.values));
}

}  // namespace lumel
