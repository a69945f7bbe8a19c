#include "jobs/render/picture_file.h"

#include <algorithm>
#include <limits>

#include "base/images/image_files.h"
#include "methods/glossy/eye_image.h"
#include "results/files/folder.h"
#include "results/preview/view.h"
#include "results/record/origin.h"

namespace lumel {
namespace {

constexpr int kLargestPicture = 16384;  ///< side [pixels]

}  // namespace

bool is_exr(const std::string& path)
{
    return path.ends_with(".exr");
}

View view_for(const Scene& scene, const RayScene& rays, RenderOptions& options)
{
    check_camera(scene, options.camera);
    View view = options.camera >= 0 ? view_of(scene.cameras[std::size_t(options.camera)])
                                    : choose_view(scene, rays);
    if (options.height == 0)
        options.height = picture_height(options.width, view.aspect, kLargestPicture);
    view.aspect = float(options.width) / float(options.height);  // pixels are square
    return view;
}

void check_size(const gpu::Device& device, const RenderOptions& options)
{
    const std::uint64_t pixels = std::uint64_t(options.width) * std::uint64_t(options.height);
    const std::uint64_t most =
        std::min(EyeImage::most_points(device),
                 std::uint64_t(std::numeric_limits<std::uint32_t>::max()) / options.sets);
    if (pixels > most)
        throw Error(ErrorKind::input, "--width " + std::to_string(options.width),
                    "makes an image of " + std::to_string(pixels) + " pixels, more than the " +
                        std::to_string(most) + " that this device can hold with these --places");
}

Image unmultiplied(Image image)
{
    for (std::size_t i = 0; i < image.values.size(); i += 4)
        if (const float alpha = image.values[i + 3]; alpha > 0.0f)
            for (std::size_t c = 0; c < 3; ++c)
                image.values[i + c] /= alpha;
    return image;
}

void write_radiance(const std::string& path, const Image& image)
{
    write_exr(path, image, Precision::float32,
              {{"quantity", "radiance"},
               {"unit", "cd/m2"},
               {"colorSpace", "linear Rec. 709"},
               {"software", "lumel " + lumel_version()}});
}

std::optional<float> write_picture(const std::string& path, const Image& image,
                                   std::optional<float> given)
{
    OutputFile file(path);
    std::optional<float> exposure;
    if (is_exr(path)) {
        write_radiance(file.path(), image);
    } else {
        const Image shown = unmultiplied(image);
        exposure = given ? *given : choose_exposure(shown).value_or(1.0f);
        write_png(file.path(), tone_map(shown, *exposure));
    }
    file.commit();
    return exposure;
}

}  // namespace lumel
