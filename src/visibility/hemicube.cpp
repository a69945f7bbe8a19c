#include "visibility/hemicube.h"

#include <algorithm>

namespace lumel {
namespace {

constexpr std::uint32_t kVertexSpirv[] = {
#include "visibility/hemicube.vert.inc"
};
constexpr std::uint32_t kCutOutVertexSpirv[] = {
#include "visibility/hemicube.cut_out.vert.inc"
};
constexpr std::uint32_t kCutOutFragmentSpirv[] = {
#include "visibility/hemicube.cut_out.frag.inc"
};

/// Near plane as a part of the scene's diagonal: closer surfaces are lumels' own neighbours,
/// whose exchange the near field holds.
constexpr float kNearPlane = 1e-5f;

constexpr gpu::VertexStream kStreams[] = {{3}, {3}};
constexpr gpu::Slot kOpaqueSlots[] = {gpu::Slot::array};
constexpr gpu::Slot kCutOutSlots[] = {gpu::Slot::array, gpu::Slot::texture};

HemicubeLayout make_layout(const gpu::Device& device, const World& world, std::uint32_t side,
                           std::uint32_t capacity)
{
    const std::uint32_t fit = side > 0 ? device.max_image_side() / (2 * side) : 0;
    if (side < 2 || side % 2 != 0 || fit == 0)
        throw Error(ErrorKind::input, "--hemicube " + std::to_string(side),
                    "must be an even number of pixels that fits the device's images");
    // About square, so that the image stays small in both directions.
    std::uint32_t columns = 1;
    while (columns * columns < capacity)
        ++columns;
    return {side, std::min(columns, fit), std::max(world.diagonal() * kNearPlane, 1e-30f)};
}

std::uint32_t fitting(const gpu::Device& device, const HemicubeLayout& layout,
                      std::uint32_t capacity)
{
    const std::uint32_t rows = device.max_image_side() / (3 * layout.side / 2);
    return std::min(capacity, layout.columns * rows);
}

}  // namespace

Hemicubes::Hemicubes(const gpu::Device& device, const World& world, std::uint32_t side,
                     std::uint32_t capacity)
    : world_(&world),
      layout_(make_layout(device, world, side, capacity)),
      image_(device, gpu::Pixel::depth, layout_.columns * 2 * side,
             (fitting(device, layout_, capacity) + layout_.columns - 1) / layout_.columns *
                 (3 * side / 2)),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      opaque_(device, "hemicube",
              {.vertex = kVertexSpirv,
               .slots = kOpaqueSlots,
               .param_bytes = sizeof(HemicubeParams),
               .streams = std::span(kStreams, 1)}),
      cut_out_(device, "hemicube.cut_out",
               {.vertex = kCutOutVertexSpirv,
                .fragment = kCutOutFragmentSpirv,
                .slots = kCutOutSlots,
                .param_bytes = sizeof(HemicubeParams),
                .streams = kStreams})
{
    capacity_ = fitting(device, layout_, capacity);
}

gpu::Area Hemicubes::tile_area(std::uint32_t eye) const
{
    const std::uint32_t side = layout_.side;
    return {eye % layout_.columns * 2 * side, eye / layout_.columns * (3 * side / 2), 2 * side,
            3 * side / 2};
}

gpu::Area Hemicubes::face_area(std::uint32_t eye, std::uint32_t face) const
{
    const gpu::Area tile = tile_area(eye);
    const std::uint32_t side = layout_.side, half = side / 2;
    switch (face) {
    case 0:
        return {tile.x, tile.y, side, side};
    case 1:
        return {tile.x + side, tile.y, side, half};
    case 2:
        return {tile.x + side, tile.y + half, side, half};
    case 3:
        return {tile.x, tile.y + side, side, half};
    default:
        return {tile.x + side, tile.y + side, side, half};
    }
}

void Hemicubes::draw_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes,
                           std::uint32_t first, std::uint32_t last)
{
    const gpu::Buffer& vertices = world_->vertices().buffer();
    const gpu::Buffer& indices = world_->indices().buffer();
    const auto draw_all = [&](float cutoff, const gpu::Range& range) {
        for (std::uint32_t i = first; i < last; ++i) {
            const std::uint32_t eye = i / kHemicubeFaces, face = i % kHemicubeFaces;
            commands.viewport(face_area(eye, face));
            commands.draw(HemicubeParams{eye, face, layout_.near, cutoff}, range);
        }
    };
    if (world_->opaque_index_count() > 0) {
        commands.use(opaque_, {eyes}, {{&vertices}, &indices});
        draw_all(0.0f, {0, world_->opaque_index_count()});
    }
    for (const CutOutDraw& cut_out : world_->cut_outs()) {
        commands.use(cut_out_, {eyes, {*cut_out.alpha, *cut_out.sampler}},
                     {{&vertices, &world_->looks().buffer()}, &indices});
        draw_all(cut_out.cutoff, {cut_out.range.first_index, cut_out.range.index_count});
    }
}

void Hemicubes::look_from(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t count)
{
    const std::uint32_t rows = (count + layout_.columns - 1) / layout_.columns;
    commands.begin_pass(nullptr, image_, {0, 0, image_.width(), rows * (3 * layout_.side / 2)});
    draw_faces(commands, eyes, 0, count * kHemicubeFaces);
    commands.end_pass();
}

void Hemicubes::look_from(gpu::Pacer& pacer, const gpu::Array<Eye>& eyes, std::uint32_t count)
{
    const std::uint32_t faces = count * kHemicubeFaces;
    pacer.work("hemicubes", faces, kHemicubeFaces,
               [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                   if (first == 0 && last == faces)
                       look_from(commands, eyes, count);
                   else
                       look_from_faces(commands, eyes, first, last);
               });
}

void Hemicubes::look_from_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes,
                                std::uint32_t first, std::uint32_t last)
{
    for (std::uint32_t i = first; i < last; ++i) {
        commands.begin_pass(nullptr, image_, face_area(i / kHemicubeFaces, i % kHemicubeFaces));
        draw_faces(commands, eyes, i, i + 1);
        commands.end_pass();
    }
}

}  // namespace lumel
