#include "bench/papers/dynamic_pictures.h"

#include <filesystem>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "results/preview/preview.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

constexpr const char* kLargeLamp = "scenes/moving-large-lamp.gltf";
/// Figure 4.5.4 is of 30 frames. The box turns once in them, so that it ends where it began.
constexpr int kFrames = 30;
constexpr double kTurn = 360.0 / kFrames;
/// Of the box and the light on the floor below it [m, rad].
constexpr glm::vec3 kFloor{1.0f, 0.1f, 0.9f}, kAbove{1.0f, 1.8f, 1.97f};
constexpr float kFloorFov = 1.2f;
/// Down to the floor [m].
constexpr glm::vec3 kDown{0.0f, -0.3f, 0.0f};
/// Of the picture of a contact: the lower front edge of the box, from in front of it [m, rad].
constexpr glm::vec3 kContact{1.0f, 0.1f, 1.35f}, kBeforeContact{1.25f, 0.55f, 1.95f};
constexpr float kContactFov = 0.8f;
constexpr std::uint32_t kPathSeed = 199;

/// Pictures of one scene, exposed alike.
class Camera {
public:
    Camera(const gpu::Device& device, const Scene& scene, const Atlas& atlas, const Lumels& lumels,
           View view, int width)
        : device_(&device),
          scene_(&scene),
          atlas_(&atlas),
          lumels_(&lumels),
          view_(std::move(view)),
          width_(width)
    {
    }

    /// irradiance: H [N]
    Image take(const std::vector<glm::vec3>& irradiance)
    {
        const Image radiance =
            render_preview(*device_, *scene_, *atlas_,
                           finish_map(*scene_, *atlas_, *lumels_, irradiance), view_, width_);
        if (!exposure_)
            exposure_ = choose_exposure(radiance).value_or(1.0f);
        return tone_map(radiance, *exposure_);
    }

private:
    const gpu::Device* device_;
    const Scene* scene_;
    const Atlas* atlas_;
    const Lumels* lumels_;
    View view_;
    int width_;
    std::optional<float> exposure_;
};

View from(const glm::vec3& eye, const glm::vec3& at, float vertical_fov)
{
    return {.transform = glm::inverse(glm::lookAt(eye, at, glm::vec3(0.0f, 1.0f, 0.0f))),
            .vertical_fov = vertical_fov,
            .aspect = 1.0f};
}

Picture write(const DynamicSettings& settings, const std::string& name,
              const std::vector<std::vector<Image>>& rows, std::string caption)
{
    std::filesystem::create_directories(settings.folder);
    const std::string path = settings.folder + "/" + name + ".png";
    write_png(path, contact_sheet(rows));
    return {path, std::move(caption)};
}

/// The Cornell box with the large lamp, lit for a move.
struct Lit {
    Lit(const gpu::Device& device, const DynamicSettings& settings, Redistribution redistribution,
        bool reprojects = true)
        : scene(read_gltf(kLargeLamp)),
          box(find_instance(scene, kBox)),
          live(device, scene,
               {.atlas = {.size = settings.shared.size},
                .redistribution = redistribution,
                .reprojects = reprojects,
                .solver = options_of<ProgressiveOptions>(settings.shared),
                .movers = {box},
                .residual = settings.residual})
    {
        live.settle();
    }
    void move(const glm::mat4& place)
    {
        live.move(box, place);
        live.settle();
    }

    Scene scene;
    std::uint32_t box;
    LiveScene live;
};

void draw_reprojection(const gpu::Device& device, const DynamicSettings& settings, Report& report)
{
    const Lit with(device, settings, Redistribution::paper_cross);
    const Lit without(device, settings, Redistribution::paper_cross, false);
    const Scene& scene = with.live.scene();
    Camera camera(device, scene, with.live.atlas(), with.live.lumels(),
                  from(kAbove, kFloor, kFloorFov), settings.width);
    const Image right = camera.take(with.live.irradiance());
    const Picture picture =
        write(settings, "dynamic-reprojection", {{camera.take(without.live.irradiance()), right}},
              "paper-cross without and with reprojection, [Hoef13] figure 4.5.3");
    report.picture(picture.path, picture.caption);
}

void draw_accumulation(const gpu::Device& device, const DynamicSettings& settings, Report& report)
{
    const Lit scratch(device, settings, Redistribution::incremental);
    const Scene& scene = scratch.live.scene();
    const Lumels& lumels = scratch.live.lumels();
    Camera camera(device, scene, scratch.live.atlas(), lumels, from(kAbove, kFloor, kFloorFov),
                  settings.width);
    const Image truth = in_a_row(lumels, scratch.live.irradiance());
    std::vector<Image> row{camera.take(scratch.live.irradiance())};
    report.table("accumulation",
                 fmt::format("Relative RMSE from progressive, %, before and after {} moves that "
                             "turn the box once ([Hoef13] figure 4.5.4)",
                             kFrames),
                 {"technique", "before", "after"}, kSolvedAnew);
    for (const auto& [redistribution, name] :
         {std::pair{Redistribution::paper_cross, kTechniqueNames[kPaperCross]},
          std::pair{Redistribution::paper_cross_incremental,
                    kTechniqueNames[kPaperCrossIncremental]}}) {
        Lit lit(device, settings, redistribution);
        const auto error = [&] {
            return fixed(
                100.0 * compare_maps(in_a_row(lumels, lit.live.irradiance()), truth).relative_rmse,
                2);
        };
        const Cell before = error();
        for (int frame = 1; frame <= kFrames; ++frame)
            lit.move(turned(scene, lit.box, kTurn * frame));
        report.row({name, before, error()});
        row.push_back(camera.take(lit.live.irradiance()));
    }
    const Picture picture =
        write(settings, "dynamic-accumulation", {row},
              fmt::format("Progressive; paper-cross and paper-cross-incremental after {} moves, "
                          "[Hoef13] figure 4.5.4",
                          kFrames));
    report.picture(picture.path, picture.caption);
}

void draw_contact(const gpu::Device& device, const DynamicSettings& settings, Report& report)
{
    std::vector<Image> row;
    std::string names;
    std::optional<Camera> camera;  // once its scene is there
    const auto add = [&](const char* name, const std::vector<glm::vec3>& irradiance) {
        row.push_back(camera->take(irradiance));
        names += (names.empty() ? "" : ", ") + std::string(name);
    };
    Lit paper(device, settings, Redistribution::paper_cross);
    const glm::mat4 down =
        glm::translate(glm::mat4(1.0f), kDown) * paper.scene.instances[paper.box].transform;
    paper.move(down);
    const Scene& scene = paper.live.scene();
    const Atlas& atlas = paper.live.atlas();
    camera.emplace(device, scene, atlas, paper.live.lumels(),
                   from(kBeforeContact, kContact, kContactFov), settings.width);
    add(kTechniqueNames[kPaperCross], paper.live.irradiance());
    for (const auto& [redistribution, name] :
         {std::pair{Redistribution::cross, kTechniqueNames[kCross]},
          std::pair{Redistribution::incremental, kTechniqueNames[kIncremental]}}) {
        Lit lit(device, settings, redistribution);
        lit.move(down);
        add(name, lit.live.irradiance());
    }
    const Lit laid_out(device, settings, Redistribution::incremental);
    const SolveScene world(scene, atlas, laid_out.live.lumels());
    add(kOurDefault, solve_by_default(device, world).irradiance);
    if (settings.shared.reference_spp > 0)
        add("paths", reference_irradiance(
                         scene, world.rays, world.lumels,
                         {.samples_per_lumel = settings.shared.reference_spp, .seed = kPathSeed}));
    const Picture picture = write(settings, "dynamic-contact", {row},
                                  "A box on the floor, [Hoef13] figure 5.2.5, by " + names);
    report.picture(picture.path, picture.caption);
}

}  // namespace

Picture draw_techniques(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                        const Lumels& lumels, const ThesisScene& which,
                        const DynamicSettings& settings, const MoveResults& results)
{
    const bool is_cornell_box = which.picture > 1;
    Camera camera(device, scene, atlas, lumels,
                  is_cornell_box ? from(kAbove, kFloor, kFloorFov)
                                 : choose_view(scene, RayScene(scene)),
                  settings.width);
    std::string names;
    const auto take = [&](const char* name, const std::vector<glm::vec3>& irradiance) {
        names += (names.empty() ? "" : ", ") + std::string(name);
        return camera.take(irradiance);
    };
    std::vector<std::vector<Image>> rows(1);
    for (int technique = kGather; technique < kTechniques; ++technique) {
        if (!results.by[technique])
            continue;
        if (technique == kPaperIncremental)
            rows.emplace_back();
        rows.back().push_back(take(kTechniqueNames[technique], results.by[technique]->irradiance));
    }
    rows.back().push_back(take(kOurDefault, results.ours.irradiance));
    if (!results.truth.empty())
        rows.back().push_back(take("paths", results.truth));
    return write(settings, fmt::format("dynamic-{}", which.key), rows,
                 fmt::format("{}, [Hoef13] figure 5.2.{}, row by row: {}", which.title,
                             which.picture, names));
}

void draw_artefacts(const gpu::Device& device, const DynamicSettings& settings, Report& report)
{
    draw_reprojection(device, settings, report);
    draw_accumulation(device, settings, report);
    draw_contact(device, settings, report);
}

}  // namespace lumel::bench
