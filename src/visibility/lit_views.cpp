#include "visibility/lit_views.h"

#include "visibility/hemicube_tiles.h"

namespace lumel {
namespace {

constexpr std::uint32_t kVertexSpirv[] = {
#include "visibility/lit.vert.inc"
};
constexpr std::uint32_t kFragmentSpirv[] = {
#include "visibility/lit.frag.inc"
};
constexpr std::uint32_t kCutOutVertexSpirv[] = {
#include "visibility/lit.cut_out.vert.inc"
};
constexpr std::uint32_t kCutOutFragmentSpirv[] = {
#include "visibility/lit.cut_out.frag.inc"
};

constexpr gpu::VertexStream kStreams[] = {{3}, {2}, {4}, {3}};
constexpr gpu::Slot kSlots[] = {gpu::Slot::array, gpu::Slot::array, gpu::Slot::array,
                                gpu::Slot::texture};

Tiles tiles_of(const EyeViewLayout& layout)
{
    return hemicube_tiles(layout.side, layout.columns);
}

gpu::Raster make_raster(const gpu::Device& device, bool cut_out)
{
    return {device,
            cut_out ? "lit.cut_out" : "lit",
            {.vertex = cut_out ? gpu::Spirv(kCutOutVertexSpirv) : gpu::Spirv(kVertexSpirv),
             .fragment = cut_out ? gpu::Spirv(kCutOutFragmentSpirv) : gpu::Spirv(kFragmentSpirv),
             .slots = std::span(kSlots, cut_out ? 4 : 3),
             .param_bytes = sizeof(LitParams),
             .streams = std::span(kStreams, cut_out ? 4 : 3),
             .color = true,
             .color_pixel = gpu::Pixel::rgba32,
             .samples = gpu::kManySamples}};
}

EyeViewLayout make_layout(const gpu::Device& device, std::uint32_t side, float near,
                          std::uint32_t capacity)
{
    if (!device.can_clip())
        throw Error(ErrorKind::device, device.info().name,
                    "has no clip distances, which gathering light needs");
    return {side, tile_columns(capacity, fitting_hemicubes(device, side)), near};
}

}  // namespace

LitViews::LitViews(const gpu::Device& device, const World& world, std::uint32_t side, float near,
                   std::uint32_t capacity)
    : world_(&world),
      layout_(make_layout(device, side, near, capacity)),
      capacity_(tiles_of(layout_).fitting(capacity, device.max_image_side())),
      image_(device, gpu::Pixel::rgba32, tiles_of(layout_).image_width(),
             tiles_of(layout_).image_height(capacity_), 1, gpu::kManySamples),
      depth_(device, gpu::Pixel::depth, image_.width(), image_.height(), 1, gpu::kManySamples),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      opaque_(make_raster(device, false)),
      cut_out_(make_raster(device, true))
{
}

std::uint64_t LitViews::device_bytes(std::uint32_t side, std::uint32_t capacity)
{
    const Tiles tile = hemicube_tiles(side, 1);
    const std::uint64_t pixels =
        std::uint64_t(tile.width) * tile.height * tiles_about_square(capacity);
    return pixels * gpu::kManySamples *
           (gpu::image_bytes(gpu::Pixel::rgba32, 1, 1) + gpu::image_bytes(gpu::Pixel::depth, 1, 1));
}

void LitViews::draw(gpu::Commands& commands, const gpu::Array<Eye>& eyes, const SurfaceLight& light,
                    std::uint32_t first, std::uint32_t last)
{
    const gpu::Buffer& vertices = world_->vertices().buffer();
    const gpu::Buffer& places = world_->places().buffer();
    const gpu::Buffer& charts = world_->charts().buffer();
    const gpu::Buffer& indices = world_->indices().buffer();
    const auto draw_all = [&](const OccluderRange& range, const Passage& passage) {
        for (std::uint32_t eye = first; eye < last; ++eye)
            for (std::uint32_t face = 0; face < kHemicubeFaces; ++face) {
                commands.viewport(
                    hemicube_face_area(tiles_of(layout_).area(eye), layout_.side, face));
                commands.draw(LitParams{.eye = eye,
                                        .face = face,
                                        .near = layout_.near,
                                        .width = light.width,
                                        .height = light.height,
                                        .passage = passage},
                              world_->drawn_with_hull(range));
            }
    };
    if (world_->drawn_with_hull(world_->opaque()).count > 0) {
        commands.use(opaque_, {eyes, *light.lumel_of, *light.radiosity},
                     {{&vertices, &places, &charts}, &indices});
        draw_all(world_->opaque(), {});
    }
    for (const CutOutDraw& cut_out : world_->cut_outs()) {
        if (world_->drawn_with_hull(cut_out.range).count == 0)
            continue;
        commands.use(cut_out_,
                     {eyes, *light.lumel_of, *light.radiosity, {*cut_out.color, *cut_out.sampler}},
                     {{&vertices, &places, &charts, &world_->looks().buffer()}, &indices});
        draw_all(cut_out.range, cut_out.passage);
    }
}

void LitViews::look_from(gpu::Pacer& pacer, const gpu::Array<Eye>& eyes, const SurfaceLight& light,
                         std::uint32_t count)
{
    pacer.work("look", count, 1,
               [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                   const Tiles tiles = tiles_of(layout_);
                   if (first == 0 && last == count) {
                       commands.begin_pass(&image_, depth_,
                                           {0, 0, image_.width(), tiles.image_height(count)});
                       draw(commands, eyes, light, 0, count);
                       commands.end_pass();
                       return;
                   }
                   for (std::uint32_t eye = first; eye < last; ++eye) {
                       commands.begin_pass(&image_, depth_, tiles.area(eye));
                       draw(commands, eyes, light, eye, eye + 1);
                       commands.end_pass();
                   }
               });
}

}  // namespace lumel
