// EXT_lights_image_based. Only the first, sharpest cube of "specularImages" is used: solving
// replaces the blurred levels and the irradiance.
//
// The extension stores the faces +x -x +y -y +z -z in OpenGL's order and orientation, each mirrored
// left to right, as seen from inside the cube. With p the direction divided by its largest
// coordinate, and (s, t) in −1…1 from a face's left and top:
//
//     +x: s = p.z, t = −p.y     +y: s = −p.x, t =  p.z     +z: s = −p.x, t = −p.y
//     -x: s = −p.z, t = −p.y    -y: s = −p.x, t = −p.z     -z: s =  p.x, t = −p.y

#include "scene/load/gltf_sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "base/core/parallel.h"
#include "scene/load/gltf_material.h"
#include "scene/load/gltf_nodes.h"
#include "scene/values/scene.h"
#include "scene/values/srgb.h"

namespace lumel {
namespace {

constexpr const char* kSkyExtension = "EXT_lights_image_based";
constexpr int kFaces = 6;
constexpr int kLargestFace = 1024;  ///< larger faces are averaged
constexpr int kFine = 4;            ///< samples along each side of a sky texel

struct Cube {
    std::array<std::vector<glm::vec3>, kFaces> faces;  ///< [size][size] radiance
    int size = 0;
};

/// RGBD: sRGB colour over alpha; opaque images are plain colour.
glm::vec3 radiance_of(const std::uint8_t* rgba)
{
    const auto& linear = srgb_to_linear();
    const float divisor = float(std::max<int>(rgba[3], 1)) / 255.0f;
    return glm::vec3(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]) / divisor;
}

Cube read_cube(const GltfDocument& document, const JsonView& light)
{
    const JsonView mips = light.get("specularImages");
    const JsonView sharpest = mips.at(0);
    if (sharpest.as_array().json().size() != kFaces)
        sharpest.fail("must list the 6 faces of a cube");
    std::vector<std::size_t> images;
    sharpest.each([&](const JsonView& view, std::size_t) {
        images.push_back(view.index(document.root().count("images"), "images"));
    });
    const std::vector<Texture> textures = read_textures(document, images);
    Cube cube{.size = textures[0].width};
    for (std::size_t face = 0; face < textures.size(); ++face) {
        const Texture& texture = textures[face];
        if (texture.width != cube.size || texture.height != cube.size)
            sharpest.fail("must list square images of one size");
        for (std::size_t i = 0; i < texture.rgba.size(); i += 4)
            cube.faces[face].push_back(radiance_of(&texture.rgba[i]));
    }
    return cube;
}

glm::vec3 radiance_towards(const Cube& cube, const glm::vec3& d)
{
    const glm::vec3 size = glm::abs(d);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const glm::vec3 p = d / size[axis];
    const float sign = p[axis];  // ±1
    const glm::vec2 place = axis == 0   ? glm::vec2(sign * p.z, -p.y)
                            : axis == 1 ? glm::vec2(-p.x, sign * p.z)
                                        : glm::vec2(-sign * p.x, -p.y);
    const auto texel = [&](float at) {
        return std::clamp(int((at + 1.0f) * 0.5f * float(cube.size)), 0, cube.size - 1);
    };
    const auto& face = cube.faces[std::size_t(axis) * 2 + std::size_t(sign < 0.0f)];
    return face[std::size_t(texel(place.y)) * std::size_t(cube.size) + std::size_t(texel(place.x))];
}

/// Mean radiance over the directions of a sky texel.
glm::vec3 mean_radiance(const Cube& cube, const Sky& sky, const glm::mat3& into_cube, int row,
                        int column)
{
    glm::vec3 sum(0.0f);
    for (int fine = 0; fine < kFine * kFine; ++fine) {
        const int fine_row = fine / kFine;
        const float along = (float(fine % kFine) + 0.5f) / kFine;
        const float down = (float(fine_row) + 0.5f) / kFine;
        const float phi = glm::two_pi<float>() * (float(column) + along) / float(sky.width);
        const float theta = glm::pi<float>() * (float(row) + down) / float(sky.height);
        const glm::vec3 direction(-std::cos(phi) * std::sin(theta), std::cos(theta),
                                  -std::sin(phi) * std::sin(theta));
        sum += radiance_towards(cube, into_cube * direction);
    }
    return sum / float(kFine * kFine);
}

Sky sky_of(const Cube& cube, const glm::mat3& rotation, float intensity)
{
    // A face spans a quarter of the circle.
    const int side = std::min(cube.size, kLargestFace);
    Sky sky{.width = 4 * side, .height = 2 * side};
    sky.radiance.resize(std::size_t(sky.width) * std::size_t(sky.height));
    const glm::mat3 into_cube = glm::transpose(rotation);
    parallel_for(std::size_t(sky.height), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (int column = 0; column < sky.width; ++column)
                sky.radiance[row * std::size_t(sky.width) + std::size_t(column)] =
                    intensity * mean_radiance(cube, sky, into_cube, int(row), column);
    });
    return sky;
}

}  // namespace

Sky read_image_based_light(const GltfDocument& document)
{
    const auto scene = default_scene(document.root());
    const auto use = scene ? scene->extension(kSkyExtension) : std::nullopt;
    if (!use)
        return {};
    const auto list = document.root().extension(kSkyExtension);
    const std::size_t count = list ? list->count("lights") : 0;
    const JsonView light = [&] {
        const std::size_t index = use->get("light").index(count, "lights");
        return list->get("lights").at(index);
    }();
    const float intensity = light.number_or("intensity", 1.0f);
    if (intensity < 0.0f)
        light.fail("has a negative intensity");
    return sky_of(read_cube(document, light), glm::mat3_cast(glm::quat(rotation_of(light))),
                  intensity);
}

}  // namespace lumel
