#include "preview/preview.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "atlas/sides.h"
#include "core/bytes.h"
#include "gpu/commands.h"
#include "preview/preview.raster.h"
#include "preview/preview.shared.h"

namespace lumel {
namespace {

constexpr int kSupersample = 2;
constexpr float kNearOfDiagonal = 1e-3f;

/// The scene as the preview's shaders take it, ordered by material.
struct Vertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec4> looks;
    std::vector<glm::vec2> lightmap;
    std::vector<glm::vec4> colors;
    std::vector<std::uint32_t> indices;
    struct Range {
        std::uint32_t first, count;
    };
    std::map<std::pair<int, std::uint32_t>, Range> ranges;  ///< by material and kBack…
};

glm::vec2 texture_place(const Primitive& primitive, const TextureUse& use, std::uint32_t vertex)
{
    const auto& uv = primitive.texcoords[use.texcoord];
    return uv.empty() ? glm::vec2(0.0f) : glm::vec2(use.transform * glm::vec3(uv[vertex], 1.0f));
}

void append(Vertices& out, const Scene& scene, const Atlas& atlas, const Surface& surface)
{
    const Instance& instance = scene.instances[surface.instance];
    const Primitive& primitive = scene.meshes[instance.mesh].primitives[surface.primitive];
    const Material& material = scene.materials[primitive.material];
    const auto base = std::uint32_t(out.positions.size());
    const glm::vec2 size(float(atlas.width), float(atlas.height));
    for (std::size_t v = 0; v < surface.source_vertex.size(); ++v) {
        const std::uint32_t source = surface.source_vertex[v];
        out.positions.emplace_back(instance.transform *
                                   glm::vec4(primitive.positions[source], 1.0f));
        out.looks.emplace_back(texture_place(primitive, material.base_color_texture, source),
                               texture_place(primitive, material.emissive_texture, source));
        out.lightmap.push_back(surface.texcoord[v] / size);
        out.colors.push_back(primitive.colors.empty() ? glm::vec4(1.0f) : primitive.colors[source]);
    }
    const bool mirrored = glm::determinant(glm::mat3(instance.transform)) < 0.0f;
    for (std::size_t k = 0; k + 2 < surface.indices.size(); k += 3)
        for (const std::size_t corner :
             {std::size_t(0), std::size_t(mirrored ? 2 : 1), std::size_t(mirrored ? 1 : 2)})
            out.indices.push_back(base + surface.indices[k + corner]);
}

Vertices gather(const Scene& scene, const Atlas& atlas)
{
    Vertices out;
    std::map<std::pair<int, std::uint32_t>, std::vector<const Surface*>> surfaces;
    for (const Surface& surface : atlas.surfaces) {
        const Mesh& mesh = scene.meshes[scene.instances[surface.instance].mesh];
        const int material = mesh.primitives[surface.primitive].material;
        const std::uint32_t back = has_own_back(atlas, surface) ? kBackIsAnother
                                   : scene.materials[std::size_t(material)].double_sided
                                       ? kBackIsAlike
                                       : kBackIsBlack;
        surfaces[{material, back}].push_back(&surface);
    }
    for (const auto& [key, list] : surfaces) {
        const auto first = std::uint32_t(out.indices.size());
        for (const Surface* surface : list) {
            append(out, scene, atlas, *surface);
            if (has_own_back(atlas, *surface))
                append(out, scene, atlas, back_of(atlas, *surface));
        }
        out.ranges[key] = {first, std::uint32_t(out.indices.size()) - first};
    }
    return out;
}

/// World to clip space with reversed z, y down as Vulkan has it.
glm::mat4 projection(const View& view, float diagonal)
{
    const glm::mat4 to_view = glm::inverse(view.transform);
    glm::mat4 clip(0.0f);
    if (view.orthographic_height > 0.0f) {
        const float half = 0.5f * view.orthographic_height;
        clip[0][0] = 1.0f / (half * view.aspect);
        clip[1][1] = -1.0f / half;
        clip[2][2] = 1.0f / (4.0f * diagonal);  // nearer is larger; 4 diagonals deep
        clip[3][2] = 1.0f;
        clip[3][3] = 1.0f;
        return clip * to_view;
    }
    const float focal = 1.0f / std::tan(0.5f * view.vertical_fov);
    clip[0][0] = focal / view.aspect;
    clip[1][1] = -focal;
    clip[2][3] = -1.0f;
    clip[3][2] = kNearOfDiagonal * diagonal;
    return clip * to_view;
}

std::uint32_t level_count(int width, int height)
{
    std::uint32_t levels = 1;
    for (int side = std::max(width, height); side > 1; side /= 2)
        ++levels;
    return levels;
}

/// The scene's textures on the device; one white texel stands in for none.
class TextureSet {
public:
    TextureSet(const gpu::Device& device, const Scene& scene) : device_(&device)
    {
        targets_.reserve(scene.textures.size() + 1);
        for (const Texture& texture : scene.textures) {
            targets_.emplace_back(device, gpu::Pixel::srgba8, std::uint32_t(texture.width),
                                  std::uint32_t(texture.height),
                                  level_count(texture.width, texture.height), 1u,
                                  "texture " + std::to_string(targets_.size()));
            targets_.back().upload(texture.rgba.data());
        }
        targets_.emplace_back(device, gpu::Pixel::srgba8, 1u, 1u, 1u, 1u, "white texel");
        const std::uint32_t white = 0xffffffffu;
        targets_.back().upload(&white);
    }

    const gpu::Target& of(const TextureUse& use) const
    {
        return use.texture < 0 ? targets_.back() : targets_[std::size_t(use.texture)];
    }
    const gpu::Sampler& sampler(const TextureUse& use)
    {
        const auto address = [](Wrap wrap) {
            return wrap == Wrap::repeat     ? gpu::Address::repeat
                   : wrap == Wrap::mirrored ? gpu::Address::mirrored
                                            : gpu::Address::clamp;
        };
        const auto key = std::pair(use.wrap_s, use.wrap_t);
        auto found = samplers_.find(key);
        if (found == samplers_.end())
            found = samplers_
                        .try_emplace(key, *device_, gpu::Filter::linear, address(use.wrap_s),
                                     address(use.wrap_t))
                        .first;
        return found->second;
    }

private:
    const gpu::Device* device_;
    std::vector<gpu::Target> targets_;
    std::map<std::pair<Wrap, Wrap>, gpu::Sampler> samplers_;
};

Image shrink(const std::vector<float>& pixels, int width, int height)
{
    Image image(width, height, 4);
    const int wide = width * kSupersample;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c) {
                float sum = 0.0f;
                for (int dy = 0; dy < kSupersample; ++dy)
                    for (int dx = 0; dx < kSupersample; ++dx)
                        sum += pixels[std::size_t((y * kSupersample + dy) * wide +
                                                  x * kSupersample + dx) *
                                          4 +
                                      std::size_t(c)];
                image.at(x, y)[c] = sum / float(kSupersample * kSupersample);
            }
    return image;
}

}  // namespace

glm::ivec2 preview_size(const gpu::Device& device, const View& view, int width)
{
    const int most = int(device.max_image_side()) / kSupersample;
    const float fitting = std::clamp(float(most) * view.aspect, 1.0f, float(most));
    width = std::min(width, int(fitting));
    return {width, picture_height(width, view.aspect, most)};
}

PreviewMemory preview_memory(const Scene& scene, const Atlas& atlas, const glm::ivec2& size)
{
    constexpr std::uint64_t kOfVertex =
        sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2) + sizeof(glm::vec4);
    constexpr std::uint64_t kOfPixel = sizeof(glm::vec4), kOfDepth = sizeof(float);
    constexpr double kMips = 4.0 / 3.0;
    std::uint64_t shapes = 0, textures = 0;
    for (const Surface& surface : atlas.surfaces)
        shapes += (has_own_back(atlas, surface) ? 2 : 1) *
                  (surface.texcoord.size() * kOfVertex + bytes_of(surface.indices));
    for (const Texture& texture : scene.textures)
        textures += std::uint64_t(kMips * double(texture.rgba.size()));
    const std::uint64_t pixels = std::uint64_t(size.x) * std::uint64_t(size.y),
                        drawn = pixels * kSupersample * kSupersample,
                        texels = std::uint64_t(atlas.width) * std::uint64_t(atlas.height);
    return {.device = shapes + textures + texels * kOfPixel + drawn * (kOfPixel + kOfDepth),
            .host = shapes + (drawn + pixels) * kOfPixel};
}

Image render_preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                     const Image& irradiance, const View& view, int width, PreviewShows shows)
{
    const glm::ivec2 size = preview_size(device, view, width);
    const auto wide = std::uint32_t(size.x * kSupersample),
               high = std::uint32_t(size.y * kSupersample);
    const Vertices vertices = gather(scene, atlas);
    float diagonal = 1e-6f;
    for (const glm::vec3& p : vertices.positions)
        diagonal = std::max(diagonal, glm::length(p - glm::vec3(view.transform[3])));

    const gpu::Array<glm::vec3> positions(device, std::span<const glm::vec3>(vertices.positions));
    const gpu::Array<glm::vec4> looks(device, std::span<const glm::vec4>(vertices.looks));
    const gpu::Array<glm::vec2> places(device, std::span<const glm::vec2>(vertices.lightmap));
    const gpu::Array<glm::vec4> colors(device, std::span<const glm::vec4>(vertices.colors));
    const gpu::Array<std::uint32_t> indices(device,
                                            std::span<const std::uint32_t>(vertices.indices));
    gpu::Target lightmap(device, gpu::Pixel::rgba32, std::uint32_t(irradiance.width),
                         std::uint32_t(irradiance.height));
    lightmap.upload(irradiance.values.data());
    const gpu::Sampler of_map(
        device, shows == PreviewShows::texels ? gpu::Filter::nearest : gpu::Filter::linear,
        gpu::Address::clamp, gpu::Address::clamp);
    TextureSet textures(device, scene);
    const gpu::Target color(device, gpu::Pixel::rgba32, wide, high);
    const gpu::Target depth(device, gpu::Pixel::depth, wide, high);

    const gpu::Raster<shaders::Preview> raster(device, {.color_pixel = gpu::Pixel::rgba32});
    gpu::Commands commands(device);
    commands.begin_pass(&color, depth, {0, 0, wide, high});
    for (const auto& [key, range] : vertices.ranges) {
        const Material& material = scene.materials[std::size_t(key.first)];
        // Blended surfaces are drawn where they are more there than not.
        const float cutoff = material.alpha_mode == AlphaMode::opaque ? -1.0f
                             : material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff
                                                                      : 0.5f;
        const PreviewParams params{projection(view, diagonal),
                                   material.base_color,
                                   material.emitted,
                                   cutoff,
                                   key.second,
                                   shows == PreviewShows::light ? kShowsLight : kShowsMap};
        const TextureUse& base = material.base_color_texture;
        const TextureUse& emissive = material.emissive_texture;
        commands
            .use(raster,
                 {.base_color = {textures.of(base), textures.sampler(base)},
                  .emissive = {textures.of(emissive), textures.sampler(emissive)},
                  .irradiance = {lightmap, of_map}},
                 {.position = positions, .look = looks, .lightmap = places, .color = colors},
                 indices)
            .draw(params, {range.first, range.count});
    }
    commands.end_pass();
    commands.run();

    std::vector<float> pixels(std::size_t(wide) * high * 4);
    color.download(pixels.data());
    return shrink(pixels, size.x, size.y);
}

}  // namespace lumel
