// One room, lit by every engine and way in, against one reference: a row each, with its own bound.

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "base/images/image_files.h"
#include "gpu/device.h"
#include "jobs/bake/bake.h"
#include "jobs/edit/finished_bake.h"
#include "jobs/relight/relight.h"
#include "jobs/update/update.h"
#include "links/live/live_links.h"
#include "methods/methods.h"
#include "methods/redistribution/live_scene.h"
#include "room.h"

namespace lumel::test {
namespace {

constexpr std::uint32_t kLiveRays = 64;
/// Of rows by links, where the level of all light differs by 0.2 % from seed to seed.
constexpr std::uint32_t kSeeds = 4;

struct Row {
    const char* name;
    const char* what;  ///< the engine, and the way in
    Room room;         ///< that the light is of
    Deviation bound;
    std::function<Found(const RoomFiles&, std::uint32_t seed)> light;
    enum class Needs { nothing, ray_queries, movable_block } needs = Needs::nothing;
    std::uint32_t seeds = 1;  ///< over which the bias is averaged
};

Found light_of(const FinishedBake& bake)
{
    return {bake.prepared.lumels, bake.irradiance};
}

BakeOptions bake_options(const MethodOptions& method)
{
    BakeOptions options;
    options.atlas.size = kSide;
    options.preview_width = 0;
    options.solver.method = method;
    return options;
}

BakeOptions kept_links()
{
    BakeOptions options = bake_options(LinksOptions{});
    options.keep_links = true;
    return options;
}

BakeOptions with_seed(BakeOptions options, std::uint32_t seed)
{
    std::visit([&](auto& method) { method.seed = seed; }, options.solver.method);
    return options;
}

/// lumel bake
auto baked(const BakeOptions& options)
{
    return [options](const RoomFiles& files, std::uint32_t seed) {
        const TemporaryFolder folder;
        bake(files.path(Room::given), folder / "out", with_seed(options, seed));
        return light_of(FinishedBake(folder / "out"));
    };
}

auto baked(Rays rays)
{
    return baked(bake_options(LinksOptions{.rays = rays}));
}

auto baked(const char* method)
{
    return baked(bake_options(method_of(method).defaults()));
}

/// lumel update, of a bake of the room as it was given
auto updated(const BakeOptions& options)
{
    return [options](const RoomFiles& files, std::uint32_t seed) {
        const TemporaryFolder folder;
        bake(files.path(Room::given), folder / "out", with_seed(options, seed));
        update(folder / "out", files.path(Room::moved), {.preview_width = 0});
        return light_of(FinishedBake(folder / "out"));
    };
}

/// lumel relight: the map of a state, by the lumels of the bake
auto relit(const BakeOptions& options)
{
    return [options](const RoomFiles& files, std::uint32_t seed) {
        const TemporaryFolder folder;
        const std::string out = folder / "out", states = folder / "states.json";
        bake(files.path(Room::given), out, with_seed(options, seed));
        std::ofstream(states) << fmt::format(
            R"({{"states": [{{"name": "dimmed", "lights": {{"{}": {}}}}}]}})", kLight, kDimmed);
        relight(out, states, {});
        const Image map = read_exr(out + "/states/dimmed.exr");
        Found found{FinishedBake(out).prepared.lumels, {}};
        for (const Lumel& lumel : found.lumels.lumels) {
            const int side = found.lumels.width, texel = int(lumel.texel);
            const float* rgb = map.at(texel % side, texel / side);
            found.irradiance.emplace_back(rgb[0], rgb[1], rgb[2]);
        }
        return found;
    };
}

/// LiveLinks, as lumel view shows them
auto live_links(const std::function<void(LiveLinks&)>& edit)
{
    return [edit](const RoomFiles& files, std::uint32_t) {
        LiveLinks live(lay_out(read_gltf(files.path(Room::given)), {.size = kSide}, {kBlock}),
                       {.rays = kLiveRays, .things = {kBlock}});
        live.settle();
        edit(live);
        live.settle();
        return Found{live.lumels(), live.shown()};
    };
}

void move_block(LiveLinks& live, float part)
{
    live.move(kBlock, glm::translate(glm::mat4(1.0f), part * kMove));
    live.settle();
}

/// LiveScene, as lumel play --solver progressive has it
auto live_scene(Redistribution redistribution, const std::function<void(LiveScene&)>& edit)
{
    return [redistribution, edit](const RoomFiles& files, std::uint32_t) {
        const gpu::Device device;
        const Scene scene = read_gltf(files.path(Room::given));
        LiveOptions options;
        options.atlas.size = kSide;
        options.redistribution = redistribution;
        options.solver.views.hemicube = 64;  // as in [Hoef13]
        options.movers = {find_instance(scene, kBlock)};
        LiveScene live(device, scene, options);
        live.settle();
        edit(live);
        live.settle();
        Found found{live.lumels(), live.irradiance()};
        EXPECT_EQ(device.validation_messages(), "");
        return found;
    };
}

void move_block(LiveScene& live, float part)
{
    const std::uint32_t block = find_instance(live.scene(), kBlock);
    live.move(block, glm::translate(glm::mat4(1.0f), part * kMove));
    live.settle();
}

template <class Live>
void nothing(Live&)
{
}

template <class Live>
void move(Live& live)
{
    move_block(live, 1.0f);
}

template <class Live>
void there_and_back(Live& live)
{
    move_block(live, 1.0f);
    move_block(live, 0.0f);
}

/// Hemicubes as coarse as this scene allows: by the defaults gathering takes many minutes.
BakeOptions gathering()
{
    return bake_options(GatherOptions{.batch = 64, .hemicube = 32});
}

/// Bounds are about 1.25 times the largest deviation that three seeds had; bakes stop at an
/// estimated error of 2 %.
std::vector<Row> rows()
{
    const Deviation links{0.024, 0.003}, kept{0.027, 0.004}, live{0.035, 0.006},
        live_progressive{0.026, 0.008};
    constexpr auto movable = Row::Needs::movable_block;
    return {
        {"bake_by_links", "bake: links, rays by the host", Room::given, links, baked(Rays::host),
         Row::Needs::nothing, kSeeds},
        {"bake_by_queries", "bake: links, rays by queries of the device", Room::given, links,
         baked(Rays::query), Row::Needs::ray_queries, kSeeds},
        {"bake_by_tree", "bake: links, rays by a tree on the device", Room::given, links,
         baked(Rays::tree), Row::Needs::nothing, kSeeds},
        {"bake_by_drawings", "bake: links, rays drawn", Room::given, links, baked(Rays::raster),
         Row::Needs::nothing, kSeeds},
        {"bake_by_kept_links", "bake: links kept", Room::given, kept, baked(kept_links()),
         Row::Needs::nothing, kSeeds},
        {"bake_by_stochastic",
         "bake: stochastic shooting",
         Room::given,
         {0.028, 0.012},
         baked("stochastic")},
        {"bake_by_glossy", "bake: glossy radiosity", Room::given, {0.035, 0.015}, baked("glossy")},
        {"bake_by_directions",
         "bake: global directions",
         Room::given,
         {0.024, 0.004},
         baked("directions")},
        {"bake_by_progressive",
         "bake: progressive refinement",
         Room::given,
         {0.019, 0.004},
         baked("progressive")},
        {"bake_by_gather", "bake: gathering", Room::given, {0.02, 0.003}, baked(gathering())},
        {"bake_by_matrix", "bake: transport matrix", Room::given, {0.018, 0.003}, baked("matrix")},
        {"live_links", "live links", Room::given, live, live_links(nothing<LiveLinks>), movable},
        {"live_links_there_and_back", "live links, a block moved there and back", Room::given, live,
         live_links(there_and_back<LiveLinks>), movable},
        {"live_links_moved", "live links, a block moved", Room::moved, live,
         live_links(move<LiveLinks>), movable},
        {"live_links_dimmed", "live links, a light dimmed", Room::dimmed, live,
         live_links([](LiveLinks& scene) { scene.set_lamp(kLight, glm::vec3(kDimmed)); }), movable},
        {"live_scene", "live progressive refinement", Room::given, live_progressive,
         live_scene(Redistribution::incremental, nothing<LiveScene>), movable},
        {"live_scene_there_and_back", "live progressive, a block moved there and back", Room::given,
         live_progressive, live_scene(Redistribution::incremental, there_and_back<LiveScene>),
         movable},
        {"live_scene_moved", "live progressive, a block moved", Room::moved, live_progressive,
         live_scene(Redistribution::incremental, move<LiveScene>), movable},
        {"live_scene_moved_across",
         "live progressive, by cross redistribution",
         Room::moved,
         {0.032, 0.006},
         live_scene(Redistribution::cross, move<LiveScene>),
         movable},
        {"live_scene_dimmed", "live progressive, a light dimmed", Room::dimmed, live_progressive,
         live_scene(Redistribution::incremental,
                    [](LiveScene& scene) {
                        scene.set_emission(find_instance(scene.scene(), kLight),
                                           glm::vec3(kDimmed));
                    }),
         movable},
        {"update", "update of a bake by links, a block moved", Room::moved, kept,
         updated(bake_options(LinksOptions{})), Row::Needs::nothing, kSeeds},
        {"update_over_kept_links",
         "update over kept links, a block moved",
         Room::moved,
         {0.032, 0.004},
         updated(kept_links()),
         Row::Needs::nothing,
         kSeeds},
        {"relight_over_kept_links",
         "relight over kept links, a light dimmed",
         Room::dimmed,
         {0.029, 0.004},
         relit(kept_links()),
         Row::Needs::nothing,
         kSeeds},
        {"relight_by_matrix",
         "relight by the matrix, a light dimmed",
         Room::dimmed,
         {0.02, 0.003},
         relit(bake_options(method_of("matrix").defaults()))},
    };
}

void PrintTo(const Row& row, std::ostream* out)
{
    *out << row.what;
}

const RoomFiles& files()
{
    static const RoomFiles made;
    return made;
}

/// Made once. movable: for lumels that the block, which may move, does not cut.
const Reference& reference(Room room, bool movable)
{
    static std::map<std::pair<Room, bool>, Reference> made;
    const std::vector<std::string> names(movable ? 1 : 0, kBlock);
    return made.try_emplace({room, movable}, files().path(room), names).first->second;
}

class Agreement : public testing::TestWithParam<Row> {
protected:
    void SetUp() override
    {
        if (GetParam().needs == Row::Needs::ray_queries && !gpu::Device().can_query_rays())
            GTEST_SKIP() << gpu::Device().info().name
                         << " has no ray queries; tools/newer_mesa runs a program on one that has";
    }
    static void TearDownTestSuite()
    {
        std::cout << fmt::format("{:48} {:>7} {:>7} {:>7} {:>7} {:>6}\n", "", "RMSE %", "bound",
                                 "bias %", "bound", "s")
                  << table();
    }

    static std::string& table()
    {
        static std::string lines;
        return lines;
    }
};

INSTANTIATE_TEST_SUITE_P(Table, Agreement, testing::ValuesIn(rows()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Agreement, WithThePathTracer)
{
    const Row& row = GetParam();
    const auto start = std::chrono::steady_clock::now();
    const Reference& truth = reference(row.room, row.needs == Row::Needs::movable_block);
    Deviation error = truth.of(row.light(files(), 1));
    for (std::uint32_t seed = 2; seed <= row.seeds; ++seed)
        error.bias += truth.of(row.light(files(), seed)).bias;
    error.bias /= double(row.seeds);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    table() +=
        fmt::format("{:48} {:7.2f} {:7.2f} {:7.2f} {:7.2f} {:6.1f}\n", row.what, 100.0 * error.rmse,
                    100.0 * row.bound.rmse, 100.0 * error.bias, 100.0 * row.bound.bias, seconds);
    EXPECT_LE(error.rmse, row.bound.rmse);
    EXPECT_LE(std::abs(error.bias), row.bound.bias);
}

/// An engine that ignored the edit would fail: the given room is far from the edited ones.
TEST(AgreementRooms, DifferByMoreThanTwiceAnyBound)
{
    const Found given = baked(Rays::host)(files(), 1);
    for (const Room room : {Room::moved, Room::dimmed})
        EXPECT_GT(reference(room, false).of(given).rmse, 2.0 * 0.035);
}

}  // namespace
}  // namespace lumel::test
