// What illumination maps show of planes that lie behind one another.

#include <algorithm>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "raster/parallel/illumination_maps.h"
#include "raster/parallel/overdraw.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSide = 128;  ///< of maps [pixels]

/// Planes of 1 m above one another, of a lumel each.
struct Stack {
    Stack(int planes, float alpha)
    {
        std::vector<support::Quad> quads;
        for (int k = 0; k < planes; ++k)
            quads.push_back({.corner = {0.0f, 0.1f * float(k), 0.0f},
                             .edge_u = {0.0f, 0.0f, 1.0f},
                             .edge_v = {1.0f, 0.0f, 0.0f},
                             .double_sided = true});
        made = support::make_quads(quads);
        for (Material& material : made.scene.materials)
            if (alpha < 1.0f) {
                material.alpha_mode = AlphaMode::blend;
                material.base_color.a = alpha;
            }
        atlas = support::lay_out(made, quads);
    }

    support::HandMade made;
    Atlas atlas;
};

/// Illumination maps of a stack, seen from straight above.
struct FromAbove {
    FromAbove(int planes, std::uint32_t slabs, float alpha = 1.0f)
        : stack(planes, alpha),
          world(device, stack.made.scene, stack.made.lumels, &stack.atlas),
          maps(device, world, Layers::stochastic, kSide, 1, std::uint32_t(stack.made.lumels.width),
               std::uint32_t(stack.made.lumels.height), slabs)
    {
        const std::array view{fit_view(world.low(), world.high(), kSide, {.random = 1})};
        const gpu::Array<ParallelView> views(device, std::span<const ParallelView>(view));
        gpu::Pacer pacer(device);
        maps.look_along(pacer, views, 0, 1);
        pacer.finish();
    }

    /// Which planes the pixels of a tile show that lie well inside the stack.
    std::vector<int> planes_shown(std::uint32_t tile) const
    {
        std::vector<glm::uvec4> pixels(std::size_t(maps.image().width()) * maps.image().height());
        maps.image().download(pixels.data());
        const gpu::Area area = tiles_of(maps.layout()).area(tile);
        std::vector<int> planes;
        for (std::uint32_t y = kSide / 4; y < kSide - kSide / 4; ++y)
            for (std::uint32_t x = kSide / 4; x < kSide - kSide / 4; ++x) {
                const std::uint32_t surface =
                    pixels[std::size_t(area.y + y) * maps.image().width() + area.x + x].x;
                planes.push_back(surface == 0 ? -1 : int((surface - 1) / 2));  // a texel each
            }
        return planes;
    }

    gpu::Device device;
    Stack stack;
    World world;
    IlluminationMaps maps;
};

TEST(IlluminationMaps, TellHowManyPlanesLieBehindOneAnother)
{
    for (const int planes : {1, 2, 5, 12}) {
        const FromAbove seen(planes, 1);
        // Of 14,000 pixels the estimate's spread is 0.9 %.
        EXPECT_NEAR(seen.maps.overdraw(1), planes, 0.03 * planes);
        EXPECT_EQ(seen.device.validation_messages(), "");
    }
}

TEST(IlluminationMaps, OfSlabsWithAPlaneEachShowItAndTheNextBeyond)
{
    constexpr int kPlanes = 4;
    const FromAbove seen(kPlanes, kPlanes);
    for (std::uint32_t slab = 0; slab < kPlanes; ++slab)
        for (const int plane : seen.planes_shown(slab))
            ASSERT_EQ(plane, int(slab));
    for (std::uint32_t slab = 0; slab + 1 < kPlanes; ++slab)
        for (const int plane : seen.planes_shown(kPlanes + slab))
            ASSERT_EQ(plane, int(slab) + 1);
    EXPECT_EQ(seen.device.validation_messages(), "");
}

TEST(IlluminationMaps, OfSlabsOfHalfTransparentPlanesShowHalfOfWhatIsLeftOfEach)
{
    constexpr int kPlanes = 4;
    const FromAbove seen(kPlanes, kPlanes, 0.5f);
    const std::vector<int> first = seen.planes_shown(0), beyond = seen.planes_shown(kPlanes);
    const auto share = [](const std::vector<int>& shown, int plane) {
        return double(std::count(shown.begin(), shown.end(), plane)) / double(shown.size());
    };
    EXPECT_NEAR(share(first, 0), 0.5, 0.03);  // of 4096 pixels the spread is below 0.008
    EXPECT_NEAR(share(first, -1), 0.5, 0.03);
    EXPECT_NEAR(share(beyond, 1), 0.5, 0.03);
    EXPECT_NEAR(share(beyond, 2), 0.25, 0.03);
    EXPECT_NEAR(share(beyond, 3), 0.125, 0.03);
    EXPECT_EQ(seen.device.validation_messages(), "");
}

TEST(IlluminationMaps, OfSlabsShareOutWhatCompetes)
{
    constexpr int kPlanes = 12, kSlabs = 3;
    const FromAbove seen(kPlanes, kSlabs);
    EXPECT_NEAR(seen.maps.overdraw(1), double(kPlanes) / kSlabs, 0.03 * kPlanes / kSlabs);
    EXPECT_EQ(seen.device.validation_messages(), "");
}

TEST(Overdraw, OfNothingIsZero)
{
    const std::vector<float> empty(64, 0.0f);
    Overdraw overdraw;
    overdraw.add(empty, 8, {0, 0, 8, 8});
    EXPECT_EQ(overdraw.mean(), 0.0);
}

}  // namespace
}  // namespace lumel
