#include "visibility/illumination_maps.h"

#include <algorithm>

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

constexpr gpu::VertexStream kStreams[] = {{3}, {2}, {3}};
constexpr gpu::Slot kSlots[] = {gpu::Slot::array, gpu::Slot::array, gpu::Slot::array,
                                gpu::Slot::array};
constexpr gpu::Slot kCutOutSlots[] = {gpu::Slot::array, gpu::Slot::texture, gpu::Slot::array,
                                      gpu::Slot::array, gpu::Slot::array};

/// Surfaces that lists have room for, per pixel of the maps: what is drawn covers some half of a
/// map, several times.
constexpr std::uint64_t kFragmentsPerPixel = 4;

gpu::Raster make_raster(const gpu::Device& device, Layers layers, bool cut_out)
{
    const bool lists = layers == Layers::list;
    const std::size_t streams = cut_out ? 3 : 2;
    const gpu::Spirv fragment =
        lists ? (cut_out ? gpu::Spirv(kListCutOutSpirv) : gpu::Spirv(kListSpirv))
              : (cut_out ? gpu::Spirv(kStochasticCutOutSpirv) : gpu::Spirv(kStochasticSpirv));
    const std::span<const gpu::Slot> slots =
        cut_out ? std::span<const gpu::Slot>(kCutOutSlots) : std::span<const gpu::Slot>(kSlots);
    return {device,
            cut_out ? "illumination.cut_out" : "illumination",
            {.vertex = cut_out ? gpu::Spirv(kCutOutVertexSpirv) : gpu::Spirv(kVertexSpirv),
             .fragment = fragment,
             .slots = lists ? slots : slots.first(cut_out ? 2 : 1),
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
                    "cannot keep lists of fragments; use --layers stochastic");
    const std::uint64_t bytes = std::uint64_t(side) * side * kFragmentsPerPixel * sizeof(Fragment);
    return std::uint32_t(std::clamp<std::uint64_t>(device.max_array_bytes() / bytes, 1, capacity));
}

FragmentCount room_for(Layers layers, const ParallelLayout& layout, std::uint32_t capacity)
{
    const std::uint64_t pixels = std::uint64_t(layout.side) * layout.side * capacity;
    return {0, layers == Layers::list ? std::uint32_t(pixels * kFragmentsPerPixel) : 0};
}

}  // namespace

IlluminationMaps::IlluminationMaps(const gpu::Device& device, const World& world, Layers layers,
                                   std::uint32_t side, std::uint32_t capacity, std::uint32_t width,
                                   std::uint32_t height)
    : world_(&world),
      layers_(layers),
      layout_(tile_layout(device, side, listable(device, layers, side, capacity))),
      capacity_(tiles_that_fit(device, layout_, listable(device, layers, side, capacity))),
      width_(width),
      height_(height),
      image_(device, gpu::Pixel::rg32u, lists() ? 1 : layout_.columns * side,
             lists() ? 1 : tile_rows(layout_, capacity_) * side),
      depth_(device, gpu::Pixel::depth, layout_.columns * side,
             tile_rows(layout_, capacity_) * side),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      heads_(device, lists() ? std::size_t(side) * side * capacity_ : 0),
      fragments_(device, room_for(layers, layout_, capacity_).capacity),
      none_(device, std::array{room_for(layers, layout_, capacity_)}),
      count_(device, 1),
      opaque_(make_raster(device, layers, false)),
      cut_out_(make_raster(device, layers, true))
{
}

void IlluminationMaps::draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views,
                            std::uint32_t view, std::uint32_t tile)
{
    const gpu::Buffer& vertices = world_->vertices().buffer();
    const gpu::Buffer& places = world_->places().buffer();
    const gpu::Buffer& indices = world_->indices().buffer();
    const auto draw_range = [&](const OccluderRange& range, const Passage& passage) {
        commands.draw(IlluminationParams{layout_, view, tile, width_, height_, passage},
                      {range.first_index, range.index_count});
    };
    commands.begin_pass(lists() ? nullptr : &image_, depth_, tile_area(layout_, tile));
    if (world_->opaque().index_count > 0) {
        if (lists())
            commands.use(opaque_, {views, heads_, fragments_, count_},
                         {{&vertices, &places}, &indices});
        else
            commands.use(opaque_, {views}, {{&vertices, &places}, &indices});
        draw_range(world_->opaque(), {});
    }
    for (const CutOutDraw& cut_out : world_->cut_outs()) {
        const gpu::Binding color{*cut_out.color, *cut_out.sampler};
        const gpu::Mesh mesh{{&vertices, &places, &world_->looks().buffer()}, &indices};
        if (lists())
            commands.use(cut_out_, {views, color, heads_, fragments_, count_}, mesh);
        else
            commands.use(cut_out_, {views, color}, mesh);
        draw_range(cut_out.range, cut_out.passage);
    }
    commands.end_pass();
}

void IlluminationMaps::look_along(gpu::Pacer& pacer, const gpu::Array<ParallelView>& views,
                                  std::uint32_t first, std::uint32_t count)
{
    if (lists())
        pacer.work("clear lists", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
            commands.fill(heads_.buffer(), kEndOfList);
            commands.copy(none_.buffer(), count_.buffer(), sizeof(FragmentCount));
        });
    pacer.work("look along", count, 1,
               [&](gpu::Commands& commands, std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t tile = begin; tile < end; ++tile)
                       draw(commands, views, first + tile, tile);
               });
}

double IlluminationMaps::kept() const
{
    const FragmentCount count = count_.download()[0];
    return count.count <= count.capacity ? 1.0 : double(count.capacity) / double(count.count);
}

}  // namespace lumel
