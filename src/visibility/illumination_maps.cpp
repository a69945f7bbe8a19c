#include "visibility/illumination_maps.h"

#include <algorithm>
#include <vector>

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
/// And at least so many (48 MiB): few maps do not even out what single views need.
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

}  // namespace

IlluminationMaps::IlluminationMaps(const gpu::Device& device, const World& world, Layers layers,
                                   std::uint32_t side, std::uint32_t capacity, std::uint32_t width,
                                   std::uint32_t height)
    : world_(&world),
      layers_(layers),
      layout_(tile_layout(device, side, listable(device, layers, side, capacity))),
      capacity_(tiles_of(layout_).fitting(listable(device, layers, side, capacity),
                                          device.max_image_side())),
      width_(width),
      height_(height),
      image_(device, gpu::Pixel::rg32u, lists() ? 1 : tiles_of(layout_).image_width(),
             lists() ? 1 : tiles_of(layout_).image_height(capacity_)),
      odd_image_(device, gpu::Pixel::rg32u, peels() ? image_.width() : 1,
                 peels() ? image_.height() : 1),
      depth_(device, gpu::Pixel::depth, tiles_of(layout_).image_width(),
             tiles_of(layout_).image_height(capacity_)),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      heads_(device, lists() ? std::size_t(side) * side * capacity_ : 0),
      fragments_(device, room_for(device, layers, layout_, capacity_).capacity),
      none_(device, std::array{0u}),
      count_(device, std::array{room_for(device, layers, layout_, capacity_)}),
      opaque_(make_raster(device, layers, false)),
      cut_out_(make_raster(device, layers, true))
{
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
    pacer.work("look along", count, 1,
               [&](gpu::Commands& commands, std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t tile = begin; tile < end; ++tile)
                       draw(commands, views,
                            {.layout_ = layout_,
                             .view = first + tile,
                             .tile = tile,
                             .width = width_,
                             .height = height_,
                             .layer = layer});
               });
}

double IlluminationMaps::kept() const
{
    const FragmentCount count = count_.download()[0];
    return count.most <= count.capacity ? 1.0 : double(count.capacity) / double(count.most);
}

}  // namespace lumel
