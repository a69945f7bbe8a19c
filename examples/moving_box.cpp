// A host that keeps a scene lit while a box in it turns.
//
//     moving_box [SCENE [FRAMES]]
//
// By default 12 frames of scenes/moving-large-lamp.gltf, whose instance "box" turns.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <lumel/lumel.h>

namespace {

/// Turned about the vertical through a point [rad].
lumel::Mat4 turned(const lumel::Mat4& transform, const lumel::Vec3& about, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    lumel::Mat4 result = transform;
    for (std::size_t column = 0; column < 4; ++column) {
        const bool is_place = column == 3;  // the other columns are directions
        const float x = transform[4 * column] - (is_place ? about[0] : 0.0f);
        const float z = transform[4 * column + 2] - (is_place ? about[2] : 0.0f);
        result[4 * column] = c * x + s * z + (is_place ? about[0] : 0.0f);
        result[4 * column + 2] = c * z - s * x + (is_place ? about[2] : 0.0f);
    }
    return result;
}

void play(const std::string& path, int frames)
{
    constexpr float kStep = 0.1f;      // [rad] a frame
    constexpr double kBudget = 100.0;  // [ms] a call
    const lumel::Device device;        // or one of the host's own: lumel/vulkan.h
    const lumel::Scene scene = lumel::Scene::load(path);
    const std::uint32_t box = scene.find_instance("box");
    lumel::LiveSettings settings;
    settings.atlas.size = 64;
    settings.movers = {box};
    settings.redistribution = lumel::Redistribution::cross;

    lumel::LiveScene live(device, scene, settings);
    live.update(std::numeric_limits<double>::infinity());  // the first solution takes longest
    const lumel::Mat4 start = scene.instances()[box].transform;
    for (int frame = 1; frame <= frames; ++frame) {
        live.move(box, turned(start, {1.0f, 0.0f, 1.0f}, kStep * float(frame)));
        lumel::LiveState state = live.update(kBudget);
        int calls = 1;
        for (; state.under_way; ++calls)
            state = live.update(kBudget);
        // lumel::device_image(live) is now the lightmap of this frame, ready to be sampled.
        std::printf("frame %2d: %d calls, light still to be shot %.2f %%\n", frame, calls,
                    100.0 * state.residual);
    }
}

}  // namespace

int main(int count, char** words)
try {
    play(count > 1 ? words[1] : "scenes/moving-large-lamp.gltf",
         count > 2 ? std::atoi(words[2]) : 12);
    return 0;
} catch (const lumel::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
