#include "solve/transport/patch_shots.h"

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Between the numbers of the points of one seed and the next.
constexpr std::uint32_t kNumbersApart = 0x9e3779b9;

}  // namespace

ShotLight::ShotLight(const gpu::Device& device, const Lumels& lumels)
    : surface(device, view(surfaces_of(lumels))),
      emission(device, view(emission_of(lumels))),
      shot(device, lumels.lumels.size()),
      far(device, lumels.lumels.size()),
      near(device, lumels.lumels.size())
{
}

PatchShots::PatchShots(const gpu::Device& device, const World& world, const Lumels& lumels,
                       const ViewOptions& options, std::uint32_t seed)
    : world_(&world),
      take_(device),
      views_(device, world, options.projection, std::uint32_t(options.hemicube),
             std::uint32_t(options.batch)),
      batch_(views_.capacity()),
      first_number_((seed - 1) * kNumbersApart),
      layout_(make_patches(lumels)),
      patches_(device, view(layout_.patches)),
      charts_(device, view(layout_.charts)),
      levels_(device, layout_.charts.size()),
      chosen_(device, batch_),
      eyes_(device, batch_),
      shots_(device, batch_),
      sending_(device, lumels.lumels.size()),
      no_ambient_(device, view(std::vector<glm::vec3>(1, glm::vec3(0.0f))))
{
}

std::uint64_t ShotLight::device_bytes(std::size_t lumel_count)
{
    constexpr std::uint64_t kVectors = 4;  // arrays of vec3 [N]
    return lumel_count * (sizeof(glm::vec4) + kVectors * sizeof(glm::vec3));
}

std::uint64_t PatchShots::device_bytes(const SolveSize& size, const ViewOptions& options)
{
    const Patches layout = make_patches(*size.lumels);
    const auto batch = std::uint32_t(options.batch);
    return EyeViews::device_bytes(options.projection, std::uint32_t(options.hemicube), batch) +
           layout.patches.size() * sizeof(Patch) +
           layout.charts.size() * (sizeof(PatchChart) + sizeof(std::uint32_t)) +
           batch * (sizeof(ChosenPatch) + sizeof(Eye) + sizeof(PatchShot)) +
           size.count() * sizeof(glm::vec3);
}

void PatchShots::take(gpu::Commands& commands, const ShotLight& light,
                      const gpu::Array<glm::vec3>& ambient)
{
    commands.dispatch(take_,
                      {.lumels = world_->lumels(),
                       .pieces = world_->pieces(),
                       .surface = light.surface,
                       .emission = light.emission,
                       .far = light.far,
                       .near = light.near,
                       .shot = light.shot,
                       .ambient = ambient,
                       .charts = charts_,
                       .patches = patches_,
                       .chosen = chosen_,
                       .sending = sending_,
                       .eyes = eyes_,
                       .shots = shots_},
                      TakeLightParams{batch_, first_number_}, batch_);
}

void PatchShots::take(gpu::Commands& commands, const ShotLight& light,
                      const gpu::Array<ChosenPatch>& list, std::uint32_t first)
{
    commands.copy_part(list.buffer(), first * sizeof(ChosenPatch), chosen_.buffer(), 0,
                       batch_ * sizeof(ChosenPatch));
    take(commands, light, no_ambient_);
}

std::vector<ChosenPatch> in_whole_batches(std::vector<ChosenPatch> list, std::uint32_t batch)
{
    while (list.empty() || list.size() % batch != 0)
        list.push_back({kNoPatch, 0, 0, kSendShot});
    return list;
}

}  // namespace lumel
