#pragma once
// Rooms that rays of two casters are compared in.

#include <array>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "gpu/device.h"
#include "links/trace/links_options.h"
#include "rays/device/device_caster.h"

namespace lumel::support {

/// A closed room under a lamp, with a pane of red glass, a grating that is cut out, and a veil that
/// lets half of the light pass.
inline Scene room_with_curtains()
{
    const auto walls = box_walls({0, 0, 0}, {3, 2, 4}, true, {.albedo = {0.7f, 0.6f, 0.5f}});
    std::vector<Quad> quads(walls.begin(), walls.end());
    const auto upright = [&](float z) {
        quads.push_back({.corner = {0.5f, 0.2f, z},
                         .edge_u = {2.0f, 0.3f, 0.1f},
                         .edge_v = {0.0f, 1.5f, 0.2f},
                         .albedo = {0.8f, 0.4f, 0.3f},
                         .double_sided = true});
    };
    upright(1.0f);
    upright(2.0f);
    upright(3.0f);
    quads.push_back({.corner = {1, 1.9f, 1},
                     .edge_u = {1, 0, 0},
                     .edge_v = {0, 0, 1},
                     .albedo = glm::vec3(0.0f),
                     .emission = glm::vec3(10.0f)});
    Scene scene = make_quads(quads).scene;
    Material *glass = &scene.materials[walls.size()], *grating = glass + 1, *veil = glass + 2;
    glass->transmission = 0.7f;
    scene.textures.push_back({2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    grating->alpha_mode = AlphaMode::mask;
    grating->base_color_texture.texture = 0;
    grating->base_color_texture.wrap_s = Wrap::clamp;
    veil->alpha_mode = AlphaMode::blend;
    veil->base_color.a = 0.5f;
    return scene;
}

/// A way of a device to cast rays.
struct DeviceRays {
    const char* name;
    Rays option;
    std::unique_ptr<RayCaster> (*cast)(const gpu::Device& device, const RayScene& rays);
};

inline const std::array kDeviceRays = {DeviceRays{"query", Rays::query, cast_by_queries},
                                       DeviceRays{"tree", Rays::tree, cast_by_tree}};

inline std::string name_of_rays(const testing::TestParamInfo<DeviceRays>& test)
{
    return test.param.name;
}

/// A test of rays that a device casts; skipped if it cannot.
class OnDevice : public testing::Test {
protected:
    void need(const DeviceRays& rays)
    {
        if (rays.option == Rays::query && !device.can_query_rays())
            GTEST_SKIP() << device.info().name
                         << " has no ray queries; tools/newer_mesa runs a program on one that has";
    }
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    gpu::Device device;
};

/// A test by each way of a device to cast rays.
class ByDeviceRays : public OnDevice, public testing::WithParamInterface<DeviceRays> {
protected:
    void SetUp() override { need(GetParam()); }
};

}  // namespace lumel::support
