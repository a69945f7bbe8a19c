#include "viewer/window/solver_panel.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "jobs/solve/stages.h"
#include "methods/methods.h"
#include "viewer/window/widgets.h"

namespace lumel {
namespace {

constexpr int kAtlasStep = 64, kMaxAtlas = 8192;      ///< [texels]
constexpr float kMinError = 0.1f, kMaxError = 50.0f;  ///< [%]

/// An atlas size of 0 uses the options' density.
void show_links(UiState& desk)
{
    constexpr std::array kOffered = {4, 16, 64, 256};
    int chosen = int(std::find(kOffered.begin(), kOffered.end(), desk.rays) - kOffered.begin());
    if (ImGui::Combo("rays", &chosen, "4\00016\00064\000256\0"))
        desk.rays = kOffered[std::size_t(chosen)];
    if (ImGui::InputInt("atlas", &desk.atlas, kAtlasStep))
        desk.atlas = std::clamp(desk.atlas, 0, kMaxAtlas);
    if (ImGui::InputInt("seed", &desk.seed))
        desk.seed = std::max(desk.seed, 0);
    desk.solve |= ImGui::Button("solve again");
}

/// Selects one of several words. Returns true on change.
template <class Words>
bool choose(const char* label, const Words& words, std::string& chosen)
{
    bool changed = false;
    if (!ImGui::BeginCombo(label, chosen.c_str()))
        return false;
    for (const std::string& word : words)
        if (ImGui::Selectable(word.c_str(), word == chosen)) {
            changed = word != chosen;
            chosen = word;
        }
    ImGui::EndCombo();
    return changed;
}

/// "area|centre"
std::vector<std::string> words_of(std::string type)
{
    std::vector<std::string> words;
    for (std::size_t bar = 0; bar != type.npos;) {
        bar = type.find('|');
        words.push_back(type.substr(0, bar));
        type.erase(0, bar == type.npos ? bar : bar + 1);
    }
    return words;
}

void show_option(const OptionInfo& option, GivenMethod& given, const std::string& standard)
{
    const auto found = given.values.find(option.name);
    std::string value = found == given.values.end() ? standard : found->second;
    if (option.is_number())
        ImGui::InputText(option.name, &value);
    else
        choose(option.name, words_of(option.type()), value);
    if (value == standard)
        given.values.erase(option.name);
    else
        given.values[option.name] = value;
}

/// Hides options without effect.
void show_options(GivenMethod& given)
{
    const MethodInfo& method = method_of(given.id);
    const MethodOptions defaults = method.defaults();
    for (const OptionInfo& option : method.options) {
        if (option.with) {
            const auto found = given.values.find(option.with);
            const std::string other = found == given.values.end()
                                          ? get_option(defaults, *method.option(option.with))
                                          : found->second;
            if (other != option.with_value) {
                given.values.erase(option.name);
                continue;
            }
        }
        show_option(option, given, get_option(defaults, option));
    }
}

void show_methods(UiState& desk)
{
    std::vector<std::string> ids;
    for (const MethodInfo& method : methods())
        ids.emplace_back(method.id);
    if (choose("method", ids, desk.method.id))
        desk.method.values.clear();
    show_options(desk.method);
    ImGui::SliderFloat("error", &desk.error, kMinError, kMaxError, "%.1f %%",
                       ImGuiSliderFlags_Logarithmic);
    if (desk.solving.empty()) {
        desk.solve_by |= ImGui::Button(fmt::format("solve by {}", desk.method.id).c_str());
        return;
    }
    ImGui::ProgressBar(desk.solved_part);
    desk.stop |= ImGui::Button("stop");
    wrapped(desk.solving);
}

}  // namespace

bool show_whose_light(ViewSession& session)
{
    if (!session.solved())
        return false;
    const SolvedLight& light = *session.solved();
    const char* const id = method_of(light.options.method).id;
    const bool solved = session.shows_solved();
    const bool to_links = ImGui::RadioButton("links", !solved) && solved;
    ImGui::SameLine();
    const bool to_solved = ImGui::RadioButton(fmt::format("by {}", id).c_str(), solved) && !solved;
    wrapped(fmt::format(
        "{}{} took {:.1f} s, {}", id, light.stopped ? " (stopped early)" : "", light.seconds,
        light.error < 0.0 ? "error unknown" : "estimated error " + percent_text(light.error)));
    if (solved)
        wrapped("links are updated meanwhile; the next edit shows them");
    if (to_links || to_solved)
        session.show_solved(to_solved);
    return to_links || to_solved;
}

void show_solvers(UiState& desk)
{
    ImGui::PushID("links");
    show_links(desk);
    ImGui::PopID();
    ImGui::Separator();
    ImGui::PushID("methods");
    show_methods(desk);
    ImGui::PopID();
}

}  // namespace lumel
