// A session picks, moves and deletes the object that the picture shows.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "base/core/error.h"
#include "scene/values/scene.h"
#include "viewer/session/session.h"

namespace lumel {
namespace {

constexpr int kWidth = 96;  // of pictures [pixels]

struct Box {
    explicit Box(const SessionOptions& options = Box::options())
        : session(device, read_gltf(support::source_path("scenes/cornell-box.gltf")), {}, options)
    {
    }
    ~Box() { EXPECT_EQ(device.validation_messages(), ""); }
    static SessionOptions options()
    {
        SessionOptions options;
        options.atlas.size = 32;
        options.link_rays = 4;
        options.width = kWidth;
        return options;
    }
    void settle()
    {
        while (!session.frame().at_rest) {
        }
    }
    /// As scripts wait and the window draws on.
    void bake()
    {
        settle();
        while (!session.bake(std::chrono::milliseconds(1))) {
        }
    }
    const std::string& name_of(const Picked& picked) const
    {
        return session.scene().instances[picked.instance].name;
    }

    gpu::Device device;
    ViewSession session;
};

/// Distance along a ray to a triangle, by its plane and the signs of its edges.
std::optional<double> meets(const glm::dvec3& origin, const glm::dvec3& way, const glm::dvec3& a,
                            const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double across = glm::dot(normal, way);
    if (across == 0.0)
        return std::nullopt;
    const double distance = glm::dot(normal, a - origin) / across;
    const glm::dvec3 point = origin + distance * way;
    for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, a}})
        if (glm::dot(glm::cross(to - from, point - from), normal) < 0.0)
            return std::nullopt;
    return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

struct Nearest {
    std::string name;
    double distance = std::numeric_limits<double>::infinity();
};

/// The first surface along a ray, of all triangles that there are.
Nearest nearest(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& way)
{
    Nearest found;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            for (std::size_t k = 0; k + 2 < primitive.indices.size(); k += 3) {
                const auto corner = [&](std::size_t n) {
                    const glm::vec3& position = primitive.positions[primitive.indices[k + n]];
                    return glm::dvec3(instance.transform * glm::vec4(position, 1.0f));
                };
                const auto distance = meets(origin, way, corner(0), corner(1), corner(2));
                if (distance && *distance < found.distance)
                    found = {instance.name, *distance};
            }
    return found;
}

/// Through the middle of a pixel of a camera that looks along `forward`.
glm::dvec3 way_through(const ViewSession& session, const glm::ivec2& pixel)
{
    const View& view = session.camera().view();
    const glm::dvec3 ahead(session.camera().forward()), up(session.camera().up());
    const double half = std::tan(0.5 * double(view.vertical_fov));
    const glm::dvec2 place = (glm::dvec2(pixel) + 0.5) / glm::dvec2(session.size());
    return glm::normalize(
        ahead + (2.0 * place.x - 1.0) * half * double(view.aspect) * glm::cross(ahead, up) +
        (1.0 - 2.0 * place.y) * half * up);
}

TEST(ViewSession, PicksTheNearestSurfaceThroughThePixel)
{
    Box box;
    int blocks = 0;
    for (int y = 3; y < box.session.size().y; y += 9)
        for (int x = 3; x < box.session.size().x; x += 9) {
            const glm::ivec2 pixel(x, y);
            const Nearest wanted = nearest(box.session.scene(), box.session.camera().eye(),
                                           way_through(box.session, pixel));
            const auto found = box.session.seen_at(pixel);
            ASSERT_EQ(found.has_value(), std::isfinite(wanted.distance)) << x << ' ' << y;
            if (!found)
                continue;
            EXPECT_EQ(box.name_of(*found), wanted.name) << x << ' ' << y;
            EXPECT_NEAR(double(found->distance), wanted.distance, 1e-4 * wanted.distance);
            blocks += wanted.name.ends_with("block");
        }
    EXPECT_GT(blocks, 5);
}

TEST(ViewSession, MovesWhatIsPickedAndNothingElse)
{
    Box box;
    box.session.pick("short block");
    ASSERT_TRUE(box.session.picked());
    const std::uint32_t block = box.session.picked()->instance;
    const std::vector<Instance> before = box.session.scene().instances;
    const glm::vec3 way(-0.1f, 0.0f, 0.05f);
    box.session.move(way);
    for (std::uint32_t i = 0; i < before.size(); ++i) {
        const glm::vec3 moved = glm::vec3(box.session.scene().instances[i].transform[3]) -
                                glm::vec3(before[i].transform[3]);
        EXPECT_LT(glm::distance(moved, i == block ? way : glm::vec3(0.0f)), 1e-6f) << i;
    }
    box.session.unpick();
    EXPECT_FALSE(box.session.picked());
    EXPECT_THROW(box.session.move(way), Error);
    EXPECT_THROW(box.session.pick("no such block"), Error);
}

TEST(ViewSession, TurnedAllAroundItIsWhereItWas)
{
    Box box;
    box.session.pick("tall block");
    const std::uint32_t block = box.session.picked()->instance;
    const glm::mat4 before = box.session.scene().instances[block].transform;
    for (int k = 0; k < 4; ++k)
        box.session.turn(glm::radians(90.0f));
    const glm::mat4& after = box.session.scene().instances[block].transform;
    for (int c = 0; c < 4; ++c)
        EXPECT_LT(glm::distance(after[c], before[c]), 1e-5f);
}

TEST(ViewSession, ShowsTheWallBehindWhatIsDeleted)
{
    Box box;
    const glm::ivec2 pixel(kWidth * 75 / 120, box.session.size().y * 85 / 120);
    box.session.pick(pixel);
    ASSERT_TRUE(box.session.picked());
    ASSERT_EQ(box.name_of(*box.session.picked()), "short block");
    const float near = box.session.picked()->distance;
    box.session.remove();
    EXPECT_FALSE(box.session.picked());
    const auto behind = box.session.seen_at(pixel);
    ASSERT_TRUE(behind);
    EXPECT_EQ(box.name_of(*behind), "back wall");
    EXPECT_GT(behind->distance, near);
}

TEST(ViewSession, IsBakedAtRestUntilTheNextEdit)
{
    Box box;
    box.bake();
    ASSERT_TRUE(box.session.light().baked());
    EXPECT_LE(box.session.light().baked()->error, Box::options().bake_error);
    const std::vector<glm::vec3> before = box.session.irradiance();
    EXPECT_EQ(before, box.session.light().baked()->irradiance);
    box.session.pick("short block");
    box.session.move({0.0f, 0.0f, -0.05f});
    EXPECT_FALSE(box.session.light().baked());
    box.settle();
    const std::vector<glm::vec3> by_links = box.session.irradiance();
    EXPECT_NE(by_links, before);
    box.bake();
    EXPECT_NE(box.session.irradiance(), by_links);

    // As a method solves the same scene.
    SolverOptions links;
    links.method = LinksOptions{.seed = Box::options().seed, .rays = Rays::host};
    const SolvedLight solved =
        solve_standing(box.device, box.session.standing(MaterialModel::diffuse),
                       box.session.light().lumels(), links);
    EXPECT_EQ(box.session.irradiance(), solved.irradiance);
}

TEST(ViewSession, AnEditDropsABakeThatIsUnderWay)
{
    Box box;
    box.settle();
    EXPECT_FALSE(box.session.bake(std::chrono::milliseconds(0)));
    EXPECT_TRUE(box.session.is_baking());
    box.session.set_lamp("light", glm::vec3(0.0f));
    EXPECT_FALSE(box.session.is_baking());
    EXPECT_FALSE(box.session.bake(std::chrono::seconds(60))) << "that of the scene before";
    EXPECT_FALSE(box.session.light().baked());
    box.bake();
    for (const glm::vec3& light : box.session.irradiance())
        EXPECT_EQ(light, glm::vec3(0.0f));
}

TEST(ViewSession, IsNotBakedAgainstAWish)
{
    SessionOptions options = Box::options();
    options.bake_error = 0.0;
    Box box(options);
    box.bake();
    EXPECT_FALSE(box.session.light().baked());
}

TEST(ViewSession, ALampByHalfLightsAllByHalf)
{
    Box box;
    box.settle();
    const std::vector<glm::vec3> before = box.session.irradiance();
    box.session.set_lamp("light", glm::vec3(0.5f));
    box.settle();
    const std::vector<glm::vec3>& after = box.session.irradiance();
    double one = 0.0, half = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        one += double(before[i].g);
        half += double(after[i].g);
    }
    ASSERT_GT(one, 0.0);
    EXPECT_NEAR(half / one, 0.5, 1e-3);
}

}  // namespace
}  // namespace lumel
