#include "jobs/inspect/room_report.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/parallel.h"
#include "base/json/json_file.h"
#include "jobs/edit/finished_bake.h"
#include "jobs/solve/stages.h"
#include "results/page/lamp_list.h"
#include "results/page/whole_map.h"

namespace lumel {
namespace {

/// Points per progress report, and minimum per task.
constexpr std::size_t kPointsPerStep = 64, kPointsPerTask = 1;
/// Margin of the scene's bounds as bounds of a room: surfaces lie in them [m].
constexpr double kRounding = 1e-3;

FloorArea area_of(const std::array<double, 4>& corners)
{
    return {{corners[0], corners[1]}, {corners[2], corners[3]}};
}

/// The pattern that fits a name alone, see fnmatch(3).
std::string pattern_of(const std::string& name)
{
    std::string pattern;
    for (const char letter : name) {
        if (letter == '*' || letter == '?' || letter == '[' || letter == '\\')
            pattern += '\\';
        pattern += letter;
    }
    return pattern;
}

std::vector<LampGroup> groups_of(const std::vector<ListedLamp>& lamps)
{
    std::vector<LampGroup> groups;
    for (const ListedLamp& lamp : lamps)
        if (lamp.kind == "group")
            for (const std::string& member : lamp.members)
                groups.push_back({lamp.name, pattern_of(member)});
    return groups;
}

/// Light of lamps as shares of the bake's: what their maps say of a texel holds for both sides.
void add_shares(const std::string& folder, const Pages& pages,
                const std::vector<ListedLamp>& listed, const Lumels& lumels, LampShares& shares)
{
    std::vector<glm::vec3> sum(lumels.lumels.size(), glm::vec3(0.0f));
    shares.of_lumels.assign(listed.size(), sum);
    for (std::size_t k = 0; k < listed.size(); ++k) {
        const Image map = whole_map(folder, pages, listed[k].map);
        if (map.width != lumels.width || map.height != lumels.height)
            throw Error(ErrorKind::input, listed[k].map, "has another size than the bake");
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const float* const texel = &map.values[4 * std::size_t(lumels.lumels[i].texel)];
            shares.of_lumels[k][i] = glm::max(glm::vec3(texel[0], texel[1], texel[2]), 0.0f);
            sum[i] += shares.of_lumels[k][i];
        }
    }
    for (std::vector<glm::vec3>& lamp : shares.of_lumels)
        for (std::size_t i = 0; i < sum.size(); ++i)
            for (int c = 0; c < 3; ++c)
                lamp[i][c] = sum[i][c] > 0.0f ? lamp[i][c] / sum[i][c] : 0.0f;
}

/// Lamps of lamps.json, in its order.
LampShares shares_of(const std::string& folder, const FinishedBake& bake, const LightMeter& meter)
{
    const std::string file = (std::filesystem::path(folder) / kLampsFile).string();
    const Pages pages =
        pages_in(folder, read_json((std::filesystem::path(folder) / kReportFile).string()));
    const Json document = read_json(file);
    const std::vector<ListedLamp> listed = lamps_of(JsonView(file, document), pages.count);
    const std::vector<LampGroup> groups = groups_of(listed);
    const SolveScene& scene = bake.prepared;
    LampShares shares{.lamps = find_lamps(scene.scene, scene.lumels, meter.sources(), groups)};
    std::vector<std::uint32_t> place;  // in the list
    for (const NamedLamp& lamp : shares.lamps.all) {
        const auto at = std::ranges::find(listed, lamp.name, &ListedLamp::name);
        if (at == listed.end() || shares.lamps.all.size() != listed.size())
            throw Error(ErrorKind::input, file, "lists other lamps than the scene has");
        place.push_back(std::uint32_t(at - listed.begin()));
    }
    std::vector<NamedLamp> all(listed.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        all[place[k]] = shares.lamps.all[k];
    shares.lamps.all = std::move(all);
    for (std::uint32_t& lamp : shares.lamps.of_source)
        lamp = place[lamp];
    shares.lamps.of_dim_sky = place[shares.lamps.of_dim_sky];
    add_shares(folder, pages, listed, scene.lumels, shares);
    return shares;
}

/// Readings at a point.
struct PlaceReading {
    Reading all;
    std::vector<double> lamps;  ///< [lamps] [lx]
};

class RoomMeter {
public:
    RoomMeter(const std::string& folder, const FinishedBake& bake, std::uint32_t samples)
        : origin_(bake.prepared.scene.origin),
          meter_(bake.prepared.scene, bake.prepared.rays, bake.prepared.atlas, bake.prepared.lumels,
                 bake.irradiance, {.samples = samples, .seed = seed_of(bake.record.solver.method)})
    {
        if (std::filesystem::exists(std::filesystem::path(folder) / kLampsFile))
            shares_ = shares_of(folder, bake, meter_);
    }

    PlaceReading read(const glm::dvec3& place, std::uint32_t number) const
    {
        const MeterPoint point{.position = glm::vec3(place - origin_)};
        PlaceReading reading{.all = meter_.read(point, number)};
        if (!reading.all.inside)
            reading.lamps = shares_ ? meter_.read_lamps(point, number, *shares_)
                                    : std::vector<double>{reading.all.lux};
        return reading;
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

/// Points, and the illuminance of each lamp at them.
Json json_of(const AreaPoints& area, const AreaLimits& limits,
             std::span<const PlaceReading> readings)
{
    Json places = Json::array(), lux = Json::array();
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (readings[i].all.inside)
            continue;
        places.push_back({area.places[i].x, area.places[i].z});
        Json of_lamps = Json::array();
        for (const double lamp : readings[i].lamps)
            of_lamps.push_back(shortest(float(lamp)));
        lux.push_back(std::move(of_lamps));
    }
    return {{"name", name_of(area.area)},      {"illuminance", limits.illuminance},
            {"uniformity", limits.uniformity}, {"cell", {area.cell.x, area.cell.y}},
            {"places", std::move(places)},     {"lux", std::move(lux)}};
}

FloorArea room_of(const RoomOptions& options, const SolveScene& scene)
{
    if (options.bounds)
        return area_of(*options.bounds);
    const glm::dvec3 low = glm::dvec3(scene.rays.low()) + scene.scene.origin;
    const glm::dvec3 high = glm::dvec3(scene.rays.high()) + scene.scene.origin;
    return {glm::dvec2(low.x, low.z) + kRounding, glm::dvec2(high.x, high.z) - kRounding};
}

}  // namespace

Json room_data(const std::string& folder, const RoomOptions& options,
               const ProgressFunction& progress)
{
    const RoomUse& use = room_use_named(options.use);
    Stages stages(progress);
    stages.begin("reading");
    const FinishedBake bake(folder);
    const SolveScene& scene = bake.prepared;
    const FloorArea room = room_of(options, scene);
    std::optional<FloorArea> task;
    if (options.task)
        task = area_of(*options.task);
    const double floor = double(scene.rays.low().y) + scene.scene.origin.y;
    const double height = options.height.value_or(floor + use.height);
    const std::vector<AreaPoints> areas = points_in_areas(room, task ? &*task : nullptr, height);

    stages.begin("rays");
    const RoomMeter meter(folder, bake, options.samples);
    std::vector<glm::dvec3> places;
    for (const AreaPoints& area : areas)
        places.insert(places.end(), area.places.begin(), area.places.end());
    std::vector<PlaceReading> readings(places.size());
    const bool done = parallel_steps(
        places.size(), kPointsPerStep, kPointsPerTask,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                readings[i] = meter.read(places[i], std::uint32_t(i));
        },
        [&](std::size_t count) { return stages.progress(double(count) / double(places.size())); });
    if (!done)
        throw_stopped();

    const AreaLimits of_task{options.illuminance.value_or(use.illuminance),
                             options.uniformity.value_or(use.uniformity)};
    Json rows = Json::array();
    std::size_t first = 0;
    for (const AreaPoints& area : areas) {
        const AreaLimits limits = area.area == RoomArea::task ? of_task
                                  : area.area == RoomArea::surrounding
                                      ? surrounding_limits(of_task.illuminance)
                                      : background_limits(of_task.illuminance);
        rows.push_back(
            json_of(area, limits, std::span(readings).subspan(first, area.places.size())));
        first += area.places.size();
    }
    if (rows.front()["places"].empty())
        throw Error(ErrorKind::input, "--en12464",
                    "finds no point of the task area in the open air; use --plane and --bounds");
    stages.end();
    return {{"use", use.name},
            {"title", use.title},
            {"maintenance", options.maintenance},
            {"height", height},
            {"room", {room.low.x, room.low.y, room.high.x, room.high.y}},
            {"has_own_task", task.has_value()},
            {"areas", rows}};
}

std::string room_text(const Json& room)
{
    std::string text;
    const double maintenance = room["maintenance"].get<double>();
    for (const Json& area : room["areas"]) {
        std::vector<Reading> readings;
        for (const Json& of_lamps : area["lux"]) {
            readings.emplace_back();
            for (const Json& lux : of_lamps)
                readings.back().lux += lux.get<double>();
        }
        const PlaneFigures found = figures_of(readings);
        const auto verdict = [&](double is, const char* wanted) {
            return is >= area[wanted].get<double>() ? "met" : "not met";
        };
        text +=
            fmt::format("{}: {} points, maintained {:.4g} lx of {:.4g} ({}), uniformity {:.2f} of "
                        "{:.2f} ({})\n",
                        area["name"].get<std::string>(), found.count, maintenance * found.mean,
                        area["illuminance"].get<double>(),
                        verdict(maintenance * found.mean, "illuminance"), found.uniformity,
                        area["uniformity"].get<double>(), verdict(found.uniformity, "uniformity"));
    }
    return text;
}

}  // namespace lumel
