#include "room.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "../support/source_folder.h"
#include "truth/reference.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

constexpr int kSamples = 256;         // of a lumel, in each half
constexpr float kSamePlace = 1e-4f;   // [m]
constexpr double kAllButSome = 0.99;  // of the lumels

Json box_with_a_lamp()
{
    std::ifstream file(support::source_path("scenes/cornell-box.gltf"));
    Json gltf = Json::parse(file);
    constexpr const char* kLights = "KHR_lights_punctual";
    gltf["extensionsUsed"].push_back(kLights);
    gltf["extensions"][kLights]["lights"] = {
        {{"name", "bulb"}, {"type", "point"}, {"intensity", 0.1}}};
    gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size());
    gltf["nodes"].push_back({{"name", "bulb"},
                             {"translation", {0.45, 0.3, 0.1}},
                             {"extensions", {{kLights, {{"light", 0}}}}}});
    return gltf;
}

Json& named(Json& list, const std::string& name)
{
    for (Json& one : list)
        if (one["name"] == name)
            return one;
    throw std::runtime_error("there is no " + name);
}

std::uint64_t place_of(const Lumel& lumel)
{
    return 2 * std::uint64_t(lumel.texel) + ((lumel.flags & kLumelBack) != 0 ? 1 : 0);
}

bool is_buried(const Lumel& lumel)
{
    return (lumel.flags & kLumelBuried) != 0;
}

double sum_of(const glm::dvec3& colour)
{
    return colour.r + colour.g + colour.b;
}

}  // namespace

RoomFiles::RoomFiles()
{
    const auto write = [&](Room room, const std::string& name, const Json& gltf) {
        paths_[room] = folder_ / name;
        std::ofstream(paths_[room]) << gltf;
    };
    const Json given = box_with_a_lamp();
    write(Room::given, "given.gltf", given);
    Json moved = given;
    named(moved["nodes"], kBlock)["translation"] = {kMove.x, kMove.y, kMove.z};
    write(Room::moved, "moved.gltf", moved);
    Json dimmed = given;
    Json& strength =
        named(dimmed["materials"],
              kLight)["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
    strength = double(kDimmed) * strength.get<double>();
    write(Room::dimmed, "dimmed.gltf", dimmed);
}

Reference::Reference(const std::string& scene_path, const std::vector<std::string>& movable)
    : world_(lay_out(read_gltf(scene_path), {.size = kSide}, movable))
{
    const RayScene rays(world_->scene);
    for (std::uint32_t h = 0; h < 2; ++h)
        halves_[h] = reference_irradiance(world_->scene, rays, world_->lumels,
                                          {.samples_per_lumel = kSamples, .seed = 99 + h});
    for (std::size_t i = 0; i < world_->lumels.lumels.size(); ++i)
        if (!is_buried(world_->lumels.lumels[i]))
            lumel_at_[place_of(world_->lumels.lumels[i])] = i;
}

Deviation Reference::of(const Found& found) const
{
    double square = 0.0, difference = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < found.lumels.lumels.size(); ++i) {
        const Lumel& lumel = found.lumels.lumels[i];
        const auto mine = lumel_at_.find(place_of(lumel));
        if (is_buried(lumel) || mine == lumel_at_.end())
            continue;
        if (glm::distance(lumel.position, world_->lumels.lumels[mine->second].position) >
            kSamePlace)
            throw std::runtime_error(fmt::format("lumel {} is elsewhere in the scene", i));
        const glm::dvec3 value(found.irradiance[i]), one(halves_[0][mine->second]),
            two(halves_[1][mine->second]);
        // The halves' errors are independent: on average this is the squared error of the value.
        square += glm::dot(value - one, value - two);
        difference += sum_of(value - 0.5 * (one + two));
        sum += 0.5 * sum_of(one + two);
        count += 1.0;
    }
    if (count < kAllButSome * double(lumel_at_.size()))
        throw std::runtime_error(
            fmt::format("only {} of {} lumels are in the reference", count, lumel_at_.size()));
    const double mean = sum / (3.0 * count);
    return {std::sqrt(std::max(square, 0.0) / (3.0 * count)) / mean, difference / sum};
}

}  // namespace lumel::test
