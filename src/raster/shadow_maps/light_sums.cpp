#include "raster/shadow_maps/light_sums.h"

namespace lumel {
namespace {

}  // namespace

SummedLight::SummedLight(const gpu::Device& device, std::size_t lumels)
    : sums_(device, lumels),
      irradiance_(device, lumels),
      finish_(device)
{
    gpu::Commands commands(device);
    commands.fill(sums_.buffer());
    commands.fill(irradiance_.buffer());
    commands.run();
}

void SummedLight::finish_source(gpu::Pacer& pacer)
{
    pacer.dispatch("sum of a source", finish_, {.sums = sums_, .irradiance = irradiance_},
                   CountParams{lumels()}, lumels());
}

void SummedLight::finish(gpu::Pacer& pacer)
{
    pacer.finish();
    for (const auto& [kind, ms] : pacer.times())
        times_[kind] += ms;
}

}  // namespace lumel
