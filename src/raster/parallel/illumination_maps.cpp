#include "raster/parallel/illumination_maps.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

#include "raster/parallel/overdraw.h"

namespace lumel {
namespace {

/// List capacity in surfaces per pixel of the maps: the scene covers about half of a map, several
/// times.
constexpr std::uint64_t kFragmentsPerPixel = 4;
/// Minimum capacity (48 MiB): a few maps do not average out the needs of single views.
constexpr std::uint64_t kMinFragments = 4u << 20;

/// Reduces the number of tiles if their lists would exceed the maximum size of arrays.
std::uint32_t listable(const gpu::Device& device, Layers layers, std::uint32_t side,
                       std::uint32_t capacity)
{
    if (layers != Layers::list)
        return capacity;
    if (!device.can_list_fragments())
        throw Error(ErrorKind::device, device.info().name,
                    "cannot keep lists of fragments; use --layers peel or stochastic");
    const std::uint64_t bytes = std::uint64_t(side) * side * kFragmentsPerPixel * sizeof(Fragment);
    return std::uint32_t(std::clamp<std::uint64_t>(device.max_array_bytes() / bytes, 1, capacity));
}

FragmentCount room_for(const gpu::Device& device, Layers layers, const ParallelLayout& layout,
                       std::uint32_t capacity)
{
    if (layers != Layers::list)
        return {};
    const std::uint64_t pixels = std::uint64_t(layout.side) * layout.side * capacity;
    return {.capacity = std::uint32_t(
                std::min(std::max(pixels * kFragmentsPerPixel, kMinFragments),
                         device.max_array_bytes() / std::uint64_t(sizeof(Fragment))))};
}

ParallelLayout layout_for(const gpu::Device& device, Layers layers, std::uint32_t side,
                          std::uint32_t capacity, std::uint32_t slabs)
{
    return tile_layout(device, side,
                       listable(device, layers, side, capacity) * maps_of_slabs(slabs));
}

/// Number of directions whose maps fit the device's images.
std::uint32_t fitting(const gpu::Device& device, Layers layers, const ParallelLayout& layout,
                      std::uint32_t capacity, std::uint32_t slabs)
{
    const std::uint32_t maps = maps_of_slabs(slabs);
    const std::uint32_t directions =
        tiles_of(layout).fitting(listable(device, layers, layout.side, capacity) * maps,
                                 device.max_image_side()) /
        maps;
    if (directions == 0)
        throw Error(ErrorKind::device, device.info().name,
                    "has no images large enough for " + std::to_string(maps) + " maps of " +
                        std::to_string(layout.side) + "²; use a smaller --slabs or --map-side");
    return directions;
}

/// Pixel format of maps. Stochastic samples also store slopes.
gpu::Pixel pixel_of(Layers layers)
{
    return layers == Layers::stochastic ? gpu::Pixel::rgba32u : gpu::Pixel::rg32u;
}

/// Depth range of a tile, see IlluminationMaps. `map`: index among the direction's tiles.
IlluminationParams part_shown(std::uint32_t map, std::uint32_t slabs)
{
    const auto all = float(slabs);
    if (map < slabs)
        return {.depth_scale = all, .depth_shift = -float(map)};
    // Depths from the end of the slab on; surfaces closer to the light have larger depths.
    const float scale = all / (all - float(map - slabs + 1));
    return {.depth_scale = -scale, .depth_shift = scale, .ordinary = 1};
}

}  // namespace

IlluminationMaps::IlluminationMaps(const gpu::Device& device, const World& world, Layers layers,
                                   std::uint32_t side, std::uint32_t capacity, std::uint32_t width,
                                   std::uint32_t height, std::uint32_t slabs)
    : world_(&world),
      layers_(layers),
      layout_(layout_for(device, layers, side, capacity, slabs)),
      slabs_(slabs),
      capacity_(fitting(device, layers, layout_, capacity, slabs)),
      width_(width),
      height_(height),
      image_(device, pixel_of(layers), lists() ? 1 : tiles_of(layout_).image_width(),
             lists() ? 1 : tiles_of(layout_).image_height(capacity_ * maps_of_slabs(slabs))),
      odd_image_(device, pixel_of(layers), peels() ? image_.width() : 1,
                 peels() ? image_.height() : 1),
      depth_(device, gpu::Pixel::depth, tiles_of(layout_).image_width(),
             tiles_of(layout_).image_height(capacity_ * maps_of_slabs(slabs))),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      heads_(device, lists() ? std::size_t(side) * side * capacity_ : 0),
      fragments_(device, room_for(device, layers, layout_, capacity_).capacity),
      none_(device, std::array{0u}),
      count_(device, std::array{room_for(device, layers, layout_, capacity_)}),
      rasters_(make_rasters(device, layers))
{
    assert(slabs == 1 || layers == Layers::stochastic);
}

std::uint64_t IlluminationMaps::device_bytes(Layers layers, std::uint32_t side,
                                             std::uint32_t capacity, std::uint32_t slabs)
{
    const std::uint64_t map = std::uint64_t(side) * side;
    const std::uint64_t pixels = map * tiles_about_square(capacity * maps_of_slabs(slabs));
    const std::uint64_t depths = pixels * gpu::image_bytes(gpu::Pixel::depth, 1, 1);
    const std::uint64_t images = pixels * gpu::image_bytes(pixel_of(layers), 1, 1);
    if (layers == Layers::peel)
        return depths + 2 * images;
    if (layers == Layers::stochastic)
        return depths + images;
    return depths + map * capacity * sizeof(std::uint32_t) +
           std::max(map * capacity * kFragmentsPerPixel, kMinFragments) * sizeof(Fragment);
}

IlluminationMaps::Rasters IlluminationMaps::make_rasters(const gpu::Device& device, Layers layers)
{
    const gpu::RasterOptions options{.color_pixel = pixel_of(layers)};
    switch (layers) {
    case Layers::list:
        return ListRasters(device, {.depth_test = false});
    case Layers::peel:
        return PeelRasters(device, options);
    case Layers::stochastic:
        break;
    }
    return StochasticRasters(device, options);
}

auto IlluminationMaps::use_opaque(const Pass& pass, const StochasticRasters& rasters) const
{
    return pass.commands.use(rasters.opaque, {.views = pass.views},
                             {.position = world_->vertices(), .place = world_->places()},
                             world_->indices());
}

auto IlluminationMaps::use_opaque(const Pass& pass, const ListRasters& rasters) const
{
    return pass.commands.use(
        rasters.opaque,
        {.views = pass.views, .heads = heads_, .fragments = fragments_, .total = count_},
        {.position = world_->vertices(), .place = world_->places()}, world_->indices());
}

auto IlluminationMaps::use_opaque(const Pass& pass, const PeelRasters& rasters) const
{
    return pass.commands.use(
        rasters.opaque, {.views = pass.views, .before = {image(pass.params.layer + 1), sampler_}},
        {.position = world_->vertices(), .place = world_->places()}, world_->indices());
}

auto IlluminationMaps::use_cut_out(const Pass& pass, const StochasticRasters& rasters,
                                   const CutOutDraw& cut_out) const
{
    return pass.commands.use(
        rasters.cut_out, {.views = pass.views, .base_color = {*cut_out.color, *cut_out.sampler}},
        {.position = world_->vertices(), .place = world_->places(), .look = world_->looks()},
        world_->indices());
}

auto IlluminationMaps::use_cut_out(const Pass& pass, const ListRasters& rasters,
                                   const CutOutDraw& cut_out) const
{
    return pass.commands.use(
        rasters.cut_out,
        {.views = pass.views,
         .heads = heads_,
         .fragments = fragments_,
         .total = count_,
         .base_color = {*cut_out.color, *cut_out.sampler}},
        {.position = world_->vertices(), .place = world_->places(), .look = world_->looks()},
        world_->indices());
}

auto IlluminationMaps::use_cut_out(const Pass& pass, const PeelRasters& rasters,
                                   const CutOutDraw& cut_out) const
{
    return pass.commands.use(
        rasters.cut_out,
        {.views = pass.views,
         .base_color = {*cut_out.color, *cut_out.sampler},
         .before = {image(pass.params.layer + 1), sampler_}},
        {.position = world_->vertices(), .place = world_->places(), .look = world_->looks()},
        world_->indices());
}

void IlluminationMaps::draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views,
                            const IlluminationParams& params)
{
    const Pass pass{commands, views, params};
    const auto draw_range = [&](const auto& drawing, const OccluderRange& range,
                                const Passage& passage) {
        IlluminationParams of_range = params;
        of_range.passage = passage;
        drawing.draw(of_range, {range.first_index, range.index_count});
    };
    const auto draw_surfaces = [&](const auto& rasters) {
        if (world_->opaque().index_count > 0)
            draw_range(use_opaque(pass, rasters), world_->opaque(), {});
        for (const CutOutDraw& cut_out : world_->cut_outs())
            draw_range(use_cut_out(pass, rasters, cut_out), cut_out.range, cut_out.passage);
    };
    commands.begin_pass(lists() ? nullptr : &image(params.layer), depth_,
                        tiles_of(layout_).area(params.tile));
    std::visit(draw_surfaces, rasters_);
    commands.end_pass();
}

void IlluminationMaps::look_along(gpu::Pacer& pacer, const gpu::Array<ParallelView>& views,
                                  std::uint32_t first, std::uint32_t count, std::uint32_t layer)
{
    if (lists())
        pacer.work("clear lists", [&](gpu::Commands& commands) {
            commands.fill(heads_.buffer(), kEndOfList);
            commands.copy(none_.buffer(), count_.buffer(), sizeof(FragmentCount::count));
        });
    const std::uint32_t maps = maps_of_slabs(slabs_);
    pacer.work("look along", count * maps, 1,
               [&](gpu::Commands& commands, std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t tile = begin; tile < end; ++tile) {
                       IlluminationParams params = part_shown(tile % maps, slabs_);
                       params.tiling = layout_;
                       params.view = first + tile / maps;
                       params.tile = tile;
                       params.width = width_;
                       params.height = height_;
                       params.layer = layer;
                       draw(commands, views, params);
                   }
               });
}

double IlluminationMaps::overdraw(std::uint32_t count) const
{
    assert(layers_ == Layers::stochastic);
    std::vector<float> depths(std::size_t(depth_.width()) * depth_.height());
    depth_.download(depths.data());
    const std::uint32_t maps = maps_of_slabs(slabs_);
    Overdraw overdraw;
    for (std::uint32_t tile = 0; tile < count * maps; ++tile)
        if (tile % maps < slabs_)
            overdraw.add(depths, depth_.width(), tiles_of(layout_).area(tile));
    return overdraw.mean();
}

double IlluminationMaps::kept() const
{
    const FragmentCount count = count_.download()[0];
    return count.most <= count.capacity ? 1.0 : double(count.capacity) / double(count.most);
}

}  // namespace lumel
