#include "viewer/window/panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "base/core/error.h"
#include "base/core/luminance.h"
#include "jobs/solve/stages.h"
#include "viewer/window/controls.h"
#include "viewer/window/solver_panel.h"
#include "viewer/window/widgets.h"

namespace lumel {
namespace {

constexpr float kBrightest = 4.0f;  ///< maximum of a lamp's slider, relative to the scene
constexpr float kMinBudget = 1.0f, kMaxBudget = 100.0f;  ///< [ms]
constexpr float kDarkest = 1e-6f, kLightest = 1e3f;      ///< range of manual exposure
constexpr float kDensest = 0.5f, kSparsest = 5.0f;       ///< probe spacing, in strides
constexpr float kTurnStep = 15.0f;                       ///< [degrees]
constexpr float kLowestSun = -10.0f, kZenith = 90.0f, kHalfTurn = 180.0f;  ///< [degrees]
/// Location and date of the sun's path unless the options have them.
constexpr double kLatitude = 50.0, kLongitude = 0.0;  ///< [degrees]
constexpr const char* kDay = "2024-06-21T00:00:00Z";
constexpr double kHour = 3600.0;  ///< [s]
constexpr float kHours = 24.0f;

/// Widget width that leaves room for labels.
constexpr float kNames = -90.0f;

/// Edits brightness and colour of a factor. Returns true on change.
bool edit_factor(glm::vec3& factor)
{
    float bright = std::max({factor.x, factor.y, factor.z});
    glm::vec3 colour = bright > 0.0f ? factor / bright : glm::vec3(1.0f);
    bool changed = ImGui::SliderFloat("times", &bright, 0.0f, kBrightest, "%.2f");
    changed |= ImGui::ColorEdit3("colour", &colour.x, ImGuiColorEditFlags_NoInputs);
    factor = bright * colour;
    return changed;
}

bool show_lamps(ViewSession& session)
{
    bool changed = false;
    for (std::size_t l = 0; l < session.lamps().size(); ++l) {
        const ViewLamp& lamp = session.lamps()[l];
        ImGui::PushID(int(l));
        text(lamp.name.empty() ? "lamp" : lamp.name);
        glm::vec3 factor = lamp.factor;
        if (edit_factor(factor)) {
            session.set_lamp(lamp.name, factor);
            changed = true;
        }
        ImGui::PopID();
    }
    return changed;
}

/// The sun at an hour of the day, at the options' location.
SunPosition sun_at(const ViewSession& session, float hour)
{
    const auto& seen = session.options().lights.sun_seen;
    const double latitude = seen ? seen->latitude : kLatitude,
                 longitude = seen ? seen->longitude : kLongitude;
    const double day =
        seen ? std::floor(seconds_since_2000(seen->time) / (kHours * kHour) + 0.5) - 0.5
             : seconds_since_2000(kDay) / (kHours * kHour);
    return sun_position(glm::radians(latitude), glm::radians(longitude),
                        day * kHours * kHour + double(hour) * kHour);
}

bool show_sun(ViewSession& session)
{
    const SunPosition sun = session.sun().value_or(SunPosition{});
    auto azimuth = float(glm::degrees(sun.azimuth)), elevation = float(glm::degrees(sun.elevation));
    bool changed = ImGui::SliderFloat("azimuth", &azimuth, -kHalfTurn, 2.0f * kHalfTurn, "%.0f");
    changed |= ImGui::SliderFloat("elevation", &elevation, kLowestSun, kZenith, "%.0f");
    if (changed)
        session.set_sun({glm::radians(double(azimuth)), glm::radians(double(elevation))});
    float& hour = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("hour of day"), kHours / 2);
    if (ImGui::SliderFloat("hour", &hour, 0.0f, kHours, "%.1f UTC")) {
        session.set_sun(sun_at(session, hour));
        changed = true;
    }
    return changed;
}

bool show_sky(ViewSession& session)
{
    bool changed = false;
    ImGui::PushID("sky");
    glm::vec3 factor = session.sky();
    if (edit_factor(factor)) {
        session.set_sky(factor);
        changed = true;
    }
    auto angle = float(glm::degrees(session.sky_angle()));
    if (ImGui::SliderFloat("turned", &angle, -kHalfTurn, kHalfTurn, "%.0f")) {
        session.turn_sky(glm::radians(double(angle)));
        changed = true;
    }
    ImGui::PopID();
    return changed;
}

bool show_time(ViewSession& session, UiState& desk)
{
    ImGui::Checkbox("play", &desk.playing);
    auto time = float(session.time());
    if (!ImGui::SliderFloat("time", &time, 0.0f, float(session.animation().duration), "%.2f s"))
        return false;
    session.set_time(double(time));
    return true;
}

bool show_picked(ViewSession& session)
{
    if (!session.picked()) {
        text("click an object to pick it");
        return false;
    }
    const Picked picked = *session.picked();
    const Scene& scene = session.scene();
    const Material& material = scene.materials[std::size_t(picked.material)];
    wrapped(fmt::format("{} ({})", scene.instances[picked.instance].name, material.name));
    if (picked.lumel != kNoLumel) {
        const float percent = session.error_estimate()[picked.lumel];
        text(fmt::format("{:.4g} lx, error {}", luminance(session.irradiance()[picked.lumel]),
                         percent < 0.0f ? "unknown"
                                        : percent_text(double(percent) / 100.0) +
                                              (session.shows_solved() ? " of the mean" : "")));
    }
    bool changed = false;
    glm::vec3 colour(material.base_color);
    if (ImGui::ColorEdit3("paint", &colour.x, ImGuiColorEditFlags_NoInputs)) {
        session.paint(glm::clamp(colour, 0.0f, 1.0f));
        changed = true;
    }
    if (!picked.thing)
        return changed;
    for (const auto& [name, angle] :
         {std::pair("turn left", kTurnStep), {"turn right", -kTurnStep}}) {
        if (ImGui::SmallButton(name)) {
            session.turn(glm::radians(angle));
            changed = true;
        }
        ImGui::SameLine();
    }
    if (ImGui::SmallButton("delete")) {
        session.remove();
        changed = true;
    }
    return changed;
}

/// Edits the grid of light probes; the initial spacing is a stride.
bool show_probes(ViewSession& session, const UiState& desk)
{
    auto spacing = float(session.probe_spacing());
    bool shown = spacing > 0.0f;
    bool changed = ImGui::Checkbox("probes", &shown);
    if (changed)
        spacing = shown ? desk.stride : 0.0f;
    if (shown)
        changed |= ImGui::SliderFloat("spacing", &spacing, kDensest * desk.stride,
                                      kSparsest * desk.stride, "%.2g m");
    if (changed)
        session.set_probes(double(spacing));
    return changed;
}

bool show_mode(ViewSession& session, UiState& desk)
{
    int mode = int(session.mode());
    bool changed = ImGui::Combo("mode", &mode, "light\0lux\0lumels, charts\0links\0error\0");
    session.set_mode(ViewMode(mode));
    bool automatic = session.has_automatic_exposure();
    if (ImGui::Checkbox("automatic exposure", &automatic)) {
        session.set_automatic_exposure(automatic);
        changed = true;
    }
    if (!automatic) {
        float exposure = session.exposure() / std::exp2(session.stops());
        if (ImGui::SliderFloat("exposure", &exposure, kDarkest, kLightest, "%.3g",
                               ImGuiSliderFlags_Logarithmic)) {
            session.set_exposure(exposure);
            changed = true;
        }
    }
    changed |= ImGui::SliderInt("pixel size", &desk.coarse, 1, 4);
    return show_probes(session, desk) || changed;
}

/// Colour scale of a mode, with numbers.
void show_scale(const LuxScale& scale, const char* unit)
{
    constexpr int kSteps = 64;
    constexpr float kTall = 160.0f, kWide = 20.0f, kTick = 5.0f;  // [pixels]
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float line = ImGui::GetTextLineHeight(), bottom = at.y + kTall + 1.5f * line;
    list.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), unit);
    for (int step = 0; step < kSteps; ++step) {
        const glm::vec3 colour = scale_color((double(step) + 0.5) / kSteps);
        const float low = bottom - kTall * float(step) / kSteps, high = low - kTall / kSteps;
        list.AddRectFilled({at.x, high}, {at.x + kWide, low},
                           ImGui::GetColorU32({colour.r, colour.g, colour.b, 1.0f}));
    }
    float last = bottom + line;
    for (const double value : scale.ticks()) {
        const float y = bottom - kTall * float(scale.place_of(value));
        list.AddLine({at.x + kWide, y}, {at.x + kWide + kTick, y},
                     ImGui::GetColorU32(ImGuiCol_Text));
        if (last - y < line)  // would overlap the number below
            continue;
        last = y;
        list.AddText({at.x + kWide + 2.0f * kTick, y - 0.5f * line},
                     ImGui::GetColorU32(ImGuiCol_Text), tick_text(value).c_str());
    }
    ImGui::Dummy({4.0f * kWide, bottom + 0.5f * line - at.y});
}

void show_scale_of_mode(ViewSession& session)
{
    if (session.mode() == ViewMode::irradiance)
        show_scale(session.scale(), "lx");
    else if (session.mode() == ViewMode::error)
        show_scale(session.error_scale(), "%");
}

void show_light(ViewSession& session, UiState& desk)
{
    const LiveLinksState& light = session.light().state();
    const BakedLight* const baked = session.light().baked();
    desk.changed |= show_whose_light(session);
    auto budget = float(session.budget());
    if (ImGui::SliderFloat("light budget", &budget, kMinBudget, kMaxBudget, "%.0f ms"))
        session.set_budget(double(budget));
    text(baked                 ? "baked, estimated error " + percent_text(baked->error)
         : session.is_baking() ? "converged; baking"
         : light.at_rest       ? "converged"
         : light.under_way     ? "updating after a move"
         : light.weighing
             ? "converged; building filter"
             : fmt::format("residual {}, {} sweeps", percent_text(light.residual), light.sweeps));
    text(fmt::format("{} lumels, {} links retraced", session.light().lumels().lumels.size(),
                     light.found.links.all()));
    wrapped(fmt::format("last frame: light {:.1f}, image {:.1f}, window {:.1f} ms", desk.light_ms,
                        desk.picture_ms, desk.window_ms));
    wrapped(desk.draws);
}

void show_files(UiState& desk)
{
    ImGui::InputText("folder", &desk.save_to);
    desk.save |= ImGui::Button("save as a bake");
    ImGui::SameLine();
    desk.shoot |= ImGui::Button("picture");
    ImGui::SameLine();
    if (ImGui::Button("keys"))
        desk.help = !desk.help;
}

bool open(const char* title)
{
    return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

void show_all(ViewSession& session, UiState& desk)
{
    if (open("Picture"))
        desk.changed |= show_mode(session, desk);
    show_scale_of_mode(session);
    if (open("Picked"))
        desk.changed |= show_picked(session);
    if (open("Light"))
        show_light(session, desk);
    if (session.solved() || !desk.solving.empty())
        ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    if (ImGui::CollapsingHeader("Solver"))
        show_solvers(desk);
    if (!session.lamps().empty() && open("Lamps"))
        desk.changed |= show_lamps(session);
    if (session.has_sun() && open("Sun"))
        desk.changed |= show_sun(session);
    if (!session.scene().sky.empty() && open("Sky"))
        desk.changed |= show_sky(session);
    if (session.animation().duration > 0.0 && open("Animation"))
        desk.changed |= show_time(session, desk);
    if (open("Files"))
        show_files(desk);
}

}  // namespace

void show_panel(ViewSession& session, UiState& desk)
{
    ImGui::SetNextWindowPos({float(desk.area.x), 0.0f});
    ImGui::SetNextWindowSize({float(kPanelWidth), ImGui::GetIO().DisplaySize.y});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize);
    ImGui::PushItemWidth(kNames);
    try {
        show_all(session, desk);
    } catch (const Error& error) {
        desk.message = error.what();
    }
    ImGui::PopItemWidth();
    ImGui::End();
}

void show_legend(ViewSession& session)
{
    if (session.mode() != ViewMode::irradiance && session.mode() != ViewMode::error)
        return;
    ImGui::SetNextWindowPos({0.0f, 0.0f}, ImGuiCond_FirstUseEver);
    ImGui::Begin("scale", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    show_scale_of_mode(session);
    ImGui::End();
}

void show_help(UiState& desk)
{
    if (!desk.help)
        return;
    constexpr float kMargin = 10.0f;
    ImGui::SetNextWindowPos({kMargin, kMargin}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.9f);
    ImGui::Begin("keys", &desk.help,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    if (ImGui::BeginTable("list", 2)) {
        for (const KeyHelp& help : key_help()) {
            ImGui::TableNextColumn();
            text(help.keys);
            ImGui::TableNextColumn();
            text(help.meaning);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void show_line(const std::string& line, const UiState& desk)
{
    if (line.empty())
        return;
    ImGui::SetNextWindowPos({0.0f, ImGui::GetIO().DisplaySize.y}, ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {float(desk.area.x), float(desk.area.y)});
    ImGui::Begin("line", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(float(desk.area.x) - 2.0f * ImGui::GetStyle().WindowPadding.x);
    text(line);
    ImGui::PopTextWrapPos();
    ImGui::End();
}

}  // namespace lumel
