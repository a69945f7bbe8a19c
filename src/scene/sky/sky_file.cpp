#include "scene/sky/sky_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <glm/gtc/constants.hpp>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "scene/load/gltf_image.h"

namespace lumel {
namespace {

constexpr float kBrightest = 65504.0f;  ///< the largest half, for infinity in an EXR

std::string lower_extension(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

Image read_image(const std::string& path)
{
    const std::string extension = lower_extension(path);
    if (extension == ".exr")
        return read_exr(path);
    if (extension == ".hdr")
        return decode_hdr(read_file(path, path), path);
    throw Error(ErrorKind::input, path,
                "is not an image of a sky; it must be an .exr or .hdr file");
}

float light_of(float value)
{
    if (!(value > 0.0f))
        return 0.0f;
    return std::isinf(value) ? kBrightest : value;
}

}  // namespace

bool is_sky_file(const std::string& path)
{
    const std::string extension = lower_extension(path);
    return extension == ".exr" || extension == ".hdr";
}

Sky read_sky(const std::string& path)
{
    const Image image = read_image(path);
    Sky sky{.width = image.width, .height = image.height};
    sky.radiance.reserve(std::size_t(image.width) * std::size_t(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* texel = image.at(x, y);
            sky.radiance.emplace_back(light_of(texel[0]), light_of(texel[1]), light_of(texel[2]));
        }
    return sky;
}

Sky turned(const Sky& sky, double angle)
{
    // Azimuth φ of the result is φ + angle of the image. Interpolates between two columns.
    const double turns = angle / glm::two_pi<double>();
    const double shift = (turns - std::floor(turns)) * sky.width;
    const int whole = int(shift);
    const auto rest = float(shift - whole);
    Sky result = sky;
    for (int row = 0; row < sky.height; ++row) {
        const std::size_t first = std::size_t(row) * std::size_t(sky.width);
        for (int column = 0; column < sky.width; ++column) {
            const int left = (column + whole) % sky.width;
            const int right = (left + 1) % sky.width;
            result.radiance[first + std::size_t(column)] =
                glm::mix(sky.radiance[first + std::size_t(left)],
                         sky.radiance[first + std::size_t(right)], rest);
        }
    }
    return result;
}

}  // namespace lumel
