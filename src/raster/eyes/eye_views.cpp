#include "raster/eyes/eye_views.h"

#include <algorithm>
#include <cmath>

#include "raster/eyes/hemicube_tiles.h"

namespace lumel {
namespace {

/// Near distance relative to the scene's diagonal. Closer surfaces are neighbours, whose exchange
/// the near field has.
constexpr float kNear = 1e-5f;
/// Maximum distance of a chord from its arc [pixels]. Pieces inside a triangle are a little longer
/// than at its edges: with 0.3, the error stays below half a pixel.
constexpr double kMaxDeviation = 0.3;

Tiles tiles_of(Projection projection, const EyeViewLayout& layout)
{
    return projection == Projection::hemisphere ? Tiles{layout.side, layout.side, layout.columns}
                                                : hemicube_tiles(layout.side, layout.columns);
}

EyeViewLayout make_layout(const gpu::Device& device, const World& world, Projection projection,
                          std::uint32_t side, std::uint32_t capacity)
{
    const bool hemisphere = projection == Projection::hemisphere;
    if (hemisphere && !device.can_tessellate())
        throw Error(ErrorKind::device, device.info().name,
                    "has no tessellation shaders, which --projection hemisphere needs; leave it at "
                    "hemicube");
    const std::uint32_t fit = fitting_hemicubes(device, side);  // both have equal width
    return {hemisphere ? 2 * side : side, tile_columns(capacity, fit),
            std::max(world.diagonal() * kNear, 1e-30f)};
}

gpu::Area face_area(Projection projection, const EyeViewLayout& layout, std::uint32_t eye,
                    std::uint32_t face)
{
    const gpu::Area tile = tiles_of(projection, layout).area(eye);
    return projection == Projection::hemisphere ? tile
                                                : hemicube_face_area(tile, layout.side, face);
}

gpu::Drawing<shaders::HemicubeCutOut>
use_cut_out(gpu::Commands& commands, const gpu::Raster<shaders::HemicubeCutOut>& raster,
            const World& world, const gpu::Array<Eye>& eyes, const CutOutDraw& cut_out)
{
    return commands.use(raster, {.eyes = eyes, .base_color = {*cut_out.color, *cut_out.sampler}},
                        {.position = world.vertices(), .look = world.looks()}, world.indices());
}

}  // namespace

std::uint64_t view_pixels(Projection projection, std::uint32_t side)
{
    const bool hemisphere = projection == Projection::hemisphere;
    const Tiles tile = tiles_of(projection, {hemisphere ? 2 * side : side, 1, 0.0f});
    return std::uint64_t(tile.width) * tile.height;
}

std::uint64_t EyeViews::device_bytes(Projection projection, std::uint32_t side,
                                     std::uint32_t capacity)
{
    return view_pixels(projection, side) * tiles_about_square(capacity) * sizeof(float) +
           (projection == Projection::hemisphere ? HemisphereCuts::device_bytes() : 0);
}

float longest_chord(float radius)
{
    return float(2.0 * std::acos(1.0 - std::min(kMaxDeviation / double(radius), 1.0)));
}

EyeViews::EyeViews(const gpu::Device& device, const World& world, Projection projection,
                   std::uint32_t side, std::uint32_t capacity)
    : world_(&world),
      projection_(projection),
      layout_(make_layout(device, world, projection, side, capacity)),
      capacity_(tiles_of(projection, layout_).fitting(capacity, device.max_image_side())),
      radius_(0.5f * float(layout_.side)),
      chord_(longest_chord(radius_)),
      image_(device, gpu::Pixel::depth, tiles_of(projection, layout_).image_width(),
             tiles_of(projection, layout_).image_height(capacity_)),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      rasters_(make_rasters(device))
{
}

EyeViews::Rasters EyeViews::make_rasters(const gpu::Device& device) const
{
    if (is_hemisphere())
        return HemisphereCuts(device, *world_, capacity_);
    return HemicubeRasters(device);
}

std::uint32_t EyeViews::faces_per_eye() const
{
    return is_hemisphere() ? 1 : kHemicubeFaces;
}

LookParams EyeViews::look_params(std::uint32_t eye, std::uint32_t face) const
{
    const gpu::Area tile = tiles_of(projection_, layout_).area(eye);
    return {.eye = eye,
            .face = face,
            .near = layout_.near,
            .corner = {tile.x, tile.y},
            .radius = radius_};
}

LookParams EyeViews::begin_face(gpu::Commands& commands, std::uint32_t eye,
                                std::uint32_t face) const
{
    commands.viewport(face_area(projection_, layout_, eye, face));
    return look_params(eye, face);
}

void EyeViews::cut(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                   std::uint32_t last)
{
    std::get<HemisphereCuts>(rasters_).cut(commands, eyes, first, last - first, layout_.near,
                                           radius_, chord_);
}

void EyeViews::draw_hemicubes(gpu::Commands& commands, const gpu::Array<Eye>& eyes,
                              std::uint32_t first, std::uint32_t last)
{
    const HemicubeRasters& rasters = std::get<HemicubeRasters>(rasters_);
    const auto draw_all = [&](const auto& drawing, const Passage& passage,
                              const gpu::Range& range) {
        for (std::uint32_t i = first; i < last; ++i) {
            LookParams params = begin_face(commands, i / kHemicubeFaces, i % kHemicubeFaces);
            params.passage = passage;
            drawing.draw(params, range);
        }
    };
    if (const gpu::Range range = world_->drawn(world_->opaque()); range.count > 0)
        draw_all(commands.use(rasters.opaque, {.eyes = eyes}, {.position = world_->vertices()},
                              world_->indices()),
                 {}, range);
    for (const CutOutDraw& cut_out : world_->cut_outs())
        if (const gpu::Range range = world_->drawn(cut_out.range); range.count > 0)
            draw_all(use_cut_out(commands, rasters.cut_out, *world_, eyes, cut_out),
                     cut_out.passage, range);
}

void EyeViews::draw_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                          std::uint32_t last)
{
    if (const auto* cuts = std::get_if<HemisphereCuts>(&rasters_))
        cuts->draw(commands, eyes, first, last,
                   [&](std::uint32_t eye) { return begin_face(commands, eye, 0); });
    else
        draw_hemicubes(commands, eyes, first, last);
}

std::uint32_t EyeViews::faces_at_once() const
{
    const auto* cuts = std::get_if<HemisphereCuts>(&rasters_);
    return cuts ? cuts->eyes_at_once() : capacity_ * kHemicubeFaces;
}

void EyeViews::look_from(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t count)
{
    const std::uint32_t faces = count * faces_per_eye();
    if (faces > faces_at_once())
        return look_from_faces(commands, eyes, 0, faces);
    if (is_hemisphere())
        cut(commands, eyes, 0, count);
    const std::uint32_t height = tiles_of(projection_, layout_).image_height(count);
    commands.begin_pass(nullptr, image_, {0, 0, image_.width(), height});
    draw_faces(commands, eyes, 0, faces);
    commands.end_pass();
}

void EyeViews::look_from(gpu::Pacer& pacer, const gpu::Array<Eye>& eyes, std::uint32_t count)
{
    const std::uint32_t faces = count * faces_per_eye();
    pacer.work("look", faces, faces_per_eye(),
               [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                   if (first == 0 && last == faces)
                       look_from(commands, eyes, count);
                   else
                       look_from_faces(commands, eyes, first, last);
               });
}

void EyeViews::look_from_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes,
                               std::uint32_t first, std::uint32_t last)
{
    for (std::uint32_t i = first; i < last; ++i) {
        if (is_hemisphere() && (i - first) % faces_at_once() == 0)
            cut(commands, eyes, i, std::min(i + faces_at_once(), last));
        commands.begin_pass(
            nullptr, image_,
            face_area(projection_, layout_, i / faces_per_eye(), i % faces_per_eye()));
        draw_faces(commands, eyes, i, i + 1);
        commands.end_pass();
    }
}

}  // namespace lumel
