// A host that keeps a scene lit over links, without a Vulkan device, while a box and a lamp move
// and the lamp is dimmed.
//
//     box_and_lamp [SCENE [FRAMES]]
//
// By default 12 frames of scenes/moving-small-lamp.gltf, with its instances "box" and "lamp" and
// its material "lamp".

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <lumel/lumel.h>

namespace {

lumel::Mat4 shifted(const lumel::Mat4& transform, float x, float z)
{
    lumel::Mat4 result = transform;
    result[12] += x;
    result[14] += z;
    return result;
}

/// Green light, the mean of all texels [lx].
double mean_of(const lumel::Map& map)
{
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < map.rgba.size(); i += 4)
        if (map.rgba[i + 3] > 0.0f) {
            sum += double(map.rgba[i + 1]);
            count += 1.0;
        }
    return count > 0.0 ? sum / count : 0.0;
}

void play(const std::string& path, int frames)
{
    constexpr double kBudget = 20.0;  // [ms] a frame
    constexpr float kStep = 0.02f;    // [m] a frame
    const lumel::Scene scene = lumel::Scene::load(path);
    const std::uint32_t box = scene.find_instance("box"), lamp = scene.find_instance("lamp");
    lumel::LiveLinksSettings settings;
    settings.atlas.size = 64;
    settings.movers = {box, lamp};

    lumel::LiveLinks live(scene, settings);
    live.update(std::numeric_limits<double>::infinity());  // the first solution takes longest
    const std::vector<lumel::Instance> start = scene.instances();
    for (int frame = 1; frame <= frames; ++frame) {
        const float way = kStep * float(frame), dimmed = 1.0f / (1.0f + 0.1f * float(frame));
        live.move(box, shifted(start[box].transform, way, 0.0f));
        live.move(lamp, shifted(start[lamp].transform, 0.0f, way));
        live.set_lamp("lamp", {dimmed, dimmed, dimmed});
        const lumel::LiveLinksState state = live.update(kBudget);
        // live.lumels() is what to show now: the light after the last move that is wholly followed.
        std::printf("frame %2d: %s, light still to bounce %.2f %%, mean %.3g lx\n", frame,
                    state.under_way ? "a move under way" : "all moves followed",
                    100.0 * state.residual, mean_of(live.lumels()));
    }
    const bool at_rest = live.update(std::numeric_limits<double>::infinity()).at_rest;
    std::printf("%s: mean %.3g lx\n", at_rest ? "at rest" : "not at rest", mean_of(live.map()));
}

}  // namespace

int main(int count, char** words)
try {
    play(count > 1 ? words[1] : "scenes/moving-small-lamp.gltf",
         count > 2 ? std::atoi(words[2]) : 12);
    return 0;
} catch (const lumel::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
