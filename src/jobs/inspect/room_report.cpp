#include "jobs/inspect/room_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"
#include "base/json/json_file.h"
#include "jobs/edit/finished_bake.h"
#include "lights/light_sources.h"
#include "results/measure/room_floor.h"
#include "results/measure/room_space.h"
#include "results/page/lamp_list.h"
#include "results/page/whole_map.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// Illuminance from here on is rounded to whole lux, below to three digits.
constexpr double kWholeLux = 100.0;
constexpr double kHundredths = 100.0;

FloorArea area_of(const std::array<double, 4>& corners)
{
    return {{corners[0], corners[1]}, {corners[2], corners[3]}};
}

/// Light of the lamps on a lumel as shares of the bake's, from their maps; where these are dark,
/// shares of the whole bake. A back without texels of its own has the shares of its front.
std::vector<std::vector<glm::vec3>> shares_of(const std::string& folder, const Pages& pages,
                                              const std::vector<ListedLamp>& listed,
                                              const Lumels& lumels)
{
    const std::size_t count = lumels.lumels.size();
    std::vector<glm::vec3> sum(count, glm::vec3(0.0f));
    std::vector<std::vector<glm::vec3>> lamps(listed.size(), sum);
    std::vector<glm::dvec3> of_all(listed.size(), glm::dvec3(0.0));
    glm::dvec3 all(0.0);
    for (std::size_t k = 0; k < listed.size(); ++k) {
        const Image map = whole_map(folder, pages, listed[k].map);
        if (map.width != lumels.width || map.height != lumels.height)
            throw Error(ErrorKind::input, (fs::path(folder) / listed[k].map).string() + ".exr",
                        "has another size than the bake");
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t texel = map_texel(lumels, lumels.lumels[i]);
            const float* const light = &map.values[4 * texel];
            lamps[k][i] = glm::max(glm::vec3(light[0], light[1], light[2]), 0.0f);
            sum[i] += lamps[k][i];
            of_all[k] += glm::dvec3(lamps[k][i]);
        }
        all += of_all[k];
    }
    for (std::size_t k = 0; k < listed.size(); ++k)
        for (std::size_t i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c)
                lamps[k][i][c] = sum[i][c] > 0.0f ? lamps[k][i][c] / sum[i][c]
                                 : all[c] > 0.0   ? float(of_all[k][c] / all[c])
                                                  : 0.0f;
    return lamps;
}

/// Lamps of lamps.json, in its order.
LampShares lamps_in(const std::string& folder, const SolveScene& scene, const LightMeter& meter)
{
    const std::string file = (fs::path(folder) / kLampsFile).string();
    const Pages pages = pages_in(folder, read_json((fs::path(folder) / kReportFile).string()));
    const Json document = read_json(file);
    const JsonView view(file, document);
    const std::vector<ListedLamp> listed = lamps_of(view, pages.count);
    std::vector<NamedLamp> named;
    for (const ListedLamp& lamp : listed)
        named.push_back({lamp.name, lamp.members, lamp.kind});
    return {find_lamps(scene.scene, scene.lumels, meter.sources(), std::move(named), file),
            shares_of(folder, pages, listed, scene.lumels)};
}

class RoomMeter {
public:
    RoomMeter(const std::string& folder, const FinishedBake& bake, std::uint32_t samples)
        : origin_(bake.prepared.scene.origin),
          meter_(bake.prepared.scene, bake.prepared.rays, bake.prepared.atlas, bake.prepared.lumels,
                 bake.irradiance, {.samples = samples, .seed = seed_of(bake.record.solver.method)})
    {
        if (fs::exists(fs::path(folder) / kLampsFile))
            shares_ = lamps_in(folder, bake.prepared, meter_);
    }

    /// place: world of the file [m]. number: of the point.
    LampReadings read(const glm::dvec3& place, std::uint32_t number) const
    {
        const MeterPoint point{.position = glm::vec3(place - origin_)};
        if (shares_)
            return meter_.read_lamps(point, number, *shares_);
        const Reading reading = meter_.read(point, number);
        return {{reading.lux}, reading.inside};
    }

private:
    glm::dvec3 origin_;
    LightMeter meter_;
    std::optional<LampShares> shares_;
};

const char* name_of(RoomArea area)
{
    switch (area) {
    case RoomArea::task:
        return "task area";
    case RoomArea::surrounding:
        return "immediate surrounding area";
    case RoomArea::background:
        return "background area";
    }
    return "";
}

AreaLimits limits_of(RoomArea area, const AreaLimits& task)
{
    switch (area) {
    case RoomArea::task:
        return task;
    case RoomArea::surrounding:
        return surrounding_limits(task.illuminance);
    case RoomArea::background:
        return background_limits(task.illuminance);
    }
    return {};
}

/// Points in the open air with their cells, and the illuminance of each lamp at them.
Json measured(const AreaPoints& area, const AreaLimits& task, double height, const RoomMeter& meter)
{
    std::vector<LampReadings> readings(area.points.size());
    parallel_for(readings.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const glm::dvec2& at = area.points[i].at;
            readings[i] = meter.read({at.x, height, at.y}, std::uint32_t(i));
        }
    });
    Json places = Json::array(), lux = Json::array();
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (readings[i].inside)
            continue;
        const AreaPoint& point = area.points[i];
        places.push_back({point.at.x, point.at.y, point.cell.x, point.cell.y});
        Json of_lamps = Json::array();
        for (const double lamp : readings[i].lux)
            of_lamps.push_back(shortest(float(lamp)));
        lux.push_back(std::move(of_lamps));
    }
    const AreaLimits limits = limits_of(area.area, task);
    return {{"name", name_of(area.area)},      {"illuminance", limits.illuminance},
            {"uniformity", limits.uniformity}, {"spacing", area.spacing},
            {"places", std::move(places)},     {"lux", std::move(lux)}};
}

FloorArea bounds_of(const SolveScene& scene)
{
    const glm::dvec3 low = scene.low_in_file(), high = scene.high_in_file();
    return {{low.x, low.z}, {high.x, high.z}};
}

glm::dvec2 shift_of(const SolveScene& scene)
{
    return {scene.scene.origin.x, scene.scene.origin.z};
}

/// In the coordinates of the rays [m].
FloorArea in_rays(const FloorArea& area, const SolveScene& scene)
{
    return {area.low - shift_of(scene), area.high - shift_of(scene)};
}

/// The floor within bounds [m], if there is one.
std::optional<RoomFloor> floor_within(const SolveScene& scene, const FloorArea& bounds)
{
    std::optional<RoomFloor> found = floor_of_room(scene.rays, in_rays(bounds, scene));
    if (found) {
        found->height += scene.scene.origin.y;
        found->area.low += shift_of(scene);
        found->area.high += shift_of(scene);
    }
    return found;
}

/// Removes points that surfaces separate from the room. Returns how many.
std::size_t remove_apart(const SolveScene& scene, const FloorArea& room, double height,
                         const std::optional<FloorArea>& task, std::vector<AreaPoints>& areas)
{
    std::optional<FloorArea> core;
    if (task)
        core = in_rays(*task, scene);
    const RoomSpace space(scene.rays, in_rays(room, scene), height - scene.scene.origin.y, core);
    std::size_t removed = 0;
    for (AreaPoints& area : areas)
        removed += std::erase_if(area.points, [&](const AreaPoint& point) {
            return !space.has(point.at - shift_of(scene));
        });
    return removed;
}

void check_height(double height, const SolveScene& scene)
{
    const double low = scene.low_in_file().y, high = scene.high_in_file().y;
    if (!is_near_scene(height, low, high))
        throw Error(ErrorKind::input, fmt::format("--plane {:.4g}", height),
                    fmt::format("is outside of the scene, which reaches from {:.4g} to {:.4g} m "
                                "of height",
                                low, high));
}

/// True if the scene has a sky or a sun.
bool has_daylight(const SolveScene& scene)
{
    return std::ranges::any_of(
        light_sources(scene.scene, scene.lumels), [&](const LightSource& source) {
            return source.sky || std::ranges::any_of(source.lights, [&](std::uint32_t light) {
                       return scene.scene.lights[light].kind == PunctualLight::Kind::directional;
                   });
        });
}

/// Rounded as on the page, where verdicts are of rounded values.
double rounded_lux(double lux)
{
    return lux >= kWholeLux ? std::round(lux) : std::stod(fmt::format("{:.3g}", lux));
}

double rounded_uniformity(double uniformity)
{
    return std::round(kHundredths * uniformity) / kHundredths;
}

std::string line_of(const Json& area, double maintenance)
{
    const std::string name = area["name"].get<std::string>();
    if (area["lux"].empty())
        return name + ": no point in the open air, not measured\n";
    std::vector<Reading> readings;
    for (const Json& of_lamps : area["lux"]) {
        readings.emplace_back();
        for (const Json& lux : of_lamps)
            readings.back().lux += lux.get<double>();
    }
    const PlaneFigures found = figures_of(readings);
    const double lux = rounded_lux(maintenance * found.mean),
                 wanted = rounded_lux(area["illuminance"].get<double>()),
                 uniformity = rounded_uniformity(found.uniformity),
                 even = rounded_uniformity(area["uniformity"].get<double>());
    const auto verdict = [](bool is_met) { return is_met ? "met" : "not met"; };
    return fmt::format(
        "{}: {} points, maintained {:g} lx of {:g} ({}), uniformity {:.2f} of {:.2f} ({})\n", name,
        found.count, lux, wanted, verdict(lux >= wanted), uniformity, even,
        verdict(uniformity >= even));
}

}  // namespace

Json room_data(const std::string& folder, const RoomOptions& options)
{
    const RoomUse& use = room_use_named(options.use);
    const FinishedBake bake(folder);
    const SolveScene& scene = bake.prepared;
    if (options.height)
        check_height(*options.height, scene);
    const FloorArea searched = options.bounds ? area_of(*options.bounds) : bounds_of(scene);
    const std::optional<RoomFloor> floor = floor_within(scene, searched);
    const FloorArea room = floor && !options.bounds ? floor->area : searched;
    std::optional<FloorArea> task;
    if (options.task)
        task = area_of(*options.task);
    std::vector<AreaPoints> areas = points_in_areas(room, task ? &*task : nullptr);
    const double level = floor ? floor->height : scene.low_in_file().y;
    const double height = options.height.value_or(level + use.height);
    // Outdoors can be the largest space of a site.
    const bool is_known = floor || options.bounds;
    const std::size_t apart = is_known ? remove_apart(scene, room, height, task, areas) : 0;
    const AreaLimits limits{options.illuminance.value_or(use.illuminance),
                            options.uniformity.value_or(use.uniformity)};
    const RoomMeter meter(folder, bake, options.samples);
    Json measured_areas = Json::array();
    for (const AreaPoints& area : areas)
        measured_areas.push_back(measured(area, limits, height, meter));
    if (measured_areas.front()["places"].empty())
        throw Error(ErrorKind::input, "--en12464",
                    "finds no point of the task area in the open air of the room; use --plane, "
                    "--bounds and --task");
    return {{"title", use.title},
            {"maintenance", options.maintenance},
            {"height", height},
            {"room", {room.low.x, room.low.y, room.high.x, room.high.y}},
            {"apart", apart},
            {"has_daylight", has_daylight(scene)},
            {"areas", std::move(measured_areas)}};
}

std::string room_text(const Json& room)
{
    const Json& bounds = room["room"];
    std::string text =
        fmt::format("work plane at {:.4g} m, in the room from {:.2f},{:.2f} to {:.2f},{:.2f} m\n",
                    room["height"].get<double>(), bounds[0].get<double>(), bounds[1].get<double>(),
                    bounds[2].get<double>(), bounds[3].get<double>());
    for (const Json& area : room["areas"])
        text += line_of(area, room["maintenance"].get<double>());
    if (const auto apart = room["apart"].get<std::size_t>(); apart > 0)
        text += fmt::format("points left out, as they are not in the room: {}\n", apart);
    if (room["has_daylight"].get<bool>())
        text += "the light of sky and sun is counted like that of lamps\n";
    return text;
}

}  // namespace lumel
