#include "visibility/eye_views.h"

#include <algorithm>
#include <cmath>

#include "visibility/hemicube_tiles.h"

namespace lumel {
namespace {

constexpr std::uint32_t kHemicubeVertexSpirv[] = {
#include "visibility/hemicube.vert.inc"
};
constexpr std::uint32_t kHemicubeCutOutVertexSpirv[] = {
#include "visibility/hemicube.cut_out.vert.inc"
};
constexpr std::uint32_t kHemicubeCutOutFragmentSpirv[] = {
#include "visibility/hemicube.cut_out.frag.inc"
};
constexpr std::uint32_t kHemisphereVertexSpirv[] = {
#include "visibility/hemisphere.vert.inc"
};
constexpr std::uint32_t kHemisphereControlSpirv[] = {
#include "visibility/hemisphere.tesc.inc"
};
constexpr std::uint32_t kHemisphereEvaluationSpirv[] = {
#include "visibility/hemisphere.tese.inc"
};
constexpr std::uint32_t kHemisphereFragmentSpirv[] = {
#include "visibility/hemisphere.frag.inc"
};
constexpr std::uint32_t kHemisphereCutOutFragmentSpirv[] = {
#include "visibility/hemisphere.cut_out.frag.inc"
};

/// Near distance as a part of the scene's diagonal: closer surfaces are lumels' own neighbours,
/// whose exchange the near field holds.
constexpr float kNear = 1e-5f;
/// How far a chord may leave the arc it stands for [pixels]. Pieces inside a triangle are a little
/// longer than those at its edges: with 0.3, nothing drawn is off by more than half a pixel.
constexpr double kMostDeviation = 0.3;

constexpr gpu::VertexStream kStreams[] = {{3}, {3}};
constexpr gpu::Slot kOpaqueSlots[] = {gpu::Slot::array};
constexpr gpu::Slot kCutOutSlots[] = {gpu::Slot::array, gpu::Slot::texture};
constexpr gpu::Slot kHemisphereCutOutSlots[] = {
    gpu::Slot::array, gpu::Slot::texture, gpu::Slot::array, gpu::Slot::array, gpu::Slot::array};

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
    const std::uint32_t fit = fitting_hemicubes(device, side);  // tiles of both are alike wide
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

gpu::RasterState hemisphere_state(gpu::Spirv fragment, std::span<const gpu::Slot> slots)
{
    return {.vertex = kHemisphereVertexSpirv,
            .control = kHemisphereControlSpirv,
            .evaluation = kHemisphereEvaluationSpirv,
            .fragment = fragment,
            .slots = slots,
            .param_bytes = sizeof(LookParams),
            .streams = std::span(kStreams, 1)};
}

gpu::Raster make_opaque(const gpu::Device& device, Projection projection)
{
    if (projection == Projection::hemisphere)
        return {device, "hemisphere", hemisphere_state(kHemisphereFragmentSpirv, kOpaqueSlots)};
    return {device,
            "hemicube",
            {.vertex = kHemicubeVertexSpirv,
             .slots = kOpaqueSlots,
             .param_bytes = sizeof(LookParams),
             .streams = std::span(kStreams, 1)}};
}

gpu::Raster make_cut_out(const gpu::Device& device, Projection projection)
{
    if (projection == Projection::hemisphere)
        return {device, "hemisphere.cut_out",
                hemisphere_state(kHemisphereCutOutFragmentSpirv, kHemisphereCutOutSlots)};
    return {device,
            "hemicube.cut_out",
            {.vertex = kHemicubeCutOutVertexSpirv,
             .fragment = kHemicubeCutOutFragmentSpirv,
             .slots = kCutOutSlots,
             .param_bytes = sizeof(LookParams),
             .streams = kStreams}};
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
    return view_pixels(projection, side) * tiles_about_square(capacity) * sizeof(float);
}

float longest_chord(float radius)
{
    return float(2.0 * std::acos(1.0 - std::min(kMostDeviation / double(radius), 1.0)));
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
      opaque_(make_opaque(device, projection)),
      cut_out_(make_cut_out(device, projection))
{
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
            .radius = radius_,
            .chord = chord_};
}

void EyeViews::draw_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                          std::uint32_t last)
{
    const gpu::Buffer& vertices = world_->vertices().buffer();
    const gpu::Buffer& indices = world_->indices().buffer();
    const gpu::Buffer& looks = world_->looks().buffer();
    const auto draw_all = [&](const Passage& passage, const gpu::Range& range) {
        for (std::uint32_t i = first; i < last; ++i) {
            const std::uint32_t eye = i / faces_per_eye(), face = i % faces_per_eye();
            commands.viewport(face_area(projection_, layout_, eye, face));
            LookParams params = look_params(eye, face);
            params.passage = passage;
            params.first_index = range.first;
            commands.draw(params, range);
        }
    };
    if (world_->drawn(world_->opaque()).count > 0) {
        commands.use(opaque_, {eyes}, {{&vertices}, &indices});
        draw_all({}, world_->drawn(world_->opaque()));
    }
    for (const CutOutDraw& cut_out : world_->cut_outs()) {
        if (world_->drawn(cut_out.range).count == 0)
            continue;
        const gpu::Binding color{*cut_out.color, *cut_out.sampler};
        if (is_hemisphere())
            commands.use(cut_out_, {eyes, color, vertices, looks, indices},
                         {{&vertices}, &indices});
        else
            commands.use(cut_out_, {eyes, color}, {{&vertices, &looks}, &indices});
        draw_all(cut_out.passage, world_->drawn(cut_out.range));
    }
}

void EyeViews::look_from(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t count)
{
    const std::uint32_t height = tiles_of(projection_, layout_).image_height(count);
    commands.begin_pass(nullptr, image_, {0, 0, image_.width(), height});
    draw_faces(commands, eyes, 0, count * faces_per_eye());
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
        commands.begin_pass(
            nullptr, image_,
            face_area(projection_, layout_, i / faces_per_eye(), i % faces_per_eye()));
        draw_faces(commands, eyes, i, i + 1);
        commands.end_pass();
    }
}

}  // namespace lumel
