#include "bench/truth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/core.h>

#include "base/core/error.h"
#include "base/images/image_files.h"
#include "bench/iterated_gather.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

/// Of the two references; far from those that racers are given.
constexpr std::uint32_t kSeeds[] = {0xfffffffe, 0xffffffff};
constexpr std::uint32_t kGuideSeed = 0xfffffffd;
/// Rays of a lumel that choose dark lumels: a few per cent of the references' time.
constexpr std::uint32_t kGuideRays = 256;
/// Lumels are dark below this part of the mean (docs/methods.md).
constexpr double kDark = 1.0 / 3.0;
/// Lumels in a row of a file of references.
constexpr int kFileWidth = 1024;
constexpr int kColors = 3;

double sum(const glm::dvec3& color)
{
    return color.r + color.g + color.b;
}

Image empty_file(std::size_t lumels)
{
    return {kFileWidth, int((lumels + kFileWidth - 1) / kFileWidth), kColors};
}

void write_lumels(const std::string& path, const std::vector<glm::vec3>& light)
{
    Image file = empty_file(light.size());
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int c = 0; c < kColors; ++c)
            file.values[i * kColors + std::size_t(c)] = light[i][c];
    write_exr(path, file, Precision::float32, {{"content", "irradiance [lx], a pixel per lumel"}});
}

std::vector<glm::vec3> read_lumels(const std::string& path, std::size_t count)
{
    const Image file = read_exr(path), expected = empty_file(count);
    if (file.width != expected.width || file.height != expected.height)
        throw Error(ErrorKind::input, path, "was made for another scene or size of the atlas");
    std::vector<glm::vec3> light(count);
    for (std::size_t i = 0; i < count; ++i)
        for (int c = 0; c < kColors; ++c)
            light[i][c] = file.values[i * std::size_t(file.channels) + std::size_t(c)];
    return light;
}

/// Light from the file of that name, if references are kept and it is there, else as `make` finds
/// it.
std::vector<glm::vec3> kept(const Settings& settings, const SolveScene& world,
                            const std::string& name,
                            const std::function<std::vector<glm::vec3>()>& make)
{
    const std::string path =
        settings.references.empty() ? "" : settings.references + "." + name + ".exr";
    if (!path.empty() && std::filesystem::exists(path))
        return read_lumels(path, world.lumels.lumels.size());
    std::vector<glm::vec3> light = make();
    if (!path.empty())
        write_lumels(path, light);
    return light;
}

std::vector<glm::vec3> reference(const Settings& settings, const SolveScene& world,
                                 std::size_t which)
{
    return kept(settings, world, std::to_string(which + 1), [&] {
        fmt::print("reference {}: path tracing {} samples per lumel …\n", which + 1,
                   settings.reference_spp);
        std::fflush(stdout);
        return reference_irradiance(world.scene, world.rays, world.lumels,
                                    {.samples_per_lumel = settings.reference_spp,
                                     .seed = kSeeds[which],
                                     .rule = rule_of(settings.given.options())});
    });
}

/// An estimate with little noise, independent of the references.
std::vector<glm::vec3> find_guide(const Settings& settings, const SolveScene& world)
{
    return kept(settings, world, "guide", [&] {
        IteratedGather gather(world, rule_of(settings.given.options()), kGuideSeed);
        while (gather.rays() < kGuideRays)
            gather.pass();
        return gather.irradiance();
    });
}

}  // namespace

Truth::Truth(const Lumels& lumels, std::vector<glm::vec3> first, std::vector<glm::vec3> second,
             const std::vector<glm::vec3>& guide)
    : first_(std::move(first)),
      second_(std::move(second))
{
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i)
        if (!(lumels.lumels[i].flags & kLumelBuried))
            all_.push_back(i);
    const double limit = kDark * double(kColors) * mean_light(all_);
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(dark_),
                 [&](std::size_t i) { return sum(guide[i]) < limit; });
}

/// Of a channel.
double Truth::mean_light(const std::vector<std::size_t>& which) const
{
    double light = 0.0;
    for (const std::size_t i : which)
        light += sum(mean(i));
    return light / double(kColors * std::max(which.size(), std::size_t(1)));
}

LightError Truth::error(const std::vector<glm::vec3>& light,
                        const std::vector<std::size_t>& which) const
{
    double squares = 0.0, off = 0.0;
    for (const std::size_t i : which) {
        const glm::dvec3 t(light[i]);
        squares += glm::dot(t - glm::dvec3(first_[i]), t - glm::dvec3(second_[i]));
        off += sum(t - mean(i));
    }
    const double scale = mean_light(which), count = double(kColors) * double(which.size());
    if (!(scale > 0.0))
        return {};
    // Where the error is less than the noise of what it is compared with, the mean may fall below
    // 0.
    return {std::sqrt(std::max(squares / count, 0.0)) / scale, off / count / scale};
}

double Truth::noise() const
{
    double squares = 0.0;
    for (const std::size_t i : all_) {
        const glm::dvec3 half = 0.5 * (glm::dvec3(first_[i]) - glm::dvec3(second_[i]));
        squares += glm::dot(half, half);
    }
    const double scale = mean_light(all_), count = double(kColors) * double(all_.size());
    return scale > 0.0 ? std::sqrt(squares / count) / scale : 0.0;
}

std::optional<Truth> find_truth(const Settings& settings, const SolveScene& world)
{
    if (settings.reference_spp <= 0)
        return {};
    std::vector<glm::vec3> first = reference(settings, world, 0);
    std::vector<glm::vec3> second = reference(settings, world, 1);
    return Truth(world.lumels, std::move(first), std::move(second), find_guide(settings, world));
}

}  // namespace lumel::bench
