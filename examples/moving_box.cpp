// A host that keeps a scene lit while a box in it turns.
//
//     moving_box [SCENE]
//
// By default scenes/moving-large-lamp.gltf, whose instance "box" turns.

#include <cstdio>
#include <exception>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "live/live_scene.h"
#include "scene/scene.h"

namespace {

/// Turned about the vertical through a point [rad].
glm::mat4 turned(const glm::mat4& transform, const glm::vec3& about, float angle)
{
    const glm::mat4 there = glm::translate(glm::mat4(1.0f), about);
    return glm::translate(glm::rotate(there, angle, glm::vec3(0, 1, 0)), -about) * transform;
}

void play(const std::string& path)
{
    constexpr int kFrames = 12;
    constexpr float kStep = 0.1f;      // [rad] a frame
    constexpr double kBudget = 100.0;  // [ms] a call
    const lumel::gpu::Device device;   // or one made of a host's handles: gpu::HostDevice
    const lumel::Scene scene = lumel::read_gltf(path);
    lumel::LiveOptions options;
    options.atlas.size = 64;
    options.movers = {lumel::find_instance(scene, "box")};
    options.redistribution = lumel::Redistribution::cross;

    lumel::LiveScene live(device, scene, options);
    live.settle();  // the first solution takes longest
    const glm::mat4 start = scene.instances[options.movers[0]].transform;
    for (int frame = 1; frame <= kFrames; ++frame) {
        live.move(options.movers[0], turned(start, {1.0f, 0.0f, 1.0f}, kStep * float(frame)));
        lumel::LiveState state = live.update(kBudget);
        int calls = 1;
        for (; state.under_way; ++calls)
            state = live.update(kBudget);
        // live.irradiance_image() is now the lightmap of this frame, ready to be sampled.
        std::printf("frame %2d: %d calls, light still to be shot %.2f %%\n", frame, calls,
                    100.0 * state.residual);
    }
}

}  // namespace

int main(int count, char** words)
try {
    play(count > 1 ? words[1] : "scenes/moving-large-lamp.gltf");
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
