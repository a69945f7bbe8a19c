// scene.glb with Draco streams: what readers decode is the plain file within the steps.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "../../scene/compressed_file.h"
#include "../../scene/twins.h"
#include "../../support/temporary_folder.h"
#include "base/core/files.h"
#include "conformance.h"
#include "hand_atlas.h"
#include "results/files/gltf_write.h"
#include "scene/gltf/accessor.h"

namespace lumel::test {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
/// Of one step in two directions, by half of which each coordinate is off.
const float kHalfDiagonal = std::sqrt(0.5f);
const float kLightmapStep = std::exp2(-20.0f), kTextureStep = std::exp2(-16.0f);
constexpr float kNormal = 3e-4f;  ///< 0.02 degrees
/// Of a file; the two larger ones take a minute.
constexpr std::size_t kMaxTriangles = 20'000;

/// JSON of a .glb, as it is in the file.
Json raw_json(const std::string& path)
{
    constexpr std::size_t kLengthAt = 12, kText = 20;  // behind headers
    const Bytes file = read_file(path, path);
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + kLengthAt, sizeof length);
    return Json::parse(file.begin() + kText, file.begin() + kText + length);
}

std::string write_packed(const TemporaryFolder& folder, const Scene& scene, const Atlas& atlas,
                         Compression compression)
{
    const std::string path =
        folder / (compression == Compression::draco ? "packed.glb" : "plain.glb");
    write_scene_glb(path, load_gltf_document(scene.path), scene, atlas, any_map(atlas),
                    {.format = LightmapFormat::none, .compression = compression});
    return path;
}

std::size_t triangles_of(const Scene& scene)
{
    std::size_t indices = 0;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            indices += primitive.indices.size();
    return indices / 3;
}

/// Diagonal of all that the scene shows [m].
float extent_of(const Scene& scene)
{
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            for (const glm::vec3& position : primitive.positions) {
                const glm::vec3 placed(instance.transform * glm::vec4(position, 1.0f));
                low = glm::min(low, placed);
                high = glm::max(high, placed);
            }
    return glm::distance(low, high);
}

/// That the accessors of streams are what these decode to.
void expect_stated(const Json& json, const GltfDocument& document)
{
    for (const Json& mesh : json["meshes"])
        for (const Json& primitive : mesh["primitives"]) {
            if (!primitive.contains("extensions") || !primitive["extensions"].contains(kDraco))
                continue;
            const std::size_t position = primitive["attributes"]["POSITION"];
            const Json& accessor = json["accessors"][position];
            EXPECT_FALSE(accessor.contains("bufferView"));
            const AccessorData data = read_accessor(document, position);
            EXPECT_EQ(accessor["count"], data.count);
            const std::vector<float> values = to_floats(data);
            for (std::size_t c = 0; c < 3; ++c) {
                float low = values[c], high = values[c];
                for (std::size_t i = c; i < values.size(); i += 3) {
                    low = std::min(low, values[i]);
                    high = std::max(high, values[i]);
                }
                if (data.component_type == ComponentType::f32) {
                    EXPECT_EQ(accessor["min"][c].get<float>(), low);
                    EXPECT_EQ(accessor["max"][c].get<float>(), high);
                }
            }
            const std::size_t indices = primitive["indices"];
            EXPECT_EQ(json["accessors"][indices]["count"], read_accessor(document, indices).count);
        }
}

TEST(DracoWrite, ShowsThePlainFileWithinItsSteps)
{
    if (conformance_files().empty())
        GTEST_SKIP() << "no conformance files at " << kConformance;
    const TemporaryFolder folder;
    std::size_t packed_files = 0;
    for (const std::string& path : conformance_files()) {
        SCOPED_TRACE(path);
        const std::optional<Scene> scene = try_read(path);
        if (!scene || triangles_of(*scene) > kMaxTriangles)
            continue;
        // Texture coordinates of vertices that triangles share, and lightmap coordinates that
        // differ at every corner.
        for (const std::size_t set : {std::size_t(0), std::size_t(1)}) {
            const Atlas atlas = set == 0 ? shared_atlas(*scene) : corner_atlas(*scene);
            const Scene plain = read_gltf(write_packed(folder, *scene, atlas, Compression::none));
            const std::string file = write_packed(folder, *scene, atlas, Compression::draco);
            const Json json = raw_json(file);
            if (!json.contains("extensionsRequired") ||
                std::ranges::find(json["extensionsRequired"], kDraco) ==
                    json["extensionsRequired"].end())
                continue;
            ++packed_files;
            expect_stated(json, load_gltf_document(file));
            // Positions: half a step of the longest side in each of three directions.
            expect_twins(plain, read_gltf(file),
                         {.position = std::sqrt(0.75f) * std::exp2(-18.0f) * extent_of(plain),
                          .normal = kNormal,
                          .texcoord = kHalfDiagonal * (set == 0 ? kTextureStep : kLightmapStep),
                          .set = set});
        }
    }
    EXPECT_GT(packed_files, 50u);
}

/// The wave with vertices that have all attributes.
GltfBuilder rich_wave()
{
    const RayBatch wave;
    GltfBuilder builder = wave.plain();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    std::vector<glm::vec4> tangents, colors;
    std::vector<glm::u8vec4> joints;
    std::vector<glm::vec4> weights;
    for (std::size_t i = 0; i < wave.positions.size(); ++i) {
        const float at = float(i) / float(wave.positions.size());
        tangents.emplace_back(std::cos(at), 0.0f, std::sin(at), i % 2 == 0 ? 1.0f : -1.0f);
        colors.emplace_back(at, 1.0f - at, 0.5f * at, 1.0f);
        joints.emplace_back(std::uint8_t(i % 3), 1, 2, 0);
        weights.emplace_back(at, 1.0f - at, 0.0f, 0.0f);
    }
    attributes["TANGENT"] = builder.add_accessor(tangents, "VEC4", 5126, tangents.size());
    attributes["COLOR_0"] = builder.add_accessor(colors, "VEC4", 5126, colors.size());
    attributes["JOINTS_0"] = builder.add_accessor(joints, "VEC4", 5121, joints.size());
    attributes["WEIGHTS_0"] = builder.add_accessor(weights, "VEC4", 5126, weights.size());
    return builder;
}

/// Rows of an attribute, by the position that they belong to.
std::vector<std::vector<float>> rows_of(const GltfDocument& document, const char* name)
{
    const Json& attributes = document.json["meshes"].back()["primitives"][0]["attributes"];
    const AccessorData at = read_accessor(document, attributes["POSITION"]),
                       data = read_accessor(document, attributes[name]);
    const std::vector<float> places = to_floats(at), values = to_floats(data);
    std::vector<std::vector<float>> rows;
    for (std::size_t i = 0; i < at.count; ++i) {
        // The wave's places in its grid of 8 x 8 are exact.
        std::vector<float> row = {places[3 * i], places[3 * i + 2]};
        row.insert(row.end(), values.begin() + std::ptrdiff_t(i * data.components),
                   values.begin() + std::ptrdiff_t((i + 1) * data.components));
        rows.push_back(row);
    }
    std::ranges::sort(rows);
    return rows;
}

TEST(DracoWrite, KeepsAllAttributes)
{
    const TempFolder folder;
    const Scene scene = read_gltf(rich_wave().write(folder));
    const Atlas atlas = shared_atlas(scene);
    const GltfDocument plain = load_gltf_document(
                           write_packed(folder, scene, atlas, Compression::none)),
                       packed = load_gltf_document(
                           write_packed(folder, scene, atlas, Compression::draco));
    ASSERT_NE(raw_json(folder / "packed.glb").dump().find(kDraco), std::string::npos);
    for (const auto& [name, error] : {std::pair("JOINTS_0", 0.0f),
                                      {"WEIGHTS_0", 0.0f},
                                      {"TEXCOORD_0", 0.5f * kTextureStep},
                                      {"TANGENT", std::exp2(-13.0f)},
                                      {"COLOR_0", std::exp2(-13.0f)},
                                      {"NORMAL", kNormal}}) {
        SCOPED_TRACE(name);
        const auto wanted = rows_of(plain, name), found = rows_of(packed, name);
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            ASSERT_EQ(found[i].size(), wanted[i].size());
            for (std::size_t c = 0; c < wanted[i].size(); ++c)
                EXPECT_NEAR(found[i][c], wanted[i][c], c < 2 ? 0.0f : error);
        }
    }
}

/// Points, lines and morphed triangles.
TEST(DracoWrite, LeavesTheRestPlain)
{
    const TempFolder folder;
    GltfBuilder builder = rich_wave();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    Json morphed = primitive;
    morphed["targets"] = Json::array({{{"POSITION", 0}}});
    builder.show(morphed);
    constexpr int kPoints = 0, kLines = 1;
    for (const int mode : {kPoints, kLines}) {
        Json other = wave_primitive();
        other["mode"] = mode;
        builder.show(other);
    }
    const Scene scene = read_gltf(builder.write(folder));
    const Atlas atlas = shared_atlas(scene);
    const Json json = raw_json(write_packed(folder, scene, atlas, Compression::draco));
    std::size_t packed = 0;
    for (const Json& mesh : json["meshes"])
        for (const Json& one : mesh["primitives"]) {
            const bool is_packed = one.contains("extensions") && one["extensions"].contains(kDraco);
            packed += is_packed;
            EXPECT_FALSE(is_packed && (one.contains("mode") || one.contains("targets"))) << one;
            for (const auto& [name, accessor] : one["attributes"].items())
                EXPECT_EQ(json["accessors"][accessor.get<std::size_t>()].contains("bufferView"),
                          !is_packed);
        }
    EXPECT_EQ(packed, 1u);
}

}  // namespace
}  // namespace lumel::test
