// Form factors between patches, and what is made of them.

#include "methods/matrix/matrix.h"

#include <numeric>

#include "solved.h"
#include "truth/reference.h"

namespace lumel {
namespace {

Transport transport_of(const SolveScene& world, std::uint32_t patches)
{
    MatrixOptions method;
    method.transport.patches = patches;
    const support::Resident resident(world.scene, world.rays, world.lumels, {.method = method});
    TransportBuilder builder(resident.device, resident.world, world.lumels, resident.near,
                             method.transport);
    while (!builder.done())
        builder.step();
    Transport transport = builder.finish();
    EXPECT_EQ(resident.device.validation_messages(), "");
    return transport;
}

TEST(FormFactors, AddUpToOneInAClosedRoomAndAreReciprocal)
{
    const SolveScene world(support::scene_path("furnace-0.5"), AtlasOptions{.size = 64});
    const Transport transport = transport_of(world, 512);
    const std::size_t n = transport.patches.size();
    EXPECT_GT(n, 256u);
    EXPECT_EQ(transport.check.closed, n);
    // As found: points for areas.
    EXPECT_LT(transport.check.row_sum, 0.005);
    EXPECT_LT(transport.check.reciprocity, 0.02);
    for (std::uint32_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (std::uint32_t j = 0; j < n; ++j) {
            sum += double(transport.form_factors.at(i, j));
            const float there = transport.patches.patches[i].area * transport.form_factors.at(i, j);
            const float back = transport.patches.patches[j].area * transport.form_factors.at(j, i);
            EXPECT_NEAR(there, back, 1e-5f * std::max(there, back));
        }
        EXPECT_NEAR(sum, 1.0, 1e-4) << "row " << i;
    }
}

TEST(FormFactors, BalancedKeepTheSumsOfOpenRows)
{
    SquareMatrix matrix{3, {0.0f, 0.4f, 0.5f, 0.8f, 0.0f, 0.3f, 0.25f, 0.075f, 0.0f}};
    const std::vector<float> area = {1.0f, 0.5f, 2.0f};
    const std::vector<char> closed = {1, 1, 0};
    const FormFactorCheck check = balance(matrix, area, closed);
    EXPECT_EQ(check.closed, 2u);
    EXPECT_NEAR(check.worst_row_sum, 0.1, 1e-6);
    const double truth[] = {1.0, 1.0, 0.325};
    for (std::uint32_t i = 0; i < 3; ++i)
        EXPECT_NEAR(matrix.at(i, 0) + matrix.at(i, 1) + matrix.at(i, 2), truth[i], 1e-4) << i;
    EXPECT_NEAR(area[0] * matrix.at(0, 1), area[1] * matrix.at(1, 0), 1e-6);
    EXPECT_NEAR(area[1] * matrix.at(1, 2), area[2] * matrix.at(2, 1), 1e-6);
}

TEST(VoxelPatches, HoldAllOpenLumelsOnceAndAreTheSameAgain)
{
    const SolveScene world(support::scene_path("cornell-box"), AtlasOptions{.size = 64});
    const support::Resident resident(world.scene, world.rays, world.lumels,
                                     {.method = MatrixOptions{}});
    const auto make = [&] {
        return make_voxel_patches(resident.world, world.lumels, resident.near.around, 600);
    };
    const VoxelPatches patches = make();
    EXPECT_LE(patches.size(), 600u);
    EXPECT_GT(patches.size(), 450u);
    EXPECT_EQ(patches.patch_of, make().patch_of);
    double of_lumels = 0.0, of_patches = 0.0;
    for (std::size_t i = 0; i < world.lumels.lumels.size(); ++i) {
        const bool buried = (world.lumels.lumels[i].flags & kLumelBuried) != 0;
        EXPECT_EQ(patches.patch_of[i] == kPatchless, buried);
        of_lumels += buried ? 0.0 : double(world.lumels.lumels[i].area);
    }
    for (const VoxelPatch& patch : patches.patches)
        of_patches += double(patch.area);
    EXPECT_NEAR(of_patches, of_lumels, 1e-4 * of_lumels);
}

// The patches of a bent wall face differently; two walls that share a voxel are two patches.
TEST(VoxelPatches, FaceOneWay)
{
    const SolveScene world(support::scene_path("cornell-box"), AtlasOptions{.size = 64});
    const support::Resident resident(world.scene, world.rays, world.lumels,
                                     {.method = MatrixOptions{}});
    const VoxelPatches patches =
        make_voxel_patches(resident.world, world.lumels, resident.near.around, 100);
    for (std::size_t i = 0; i < world.lumels.lumels.size(); ++i)
        if (patches.patch_of[i] != kPatchless) {
            const Lumel& lumel = world.lumels.lumels[i];
            const glm::mat3 normals(world.scene.instances[lumel.instance].transform);
            EXPECT_GT(glm::dot(glm::normalize(normals * lumel.normal),
                               patches.patches[patches.patch_of[i]].normal),
                      0.5f);
        }
}

/// Means of a map over patches, without the lamps: relative RMSE against others.
double error_of_means(const Lumels& lumels, const VoxelPatches& patches,
                      const std::vector<glm::vec3>& map, const std::vector<glm::vec3>& truth)
{
    const std::vector<glm::vec3> a = patches.means(lumels, map), b = patches.means(lumels, truth);
    double square = 0.0, sum = 0.0, area = 0.0;
    for (std::size_t q = 0; q < a.size(); ++q) {
        const double weight = double(patches.patches[q].area);
        const glm::vec3 off = a[q] - b[q];
        square += weight * double(glm::dot(off, off)) / 3.0;
        sum += weight * double(b[q].r + b[q].g + b[q].b) / 3.0;
        area += weight;
    }
    return std::sqrt(square / area) / (sum / area);
}

TEST(MatrixRadiosity, AgreesWithALumelSolverOnItsPatches)
{
    const SolveScene world(support::scene_path("cornell-box"), AtlasOptions{.size = 64});
    const SolverOptions options{.method = MatrixOptions{}, .target_error = 0.003};
    const support::Resident resident(world.scene, world.rays, world.lumels, options);
    MatrixRadiosity matrix(resident.device, resident.world, world, world.lumels, resident.near,
                           std::get<MatrixOptions>(options.method), options.target_error, {});
    ASSERT_TRUE(solve(matrix, options));
    ASSERT_NE(matrix.transport(), nullptr);
    const support::Solved lumels = support::solve_scene(
        world, {.method = ProgressiveOptions{}, .max_shots = 16384, .target_error = 0.0});
    EXPECT_LT(error_of_means(world.lumels, matrix.transport()->patches, matrix.irradiance(),
                             lumels.irradiance),
              0.01);
}

// With direct light from lumel to lumel it is 8 % off, and 4 % with all reflections from patches.
TEST(MatrixRadiosity, LightsTheFurnishedRoomWithinTwoAndAHalfPerCent)
{
    const SolveScene world(support::scene_path("room"), AtlasOptions{.size = 96});
    const SolverOptions options{.method = MatrixOptions{}, .target_error = 0.01};
    const support::Solved solved = support::solve_scene(world, options);
    std::vector<glm::vec3> half[2];
    for (std::uint32_t h = 0; h < 2; ++h)
        half[h] = reference_irradiance(world.scene, world.rays, world.lumels,
                                       {.samples_per_lumel = 1024, .seed = 99 + h});
    EXPECT_LT(support::error_alone(solved.irradiance, half[0], half[1]), 0.025);
}

}  // namespace
}  // namespace lumel
