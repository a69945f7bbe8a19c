#include "jobs/bake/reference.h"

#include "atlas/prepare/solve_scene.h"
#include "jobs/bake/outputs.h"
#include "jobs/solve/setting.h"
#include "results/files/folder.h"
#include "truth/reference_image.h"

namespace lumel {

BakeSummary bake_reference(const std::string& scene_path, const std::string& folder,
                           const BakeOptions& options, const ReferenceOptions& reference,
                           MaterialModel materials, const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    Scene scene = read_scene(scene_path, materials, options.lights);
    OutputFolder output(folder);
    stages.begin("charts");
    const SolveScene prepared(std::move(scene), options.atlas, stages.callback());
    tell_user(prepared);
    note_sizes(prepared, stages);

    stages.begin("path tracing");
    bool stopped = false;
    const std::vector<glm::vec3> irradiance = reference_irradiance(
        prepared.scene, prepared.rays, prepared.lumels, reference, [&](double fraction) {
            stopped =
                !stages.progress(fraction, std::uint64_t(fraction * reference.samples_per_lumel));
            return !stopped;
        });
    if (irradiance.empty())
        throw_stopped();

    stages.begin("finishing");
    return write_reference(output, options, reference, prepared, irradiance, stopped, stages);
}

Image path_traced_picture(const Scene& scene, const RayScene& rays, const View& view,
                          const glm::ivec2& size, int paths, std::uint32_t seed, Stages& stages)
{
    stages.begin("path tracing");
    Image image = reference_image(
        scene, rays, view,
        {.width = size.x, .height = size.y, .samples_per_pixel = paths, .seed = seed},
        [&](double fraction) { return stages.progress(fraction); });
    if (image.values.empty())
        throw_stopped();
    return image;
}

}  // namespace lumel
