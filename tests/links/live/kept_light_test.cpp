// Light over links of a former run is that of links that were just traced.

#include <cstring>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "../../support/temporary_folder.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/error.h"
#include "base/core/fingerprint.h"
#include "links/kept/links_file.h"
#include "links/live/link_relighter.h"
#include "open_box.h"

namespace lumel {
namespace {

using Lights = std::vector<glm::vec3>;

constexpr int kSide = 64;  // of the atlas [texels]

Scene with_block_moved(Scene scene)
{
    glm::mat4& place = scene.instances[find_instance(scene, "short block")].transform;
    place = glm::translate(glm::mat4(1.0f), glm::vec3(0.04f, 0.0f, 0.05f)) * place;
    return scene;
}

/// A scene and its light, over links of a former run or its own.
struct Lit {
    explicit Lit(Scene scene, const StoredLinks* kept = nullptr)
        : prepared(std::move(scene), AtlasOptions{.size = kSide}),
          light(prepared, {.rays = 16, .seed = 1}, kept)
    {
    }
    /// In the atlas of another.
    Lit(Scene scene, const Lit& other, const StoredLinks* kept)
        : prepared(std::move(scene), [&](const Scene&, const RayScene&,
                                         const ProgressCallback&) { return other.prepared.atlas; }),
          light(prepared, {.rays = 16, .seed = 1}, kept)
    {
    }
    SolveScene prepared;
    LinkRelighter light;
};

std::size_t different_links(const Lit& one, const Lit& other)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < one.prepared.lumels.lumels.size(); ++i)
        for (std::uint32_t k = 0; k < one.light.links().rays(); ++k)
            count += one.light.links().of(i)[k] != other.light.links().of(i)[k];
    return count;
}

StoredLinks through_a_file(const StoredLinks& kept)
{
    const test::TemporaryFolder folder;
    const std::string path = folder / "scene.lumellinks";
    write_links(path, kept);
    return read_links(path);
}

TEST(KeptLight, OfOtherLampsAndSkyOverLinksFromAFileIsThatOfANewTracing)
{
    const Lit before(test::open_box());
    const StoredLinks kept = through_a_file(before.light.kept("hash"));
    Scene scene = test::open_box();
    scene.lights[0].transform[3] = glm::vec4(0.4f, 0.45f, 0.1f, 1.0f);
    for (glm::vec3& radiance : scene.sky.radiance)
        radiance *= glm::vec3(0.3f, 0.3f, 0.6f);
    for (Material& material : scene.materials)
        material.emitted *= 0.4f;
    Lit over(scene, &kept), anew(scene);
    EXPECT_EQ(over.light.links().traced().all(), 0u);
    EXPECT_EQ(different_links(over, anew), 0u);
    const Lights light = over.light.irradiance();
    EXPECT_EQ(light, anew.light.irradiance());
    EXPECT_EQ(light, over.light.irradiance()) << "whatever was lit before";
}

TEST(KeptLight, OfAThingThatMovedTracesFewLinksAndIsThatOfANewTracing)
{
    const Lit before(test::open_box());
    const StoredLinks kept = before.light.kept("hash");
    const Scene scene = with_block_moved(test::open_box());
    Lit over(scene, before, &kept), anew(scene, before, nullptr);
    ASSERT_EQ(over.prepared.lumels.lumels.size(), kept.lumels.size());
    const Retraced& traced = over.light.links().traced();
    EXPECT_GT(traced.started, 0u);
    EXPECT_GT(traced.ended, 0u);
    EXPECT_GT(traced.crossed, 0u);
    EXPECT_LT(traced.all(), kept.links.size() / 3);
    EXPECT_GT(different_links(before, anew), 0u);
    EXPECT_EQ(different_links(over, anew), 0u);
    EXPECT_EQ(over.light.irradiance(), anew.light.irradiance());
}

TEST(KeptLight, OverLinksOfAnotherSeedTracesAllOfThem)
{
    const Lit before(test::open_box());
    StoredLinks kept = before.light.kept("hash");
    kept.seed = 2;
    const Lit over(test::open_box(), &kept);
    EXPECT_EQ(over.light.links().traced().all(), kept.links.size());
}

TEST(KeptLinks, ComeBackFromAFileAsTheyWere)
{
    const StoredLinks kept = Lit(test::open_box()).light.kept("hash"), read = through_a_file(kept);
    EXPECT_EQ(read.scene_hash, "hash");
    EXPECT_EQ(read.rays, kept.rays);
    EXPECT_EQ(read.lumels, kept.lumels);
    EXPECT_EQ(read.instances, kept.instances);
    EXPECT_EQ(read.links, kept.links);
    ASSERT_EQ(read.sheets.size(), kept.sheets.size());
    for (std::size_t s = 0; s < kept.sheets.size(); ++s)
        EXPECT_EQ(read.sheets[s].texcoord, kept.sheets[s].texcoord);
}

TEST(KeptLinks, FromADamagedFileAreRefused)
{
    const test::TemporaryFolder folder;
    const std::string path = folder / "scene.lumellinks";
    EXPECT_THROW(read_links(path), Error);
    StoredLinks kept = Lit(test::open_box()).light.kept("hash");
    kept.links[5] = std::uint32_t(kept.ends());  // beyond the last
    write_links(path, kept);
    EXPECT_THROW(read_links(path), Error);
    kept.links[5] = 0;
    write_links(path, kept);
    read_links(path);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(1000);
    file.put('?');
    file.close();
    EXPECT_THROW(read_links(path), Error);
}

/// A file whose contents have any byte changed, and vouch for themselves again.
TEST(KeptLinks, ForgedAreRefusedOrSound)
{
    constexpr std::size_t kHead = 32, kFingerprint = 24;  // [bytes]
    const test::TemporaryFolder folder;
    const std::string path = folder / "scene.lumellinks";
    StoredLinks kept{.scene_hash = "hash",
                     .rays = 4,
                     .ray_offset = 0.1f,
                     .lumels = {1, 2, 3},
                     .instances = {4},
                     .links = {0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5}};
    kept.sheets = {{.texcoord = {{0, 0}, {1, 0}, {0, 1}}, .chart = {0}}};
    kept.side = 8;
    kept.charts = 1;
    write_links(path, kept);
    EXPECT_EQ(read_links(path).links, kept.links);
    std::ifstream file(path, std::ios::binary);
    const std::string given{std::istreambuf_iterator<char>(file), {}};
    std::size_t refused = 0, tried = 0;
    for (std::size_t at = kHead; at < given.size(); ++at)
        for (const char forged : {'\x00', '\x01', '\x7f', '\xff'}) {
            std::string bytes = given;
            bytes[at] = forged;
            Fingerprint print;
            print.add_bytes(bytes.data() + kHead, bytes.size() - kHead);
            const std::uint64_t value = print.value();
            std::memcpy(bytes.data() + kFingerprint, &value, sizeof value);
            std::ofstream(path, std::ios::binary) << bytes;
            ++tried;
            try {
                const StoredLinks read = read_links(path);
                EXPECT_EQ(read.links.size(), read.lumels.size() * read.rays);
                for (const std::uint32_t link : read.links)
                    EXPECT_LT(link, read.ends());
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input);
                ++refused;
            }
        }
    EXPECT_GT(refused, tried / 5);
    EXPECT_LT(refused, tried);
}

}  // namespace
}  // namespace lumel
