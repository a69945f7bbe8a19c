#include "bench/papers/dynamic_stage.h"

#include <algorithm>

#include "bench/cut.h"

namespace lumel::bench {

Stage set(const ThesisScene& which, const DynamicSettings& settings, int pieces)
{
    Stage stage{.scene = read_gltf(which.path)};
    if (pieces > 1)
        stage.scene = cut(stage.scene, pieces);
    stage.box = find_instance(stage.scene, kBox);
    for (int step = 1; step <= settings.steps + 1; ++step)
        stage.places.push_back(turned(stage.scene, stage.box, double(step * settings.degrees)));
    stage.options.atlas.size = which.low_quality ? settings.low_size : settings.shared.size;
    stage.options.solver = options_of<ProgressiveOptions>(settings.shared);
    if (which.low_quality) {
        stage.options.solver.views.hemicube = settings.low_hemicube;
        stage.options.solver.shooters = std::uint32_t(settings.low_shooters);
    }
    stage.gather = options_of<GatherOptions>(settings.shared);
    stage.options.movers = {stage.box};
    stage.options.residual = settings.residual;
    return stage;
}

Scene posed(const Stage& stage)
{
    Scene scene = stage.scene;
    scene.instances[stage.box].transform = stage.places.back();
    return scene;
}

std::vector<ThesisScene> scenes_of(const DynamicSettings& settings)
{
    std::vector<ThesisScene> scenes;
    for (const ThesisScene& scene : kThesisScenes)
        if (settings.scenes.empty() ||
            std::count(settings.scenes.begin(), settings.scenes.end(), std::string(scene.key)) > 0)
            scenes.push_back(scene);
    return scenes;
}

}  // namespace lumel::bench
