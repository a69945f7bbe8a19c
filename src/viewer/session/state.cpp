// A session as JSON.

#include <algorithm>
#include <map>
#include <numeric>

#include <glm/trigonometric.hpp>

#include "base/core/luminance.h"
#include "base/json/json_file.h"
#include "jobs/inspect/probes.h"
#include "results/record/solver_settings.h"
#include "viewer/session/session.h"

namespace lumel {
namespace {

Json json_of(const SunPosition& sun)
{
    return {{"azimuth", glm::degrees(sun.azimuth)}, {"elevation", glm::degrees(sun.elevation)}};
}

Json light_of(const ViewSession& session)
{
    const LiveLinksState& state = session.light().state();
    const BakedLight* const baked = session.light().baked();
    return {{"at_rest", state.at_rest},
            {"baked_error_percent", baked ? Json(100.0 * baked->error) : Json(nullptr)},
            {"residual", state.residual},
            {"dark_residual", state.dark_residual},
            {"following", state.under_way},
            {"sweeps", state.sweeps},
            {"links_traced_again", state.found.links.all()},
            {"lumels", session.light().lumels().lumels.size()}};
}

Json costs_of(const FrameCosts& costs)
{
    return {{"count", costs.frames},
            {"last_ms", costs.last_ms},
            {"most_ms", costs.most_ms},
            {"mean_ms", costs.all_ms / double(std::max(costs.frames, 1))}};
}

/// Null for negative values.
Json percent_of(double percent)
{
    return percent < 0.0 ? Json(nullptr) : Json(percent);
}

/// Mean estimated error over lumels.
Json error_of(ViewSession& session)
{
    const std::vector<float>& percent = session.error_estimate();
    const double sum = std::accumulate(percent.begin(), percent.end(), 0.0);
    const LuxScale scale = session.error_scale();
    return {{"mean_percent", percent_of(sum / double(percent.size()))},
            {"scale_percent", Json::array({scale.low, scale.high})}};
}

/// Displayed light probes.
Json probes_of(ViewSession& session)
{
    if (!(session.probe_spacing() > 0.0))
        return nullptr;
    Json probes = Json::array();
    for (const ProbeBall& ball : session.probe_balls())
        probes.push_back({{"position", json_array(ball.place)},
                          {"coefficients", coefficients_of(ball.light)},
                          {"noise", ball.light.noise}});
    return {{"spacing_m", session.probe_spacing()}, {"probes", probes}};
}

/// Solved light of the current scene.
Json solved_of(ViewSession& session)
{
    const SolvedLight* solved = session.solved();
    if (!solved)
        return nullptr;
    Json json = solver_settings(solved->options);
    json["shots"] = solved->shots;
    json["seconds"] = solved->seconds;
    json["error_percent"] = percent_of(100.0 * solved->error);
    json["stopped"] = solved->stopped;
    json["shown"] = session.shows_solved();
    return json;
}

Json lumel_of(ViewSession& session, std::uint32_t number)
{
    const Lumels& lumels = session.light().lumels();
    const Lumel& lumel = lumels.lumels[number];
    const auto texel = int(lumel.texel);
    const glm::vec3 light = session.irradiance()[number];
    return {{"number", number},
            {"texel", Json::array({texel % lumels.width, texel / lumels.width})},
            {"chart", lumel.chart},
            {"back", (lumel.flags & kLumelBack) != 0},
            {"irradiance", json_array(light)},
            {"illuminance_lx", luminance(light)},
            {"error_percent", percent_of(session.error_estimate()[number])}};
}

Json picked_of(ViewSession& session)
{
    if (!session.picked())
        return nullptr;
    const Picked picked = *session.picked();
    const Scene& scene = session.scene();
    Json json = {{"name", scene.instances[picked.instance].name},
                 {"instance", picked.instance},
                 {"material", scene.materials[std::size_t(picked.material)].name},
                 {"movable", picked.thing.has_value()},
                 {"place", json_array(picked.place)}};
    if (picked.lumel != kNoLumel) {
        json["normal"] = json_array(picked.normal);
        json["distance"] = picked.distance;
        json["lumel"] = lumel_of(session, picked.lumel);
    }
    return json;
}

Json pixel_of(ViewSession& session)
{
    if (!session.pixel())
        return nullptr;
    const glm::ivec2 at = *session.pixel();
    Json json = {{"at", Json::array({at.x, at.y})}, {"luminance_cd_m2", session.luminance_at(at)}};
    const std::optional<double> lux = session.lux_at(at);
    json["illuminance_lx"] = lux ? Json(*lux) : Json(nullptr);
    return json;
}

/// Contributors to the picked lumel's light: fractions by name.
Json links_of(ViewSession& session)
{
    const std::vector<ViewLink> links = session.links();
    if (links.empty())
        return nullptr;
    std::map<std::string, double> sums;
    double all = 0.0;
    for (const ViewLink& link : links) {
        all += luminance(link.light);
        if (!link.name.empty())
            sums[link.name] += luminance(link.light);
    }
    Json by_name = Json::array();
    for (const auto& [name, lux] : sums)
        by_name.push_back({{"name", name}, {"share", all > 0.0 ? lux / all : 0.0}});
    return {{"count", links.size()}, {"illuminance_lx", all}, {"by_name", by_name}};
}

Json lamps_of(const ViewSession& session)
{
    Json json = Json::array();
    for (const ViewLamp& lamp : session.lamps())
        json.push_back({{"name", lamp.name}, {"factor", json_array(lamp.factor)}});
    return json;
}

}  // namespace

Json state_of(ViewSession& session)
{
    const ViewCamera& camera = session.camera();
    const LuxScale scale = session.scale();
    const glm::ivec2 size = session.size();
    Json json;
    json["light"] = light_of(session);
    json["solved"] = solved_of(session);
    json["frames"] = costs_of(session.costs());
    json["pictures"] = costs_of(session.picture_costs());
    json["picture"] = {{"width", size.x}, {"height", size.y}};
    json["camera"] = {{"eye", json_array(camera.eye())},
                      {"forward", json_array(camera.forward())},
                      {"up", json_array(camera.up())}};
    json["mode"] = kViewModes[std::size_t(session.mode())];
    json["exposure"] = {{"automatic", session.has_automatic_exposure()},
                        {"stops", session.stops()},
                        {"factor", session.exposure()}};
    json["scale_lx"] = Json::array({scale.low, scale.high});
    json["error"] = error_of(session);
    json["probes"] = probes_of(session);
    json["pixel"] = pixel_of(session);
    json["picked"] = picked_of(session);
    json["links"] = links_of(session);
    json["lamps"] = lamps_of(session);
    json["sun"] = session.sun() ? json_of(*session.sun()) : Json(nullptr);
    json["sky_degrees"] = glm::degrees(session.sky_angle());
    json["time_s"] = session.time();
    return json;
}

}  // namespace lumel
