#include "raster/eyes/lit_views.h"

#include "raster/eyes/hemicube_tiles.h"

namespace lumel {
namespace {

Tiles tiles_of(const EyeViewLayout& layout)
{
    return hemicube_tiles(layout.side, layout.columns);
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
      rasters_(device, {.color_pixel = gpu::Pixel::rgba32, .samples = gpu::kManySamples})
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
    const auto draw_all = [&](const auto& drawing, const OccluderRange& range,
                              const Passage& passage) {
        for (std::uint32_t eye = first; eye < last; ++eye)
            for (std::uint32_t face = 0; face < kHemicubeFaces; ++face) {
                commands.viewport(
                    hemicube_face_area(tiles_of(layout_).area(eye), layout_.side, face));
                drawing.draw({.eye = eye,
                              .face = face,
                              .near = layout_.near,
                              .width = light.width,
                              .height = light.height,
                              .passage = passage},
                             world_->drawn_with_hull(range));
            }
    };
    if (world_->drawn_with_hull(world_->opaque()).count > 0)
        draw_all(
            commands.use(rasters_.opaque,
                         {.eyes = eyes, .lumel_of = *light.lumel_of, .radiosity = *light.radiosity},
                         {.position = world_->vertices(),
                          .place = world_->places(),
                          .chart = world_->charts()},
                         world_->indices()),
            world_->opaque(), {});
    for (const CutOutDraw& cut_out : world_->cut_outs())
        if (world_->drawn_with_hull(cut_out.range).count > 0)
            draw_all(commands.use(rasters_.cut_out,
                                  {.eyes = eyes,
                                   .lumel_of = *light.lumel_of,
                                   .radiosity = *light.radiosity,
                                   .base_color = {*cut_out.color, *cut_out.sampler}},
                                  {.position = world_->vertices(),
                                   .place = world_->places(),
                                   .chart = world_->charts(),
                                   .look = world_->looks()},
                                  world_->indices()),
                     cut_out.range, cut_out.passage);
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
