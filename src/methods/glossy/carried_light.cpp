// Iteration i on the device uses particles that started from the light of iteration i - 3:
//
//     step i      CPU: fetches the particles started from the light of i - 3, waits for i - 2,
//                 starts particles from its light for i + 1
//                 GPU: works on i - 1, then on i
//
// The first three start from the initial light.

#include "methods/glossy/carried_light.h"

#include <algorithm>
#include <cstring>

namespace lumel {

CarriedLight::Slot::Slot(const gpu::Device& device, std::size_t count)
    : irradiance(device, count, gpu::Buffer::Place::host, "carried_light.irradiance"),
      reflected(device, count, gpu::Buffer::Place::host, "carried_light.reflected"),
      exitance(device, count, gpu::Buffer::Place::host, "carried_light.exitance")
{
}

CarriedLight::CarriedLight(const gpu::Device& device, const LobeParticles* particles,
                           std::span<const glm::vec3> direct, std::span<const glm::vec3> emission,
                           std::size_t lumel_count)
    : particles_(particles),
      direct_(direct.begin(), direct.end()),
      emission_(emission.begin(), emission.end()),
      count_(particles ? lumel_count : 0),
      slots_{Slot(device, count_), Slot(device, count_)},
      irradiance_(device, count_),
      reflected_(device, count_)
{
}

std::uint64_t CarriedLight::device_bytes(std::size_t lumel_count)
{
    constexpr std::uint64_t kOfSlot = 3, kOnDevice = 2;  // number of arrays
    return (kOfSlot * kSlots + kOnDevice) * lumel_count * sizeof(glm::vec3);
}

void CarriedLight::restart()
{
    if (found_.valid())
        found_.wait();
    found_ = {};
    iteration_ = 0;
}

void CarriedLight::find(std::size_t count, std::uint32_t seed)
{
    leaving_ = exitance_;
    for (std::size_t i = 0; i < emission_.size(); ++i)
        leaving_[i] += emission_[i];
    found_ = std::async(std::launch::async, [this, count, seed] {
        return particles_->carry(leaving_, direct_, count, seed);
    });
}

void CarriedLight::begin(gpu::Pacer& pacer, const gpu::Array<glm::vec3>& exitance,
                         std::size_t count, std::uint32_t seed, std::uint32_t number)
{
    if (!particles_)
        return;
    if (iteration_ == 0) {
        pacer.finish();
        exitance_ = exitance.download();
        find(count, PathSamples::hash(seed, number));
    }
    const LobeParticles::Carried carried = found_.get();
    Slot& slot = slots_[iteration_ % kSlots];
    if (iteration_ >= kSlots) {
        pacer.wait(slot.ticket);
        std::copy_n(slot.exitance.mapped(), count_, exitance_.begin());
    }
    find(count, PathSamples::hash(seed, number + 1));
    const std::uint64_t bytes = count_ * sizeof(glm::vec3);
    std::memcpy(slot.irradiance.buffer().mapped(), carried.irradiance.data(), bytes);
    std::memcpy(slot.reflected.buffer().mapped(), carried.reflected.data(), bytes);
    pacer.work("carried", [&](gpu::Commands& commands) {
        commands.copy(slot.irradiance.buffer(), irradiance_.buffer(), bytes);
        commands.copy(slot.reflected.buffer(), reflected_.buffer(), bytes);
    });
}

void CarriedLight::end(gpu::Pacer& pacer, const gpu::Array<glm::vec3>& exitance)
{
    if (!particles_)
        return;
    Slot& slot = slots_[iteration_ % kSlots];
    pacer.work("carried", [&](gpu::Commands& commands) {
        commands.copy(exitance.buffer(), slot.exitance.buffer(), count_ * sizeof(glm::vec3));
    });
    slot.ticket = pacer.flush();
    ++iteration_;
}

}  // namespace lumel
