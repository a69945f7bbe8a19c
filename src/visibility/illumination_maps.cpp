#include "visibility/illumination_maps.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

#include "visibility/overdraw.h"

namespace lumel {
namespace {

constexpr std::uint32_t kVertexSpirv[] = {
#include "visibility/illumination.vert.inc"
};
constexpr std::uint32_t kCutOutVertexSpirv[] = {
#include "visibility/illumination.cut_out.vert.inc"
};
constexpr std::uint32_t kStochasticSpirv[] = {
#include "visibility/illumination.stochastic.frag.inc"
};
constexpr std::uint32_t kStochasticCutOutSpirv[] = {
#include "visibility/illumination.stochastic.cut_out.frag.inc"
};
constexpr std::uint32_t kListSpirv[] = {
#include "visibility/illumination.list.frag.inc"
};
constexpr std::uint32_t kListCutOutSpirv[] = {
#include "visibility/illumination.list.cut_out.frag.inc"
};

constexpr std::uint32_t kPeelSpirv[] = {
#include "visibility/illumination.peel.frag.inc"
};
constexpr std::uint32_t kPeelCutOutSpirv[] = {
#include "visibility/illumination.peel.cut_out.frag.inc"
};

constexpr gpu::VertexStream kStreams[] = {{3}, {2}, {3}};

/// What the layers are drawn with: each slot list is of opaque surfaces; cut-outs have a texture
/// after the first.
struct Drawing {
    gpu::Spirv opaque, cut_out;
    std::vector<gpu::Slot> slots;
};

Drawing drawing_of(Layers layers)
{
    using enum gpu::Slot;
    switch (layers) {
    case Layers::list:
        return {kListSpirv, kListCutOutSpirv, {array, array, array, array}};
    case Layers::peel:
        return {kPeelSpirv, kPeelCutOutSpirv, {array, texture}};
    case Layers::stochastic:
        break;
    }
    return {kStochasticSpirv, kStochasticCutOutSpirv, {array}};
}

/// Surfaces that lists have room for, per pixel of the maps: what is drawn covers some half of a
/// map, several times.
constexpr std::uint64_t kFragmentsPerPixel = 4;
/// And at least this number (48 MiB): few maps do not even out the needs of single views.
constexpr std::uint64_t kLeastFragments = 4u << 20;

gpu::Raster make_raster(const gpu::Device& device, Layers layers, bool cut_out)
{
    const bool lists = layers == Layers::list;
    const std::size_t streams = cut_out ? 3 : 2;
    Drawing drawing = drawing_of(layers);
    if (cut_out)
        drawing.slots.insert(drawing.slots.begin() + 1, gpu::Slot::texture);
    return {device,
            cut_out ? "illumination.cut_out" : "illumination",
            {.vertex = cut_out ? gpu::Spirv(kCutOutVertexSpirv) : gpu::Spirv(kVertexSpirv),
             .fragment = cut_out ? drawing.cut_out : drawing.opaque,
             .slots = drawing.slots,
             .param_bytes = sizeof(IlluminationParams),
             .streams = std::span(kStreams, streams),
             .color = !lists,
             .color_pixel = gpu::Pixel::rg32u,
             .depth_test = !lists}};
}

/// Fewer tiles if lists of that many would not fit an array.
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
                std::min(std::max(pixels * kFragmentsPerPixel, kLeastFragments),
                         device.max_array_bytes() / std::uint64_t(sizeof(Fragment))))};
}

ParallelLayout layout_for(const gpu::Device& device, Layers layers, std::uint32_t side,
                          std::uint32_t capacity, std::uint32_t slabs)
{
    return tile_layout(device, side,
                       listable(device, layers, side, capacity) * maps_of_slabs(slabs));
}

/// Directions whose maps fit the device's images.
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

/// How a tile shows its part of what lies along the direction; see IlluminationMaps. `map`: which
/// of the direction's tiles it is.
IlluminationParams part_shown(std::uint32_t map, std::uint32_t slabs)
{
    const auto all = float(slabs);
    if (map < slabs)
        return {.depth_scale = all, .depth_shift = -float(map)};
    // From the end of the slab on: the less near, the sooner it is met, and the larger its depth.
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
      image_(device, gpu::Pixel::rg32u, lists() ? 1 : tiles_of(layout_).image_width(),
             lists() ? 1 : tiles_of(layout_).image_height(capacity_ * maps_of_slabs(slabs))),
      odd_image_(device, gpu::Pixel::rg32u, peels() ? image_.width() : 1,
                 peels() ? image_.height() : 1),
      depth_(device, gpu::Pixel::depth, tiles_of(layout_).image_width(),
             tiles_of(layout_).image_height(capacity_ * maps_of_slabs(slabs))),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      heads_(device, lists() ? std::size_t(side) * side * capacity_ : 0),
      fragments_(device, room_for(device, layers, layout_, capacity_).capacity),
      none_(device, std::array{0u}),
      count_(device, std::array{room_for(device, layers, layout_, capacity_)}),
      opaque_(make_raster(device, layers, false)),
      cut_out_(make_raster(device, layers, true))
{
    assert(slabs == 1 || layers == Layers::stochastic);
}

std::uint64_t IlluminationMaps::device_bytes(Layers layers, std::uint32_t side,
                                             std::uint32_t capacity, std::uint32_t slabs)
{
    const std::uint64_t map = std::uint64_t(side) * side;
    const std::uint64_t pixels = map * tiles_about_square(capacity * maps_of_slabs(slabs));
    const std::uint64_t depths = pixels * gpu::image_bytes(gpu::Pixel::depth, 1, 1);
    const std::uint64_t images = pixels * gpu::image_bytes(gpu::Pixel::rg32u, 1, 1);
    if (layers == Layers::peel)
        return depths + 2 * images;
    if (layers == Layers::stochastic)
        return depths + images;
    return depths + map * capacity * sizeof(std::uint32_t) +
           std::max(map * capacity * kFragmentsPerPixel, kLeastFragments) * sizeof(Fragment);
}

void IlluminationMaps::draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views,
                            const IlluminationParams& params)
{
    const gpu::Buffer& vertices = world_->vertices().buffer();
    const gpu::Buffer& places = world_->places().buffer();
    const gpu::Buffer& indices = world_->indices().buffer();
    const auto draw_range = [&](const OccluderRange& range, const Passage& passage) {
        IlluminationParams of_range = params;
        of_range.passage = passage;
        commands.draw(of_range, {range.first_index, range.index_count});
    };
    const gpu::Binding before{image(params.layer + 1), sampler_};
    commands.begin_pass(lists() ? nullptr : &image(params.layer), depth_,
                        tiles_of(layout_).area(params.tile));
    if (world_->opaque().index_count > 0) {
        if (lists())
            commands.use(opaque_, {views, heads_, fragments_, count_},
                         {{&vertices, &places}, &indices});
        else if (peels())
            commands.use(opaque_, {views, before}, {{&vertices, &places}, &indices});
        else
            commands.use(opaque_, {views}, {{&vertices, &places}, &indices});
        draw_range(world_->opaque(), {});
    }
    for (const CutOutDraw& cut_out : world_->cut_outs()) {
        const gpu::Binding color{*cut_out.color, *cut_out.sampler};
        const gpu::Mesh mesh{{&vertices, &places, &world_->looks().buffer()}, &indices};
        if (lists())
            commands.use(cut_out_, {views, color, heads_, fragments_, count_}, mesh);
        else if (peels())
            commands.use(cut_out_, {views, color, before}, mesh);
        else
            commands.use(cut_out_, {views, color}, mesh);
        draw_range(cut_out.range, cut_out.passage);
    }
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
                       params.layout_ = layout_;
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
