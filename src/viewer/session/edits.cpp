// Applies animation time, and replays edits on a new session of the same scene.

#include <fmt/format.h>

#include "atlas/near/still_part.h"
#include "base/core/error.h"
#include "viewer/session/session.h"

namespace lumel {
namespace {

bool are_alike(const std::optional<SunPosition>& a, const std::optional<SunPosition>& b)
{
    return a.has_value() == b.has_value() &&
           (!a || (a->azimuth == b->azimuth && a->elevation == b->elevation));
}

}  // namespace

void ViewSession::set_time(double seconds)
{
    std::vector<glm::mat4> motions;
    for (const MovableObject& thing : things_) {
        if (!thing.played)
            continue;
        const std::uint32_t any = thing.instances.front();
        const glm::mat4 now = place_in(shown_, animation_, shown_.instances[any].node, seconds);
        if (!is_rigid(given_[any], now))
            throw Error(
                ErrorKind::input, "",
                fmt::format("\"{}\" is stretched by the animation at {:g} s", thing.name, seconds));
        motions.push_back(now == given_[any]
                              ? glm::mat4(1.0f)
                              : glm::mat4(glm::dmat4(now) * glm::inverse(glm::dmat4(given_[any]))));
    }
    time_ = seconds;
    auto motion = motions.begin();
    for (std::uint32_t t = 0; t < things_.size(); ++t)
        if (things_[t].played) {
            things_[t].animation = *motion++;
            if (!things_[t].deleted)
                put(t);
        }
    for (const AnimatedMaterial& material : animation_.materials)
        played_[std::size_t(material.material)] = emission_factor(material, seconds);
    for (const ViewLamp& lamp : lamps_)
        if (!lamp.is_light)
            apply(lamp);
}

void ViewSession::take_edits(const ViewSession& before)
{
    while (live_.state().all_sweeps == 0)  // or all is dark until moves are updated
        live_.advance(0.0);
    for (std::uint32_t t = 0; t < things_.size(); ++t) {
        things_[t].by_hand = before.things_[t].by_hand;
        things_[t].deleted = before.things_[t].deleted;
        if (things_[t].deleted)
            hide(t);
        put(t);
    }
    for (std::uint32_t l = 0; l < lamps_.size(); ++l)
        lamps_[l].factor = before.lamps_[l].factor;
    take_light(before);
    for (std::uint32_t m = 0; m < shown_.materials.size(); ++m) {
        glm::vec4& mine = shown_.materials[m].base_color;
        const glm::vec4& colour = before.shown_.materials[m].base_color;
        if (mine != colour)
            live_.set_albedo(m, glm::vec3(colour));
        mine = colour;
    }
    camera_ = before.camera_;
    exposure_ = before.exposure_;
    stops_ = before.stops_;
    mode_ = before.mode_;
    scale_ = before.scale_;
    error_scale_ = before.error_scale_;
    set_probes(before.probe_spacing_);
}

/// Takes lamps, sun, sky and time.
void ViewSession::take_light(const ViewSession& before)
{
    set_time(before.time_);
    for (const ViewLamp& lamp : lamps_)
        apply(lamp);
    if (!are_alike(sun_, before.sun_))
        set_sun(*before.sun_);
    if (shown_.sky.empty())
        return;
    set_sky(before.sky_);
    if (before.sky_angle_ != 0.0)
        turn_sky(before.sky_angle_);
}

}  // namespace lumel
