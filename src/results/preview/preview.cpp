#include "results/preview/preview.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "atlas/lumels/sides.h"
#include "base/core/bytes.h"
#include "gpu/commands.h"
#include "results/preview/drawn_mesh.h"
#include "results/preview/preview.plain.raster.h"
#include "results/preview/preview.raster.h"
#include "results/preview/preview.shared.h"
#include "results/preview/preview.shrink.comp.h"
#include "results/preview/preview.whole.raster.h"

namespace lumel {
namespace {

constexpr float kNearOfDiagonal = 1e-3f;

/// World to clip space with reversed z, y down as in Vulkan.
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

/// Least opacity of fragments that are drawn as opaque ones are, if the others are blended, and if
/// they are left out. Blended fragments are not sorted by distance.
constexpr float kSolid = 0.95f, kSolidUnblended = 0.5f;

bool is_see_through(const Material& material)
{
    return material.alpha_mode == AlphaMode::blend || material.transmission > 0.0f;
}

bool has_texture(const Material& material)
{
    return material.base_color_texture.texture >= 0 || material.emissive_texture.texture >= 0;
}

bool are_alike(const PreviewParams& a, const PreviewParams& b)
{
    return a.camera == b.camera && a.base_color == b.base_color && a.emitted == b.emitted &&
           a.cutoff == b.cutoff && a.transmission == b.transmission && a.solid == b.solid &&
           a.back == b.back && a.shows == b.shows;
}

}  // namespace

/// The scene's textures on the device; a white texel replaces missing ones.
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

glm::ivec2 preview_size(const gpu::Device& device, const View& view, int width)
{
    const int most = int(device.max_image_side()) / int(kSupersample);
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
            .host = shapes + (texels + 2 * pixels) * kOfPixel};
}

/// State kept between images.
struct Preview::Parts {
    /// Inputs of an image: if all are equal, so is the image.
    struct Drawn {
        glm::uvec2 size{0u};
        bool nearest = false;
        std::vector<PreviewParams> params;  ///< per range

        bool is(const Drawn& other) const
        {
            return size == other.size && nearest == other.nearest &&
                   std::equal(params.begin(), params.end(), other.params.begin(),
                              other.params.end(), are_alike);
        }
    };
    /// A mesh on the device.
    struct Streams {
        Streams(const gpu::Device& device, const DrawnMesh& mesh)
            : positions(device, std::span(mesh.positions())),
              looks(device, std::span(mesh.looks())),
              places(device, std::span(mesh.lightmap())),
              colors(device, std::span(mesh.colors())),
              indices(device, std::span(mesh.indices()))
        {
        }

        gpu::Array<glm::vec3> positions;
        gpu::Array<glm::vec4> looks;
        gpu::Array<glm::vec2> places;
        gpu::Array<glm::vec4> colors;
        gpu::Array<std::uint32_t> indices;
    };
    /// Render targets.
    struct Canvas {
        Canvas(const gpu::Device& device, const glm::ivec2& size)
            : color(device, gpu::Pixel::rgba32, std::uint32_t(size.x) * kSupersample,
                    std::uint32_t(size.y) * kSupersample),
              depth(device, gpu::Pixel::depth, color.width(), color.height()),
              pixels(device, std::size_t(size.x) * std::size_t(size.y), gpu::Buffer::Place::host)
        {
        }

        gpu::Target color, depth;
        gpu::Array<glm::vec4> pixels;  ///< the image
    };

    Parts(const gpu::Device& device, const Scene& scene, const Atlas& atlas)
        : textures(device, scene),
          linear(device, gpu::Filter::linear, gpu::Address::clamp, gpu::Address::clamp),
          nearest(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
          every(device, {.color_pixel = gpu::Pixel::rgba32}),
          whole(device, {.color_pixel = gpu::Pixel::rgba32}),
          plain(device, {.color_pixel = gpu::Pixel::rgba32}),
          shrink(device),
          commands(device, gpu::Timing::off),
          mesh(scene, atlas),
          streams(device, mesh)
    {
        if (!device.can_blend_floats())
            return;
        film.emplace(device, gpu::RasterOptions{.color_pixel = gpu::Pixel::rgba32,
                                                .blend = gpu::Blend::over});
        tint.emplace(device, gpu::RasterOptions{.color_pixel = gpu::Pixel::rgba32,
                                                .blend = gpu::Blend::multiply});
    }

    bool take_places(const Scene& scene);
    bool take_map(const gpu::Device& device, const Image& map);
    std::vector<PreviewParams> params_of(const Scene& scene, const View& view,
                                         PreviewShows shows) const;
    template <class Shaders>
    typename Shaders::Bindings with_textures(const Material& material, const gpu::Sampler& of_map);
    template <class Shaders>
    void draw(const gpu::Raster<Shaders>& raster, const typename Shaders::Bindings& given,
              const PreviewParams& params, const gpu::Range& range);
    void record(const Scene& scene, const Drawn& what);
    void record_see_through(const Scene& scene, const Drawn& what);
    void average(const glm::uvec2& size, float exposure, Image& image);

    TextureSet textures;
    gpu::Sampler linear, nearest;
    gpu::Raster<shaders::Preview> every;
    gpu::Raster<shaders::PreviewWhole> whole;
    gpu::Raster<shaders::PreviewPlain> plain;
    std::optional<gpu::Raster<shaders::Preview>> film, tint;  ///< of kShowsFilm and kShowsTint
    gpu::Kernel<shaders::PreviewShrink> shrink;
    gpu::Commands commands;
    DrawnMesh mesh;
    Streams streams;
    std::optional<Canvas> canvas;
    std::optional<gpu::Target> lightmap;
    Image map;  ///< contents of the lightmap
    std::optional<Drawn> drawn;
    Image picture;
};

/// True if an instance has moved.
bool Preview::Parts::take_places(const Scene& scene)
{
    const std::optional<Stretch> moved = mesh.place(scene);
    if (moved)
        streams.positions.upload_part(
            moved->first,
            std::span(mesh.positions()).subspan(moved->first, moved->last - moved->first));
    return moved.has_value();
}

/// True if the map differs: uploads the rows from the first to the last that differ.
bool Preview::Parts::take_map(const gpu::Device& device, const Image& given)
{
    if (!lightmap || map.width != given.width || map.height != given.height) {
        lightmap.reset();
        lightmap.emplace(device, gpu::Pixel::rgba32, std::uint32_t(given.width),
                         std::uint32_t(given.height));
        lightmap->upload(given.values.data());
        map = given;
        return true;
    }
    const std::size_t row = std::size_t(given.width) * 4;
    const auto differs = [&](int y) {
        return std::memcmp(given.at(0, y), map.at(0, y), row * sizeof(float)) != 0;
    };
    int first = 0, last = given.height;
    while (first < last && !differs(first))
        ++first;
    while (last > first && !differs(last - 1))
        --last;
    if (first == last)
        return false;
    lightmap->upload_rows(given.at(0, first), std::uint32_t(first), std::uint32_t(last - first));
    std::copy(given.at(0, first), given.at(0, first) + row * std::size_t(last - first),
              map.at(0, first));
    return true;
}

std::vector<PreviewParams> Preview::Parts::params_of(const Scene& scene, const View& view,
                                                     PreviewShows shows) const
{
    const glm::mat4 camera = projection(view, mesh.farthest_from(glm::vec3(view.transform[3])));
    std::vector<PreviewParams> all;
    for (const auto& [key, range] : mesh.ranges()) {
        const Material& material = scene.materials[std::size_t(key.first)];
        const float cutoff = material.alpha_mode == AlphaMode::blend  ? -1.0f
                             : material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff
                                                                      : 0.0f;
        const bool lit = shows == PreviewShows::light;
        all.push_back({.camera = camera,
                       .base_color = material.base_color,
                       .emitted = material.emitted,
                       .cutoff = cutoff,
                       .transmission = material.transmission,
                       .solid = lit && film ? kSolid : kSolidUnblended,
                       .back = key.second,
                       .shows = lit ? kShowsLight : kShowsMap});
    }
    return all;
}

template <class Shaders>
typename Shaders::Bindings Preview::Parts::with_textures(const Material& material,
                                                         const gpu::Sampler& of_map)
{
    const TextureUse &base = material.base_color_texture, &emissive = material.emissive_texture;
    return {.irradiance = {*lightmap, of_map},
            .base_color = {textures.of(base), textures.sampler(base)},
            .emissive = {textures.of(emissive), textures.sampler(emissive)}};
}

template <class Shaders>
void Preview::Parts::draw(const gpu::Raster<Shaders>& raster,
                          const typename Shaders::Bindings& given, const PreviewParams& params,
                          const gpu::Range& range)
{
    commands
        .use(raster, given,
             {.position = streams.positions,
              .look = streams.looks,
              .lightmap = streams.places,
              .color = streams.colors},
             streams.indices)
        .draw(params, range);
}

/// Puts glass and blended surfaces in front of the rest: D' = S + (1 - opacity) tint D.
void Preview::Parts::record_see_through(const Scene& scene, const Drawn& what)
{
    auto given = what.params.begin();
    for (const auto& [key, range] : mesh.ranges()) {
        const Material& material = scene.materials[std::size_t(key.first)];
        PreviewParams params = *given++;
        if (!film || params.shows != kShowsLight || !is_see_through(material))
            continue;
        const gpu::Range part{range.first, range.count};
        const auto textures_of = with_textures<shaders::Preview>(material, linear);
        if (material.transmission > 0.0f) {
            params.shows = kShowsTint;
            draw(*tint, textures_of, params, part);
        }
        params.shows = kShowsFilm;
        draw(*film, textures_of, params, part);
    }
}

void Preview::Parts::record(const Scene& scene, const Drawn& what)
{
    const glm::uvec2 wide(canvas->color.width(), canvas->color.height());
    commands.begin_pass(&canvas->color, canvas->depth, {0, 0, wide.x, wide.y});
    auto params = what.params.begin();
    for (const auto& [key, range] : mesh.ranges()) {
        const Material& material = scene.materials[std::size_t(key.first)];
        const gpu::Range part{range.first, range.count};
        const gpu::Sampler& of_map = what.nearest ? nearest : linear;
        const bool is_whole = material.alpha_mode == AlphaMode::opaque &&
                              material.transmission <= 0.0f && key.second != kBackIsAnother;
        if (is_whole && !has_texture(material))
            draw(plain, {.irradiance = {*lightmap, of_map}}, *params, part);
        else if (is_whole)
            draw(whole, with_textures<shaders::PreviewWhole>(material, of_map), *params, part);
        else
            draw(every, with_textures<shaders::Preview>(material, of_map), *params, part);
        ++params;
    }
    record_see_through(scene, what);
    commands.end_pass();
}

/// Averages the samples on the canvas. exposure: see ShrinkParams. Runs the commands.
void Preview::Parts::average(const glm::uvec2& size, float exposure, Image& image)
{
    commands.dispatch(shrink, {.picture = {canvas->color, nearest}, .pixels = canvas->pixels},
                      {size.x, size.y, exposure}, canvas->pixels.size());
    commands.run();
    if (image.width != int(size.x) || image.height != int(size.y))
        image = Image(int(size.x), int(size.y), 4);
    std::memcpy(image.values.data(), canvas->pixels.mapped(),
                canvas->pixels.size() * sizeof(glm::vec4));
}

Preview::Preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas)
    : device_(&device),
      parts_(std::make_unique<Parts>(device, scene, atlas))
{
}

Preview::~Preview() = default;

void Preview::show(const Scene& scene, const Atlas& atlas)
{
    parts_->mesh = DrawnMesh(scene, atlas);
    parts_->streams = Parts::Streams(*device_, parts_->mesh);
    parts_->drawn.reset();
}

const Image& Preview::draw(const Scene& scene, const Image& map, const View& view, int width,
                           PreviewShows shows)
{
    Parts& parts = *parts_;
    const glm::ivec2 size = preview_size(*device_, view, width);
    const bool moved = parts.take_places(scene), lit = parts.take_map(*device_, map);
    Parts::Drawn what{.size = glm::uvec2(size),
                      .nearest = shows == PreviewShows::texels,
                      .params = parts.params_of(scene, view, shows)};
    if (!moved && !lit && parts.drawn && parts.drawn->is(what))
        return parts.picture;
    if (!parts.drawn || parts.drawn->size != what.size) {
        parts.canvas.reset();
        parts.canvas.emplace(*device_, size);
    }
    parts.drawn.reset();
    parts.record(scene, what);
    parts.average(what.size, 0.0f, parts.picture);
    parts.drawn = std::move(what);
    return parts.picture;
}

Image Preview::tone_mapped(float exposure)
{
    Image display;
    parts_->average(parts_->drawn->size, exposure, display);
    return display;
}

Image Preview::release()
{
    parts_->drawn.reset();
    return std::exchange(parts_->picture, {});
}

Image render_preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                     const Image& irradiance, const View& view, int width, PreviewShows shows)
{
    Preview preview(device, scene, atlas);
    preview.draw(scene, irradiance, view, width, shows);
    return preview.release();
}

}  // namespace lumel
