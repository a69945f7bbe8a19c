// With D_s the direct light of source s, f_s its factor, P the mean of the light that patches
// reflect:
//
//     H = Σ_s f_s (D_s + S_s) + R color (x + M x),     x = Σ_s f_s (P D_s),
//
// R the rows of the lumels. Sources with stored reflected light S_s are left out of x. All but the
// first sum is computed on the device.

#include "methods/matrix/relight_session.h"

#include <algorithm>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "base/json/json_view.h"
#include "methods/matrix/last_bounce.shared.h"
#include "methods/matrix/matrix_file.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// States per product, which share a read of the matrix.
constexpr std::uint32_t kStatesAtOnce = kLastBounceStates;
constexpr std::size_t kLumelsPerTask = 4096;

SourceNames names_of(const Relightable& light)
{
    std::vector<SourceNames::Source> sources;
    for (const SourceLight& source : light.sources)
        sources.push_back({source.name, source.materials});
    return SourceNames(std::move(sources));
}

/// Adds a source's light, without its part by the matrix, to lumels [first, last).
void add_scaled(std::vector<glm::vec3>& light, const SourceLight& source, const glm::vec3& factor,
                std::size_t first, std::size_t last)
{
    for (std::size_t i = first; i < last; ++i)
        light[i] += factor * source.direct[i];
    if (!source.reflected.empty())
        for (std::size_t i = first; i < last; ++i)
            light[i] += factor * source.reflected[i];
}

}  // namespace

RelightSession::RelightSession(const gpu::Device& device, Relightable light)
    : device_(&device),
      light_(std::move(light)),
      names_(names_of(light_)),
      now_{.factors = Factors(light_.sources.size(), glm::vec3(1.0f))}
{
    const std::size_t patches = light_.patches.size();
    if (patches == 0)
        return;
    for (const SourceLight& source : light_.sources)
        means_.push_back(source.reflected.empty() ? light_.patches.reflected_means(
                                                        light_.area, light_.albedo, source.direct)
                                                  : std::vector<glm::vec3>(patches));
    std::vector<glm::vec3> color;
    for (const VoxelPatch& patch : light_.patches.patches)
        color.push_back(patch.color);
    multiply_.emplace(device, light_.matrix, kStatesAtOnce);
    last_bounce_.emplace(device);
    first_.emplace(device, view(light_.rows.first), "relight.first");
    entries_.emplace(device, view(light_.rows.entry), "relight.entries");
    color_.emplace(device, view(color), "relight.color");
    direct_.emplace(device, kStatesAtOnce * patches, "relight.direct");
    reflected_.emplace(device, kStatesAtOnce * patches, "relight.reflected");
    result_.emplace(device, kStatesAtOnce * size(), "relight.result");
}

RelightSession::RelightSession(const gpu::Device& device, const std::string& path)
    : RelightSession(device, read_relightable(path))
{
}

void RelightSession::set_light(const std::string& name, const glm::vec3& factor)
{
    check_factor(name, factor);
    for (const std::size_t s : names_.of(name))
        now_.factors[s] = factor;
}

/// A source's lamp at another place. Throws if it cannot be there.
PunctualLight RelightSession::lamp_at(std::size_t source, const LampPlace& place) const
{
    const SourceLight& of = light_.sources[source];
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorKind::input, "", lumel::quoted(of.name) + " " + what);
    };
    if (!world_)
        refuse("cannot be moved without the scene that was baked");
    if (place.turn)
        refuse("can only be turned with stored links; bake the scene with --keep-links");
    if (of.lights.size() != 1)
        refuse(of.lights.empty()
                   ? "is not a lamp: only point, spot and directional lights can be moved"
                   : "is the name of several lamps: give each its own name to move it");
    if (!of.reflected.empty())
        refuse("is the name of a lamp and of surfaces: give the lamp its own name to move it");
    PunctualLight lamp = of.lights.front();
    lamp.name = of.name;
    return placed(std::move(lamp), place, light_.origin);
}

/// The source of a lamp of this name. Throws if it cannot be at the place.
std::size_t RelightSession::lamp_of(const std::string& name, const LampPlace& place) const
{
    const std::size_t source = names_.of(name).front();
    lamp_at(source, place);
    return source;
}

RelightSession::Moved RelightSession::moved(std::size_t source, const LampPlace& place) const
{
    Scene lamps;
    lamps.profiles = light_.profiles;
    lamps.lights = {lamp_at(source, place)};
    const DirectLight found =
        direct_light(*device_, world_->world, lamps, world_->lumels, world_->options);
    Moved result{.source = source, .direct = std::vector<glm::vec3>(size()), .mean = {}};
    for (std::size_t i = 0; i < found.irradiance.size(); ++i)
        if (world_->number[i] != kNoLumel)
            result.direct[world_->number[i]] = found.irradiance[i];
    if (multiply_)
        result.mean = light_.patches.reflected_means(light_.area, light_.albedo, result.direct);
    return result;
}

void RelightSession::move_light(const std::string& name, const LampPlace& place)
{
    to_move_[lamp_of(name, place)] = place;
}

void RelightSession::check(const LightState& state) const
{
    names_.factors(state);
    for (const auto& [name, place] : state.places)
        lamp_of(name, place);
}

RelightSession::State RelightSession::state_of(const LightState& state) const
{
    State result{.factors = names_.factors(state), .moved = {}};
    for (const auto& [name, place] : state.places)
        result.moved.push_back(moved(lamp_of(name, place), place));
    return result;
}

std::vector<glm::vec3> RelightSession::irradiance()
{
    for (const auto& [source, place] : to_move_) {
        std::erase_if(now_.moved,
                      [of = source](const Moved& before) { return before.source == of; });
        now_.moved.push_back(moved(source, place));
    }
    to_move_.clear();
    return std::move(irradiance_of(std::span(&now_, 1)).front());
}

std::vector<std::vector<glm::vec3>> RelightSession::irradiance(std::span<const LightState> states)
{
    std::vector<State> found;
    for (const LightState& state : states)
        found.push_back(state_of(state));
    return irradiance_of(found);
}

std::vector<std::vector<glm::vec3>> RelightSession::irradiance_of(std::span<const State> states)
{
    std::vector<std::vector<glm::vec3>> maps;
    for (std::size_t first = 0; first < states.size(); first += kStatesAtOnce) {
        const std::size_t count = std::min<std::size_t>(kStatesAtOnce, states.size() - first);
        const std::span<const State> some = states.subspan(first, count);
        const std::vector<glm::vec3> onward = reflected(some);
        for (std::size_t i = 0; i < count; ++i)
            maps.push_back(with_direct(some[i], std::span(onward).subspan(i * size(), size())));
    }
    return maps;
}

/// Null if the source's lamp has its baked place.
const RelightSession::Moved* RelightSession::moved_of(const State& state, std::size_t source)
{
    for (const Moved& moved : state.moved)
        if (moved.source == source)
            return &moved;
    return nullptr;
}

/// R color (x + M x): [states][N]
std::vector<glm::vec3> RelightSession::reflected(std::span<const State> states)
{
    if (!multiply_)
        return std::vector<glm::vec3>(states.size() * size(), glm::vec3(0.0f));
    const std::size_t patches = light_.patches.size();
    std::vector<glm::vec3> direct(kStatesAtOnce * patches, glm::vec3(0.0f));
    for (std::size_t i = 0; i < states.size(); ++i)
        for (std::size_t s = 0; s < means_.size(); ++s) {
            const Moved* moved = moved_of(states[i], s);
            const std::vector<glm::vec3>& mean = moved ? moved->mean : means_[s];
            for (std::size_t p = 0; p < patches; ++p)
                direct[i * patches + p] += states[i].factors[s] * mean[p];
        }
    direct_->upload(direct);
    gpu::Commands commands(*device_);
    multiply_->record(commands, *direct_, *reflected_, std::uint32_t(states.size()));
    commands.dispatch(*last_bounce_,
                      {.first = *first_,
                       .entries = *entries_,
                       .color = *color_,
                       .direct = *direct_,
                       .reflected = *reflected_,
                       .result = *result_},
                      LastBounceParams{.lumels = std::uint32_t(size()),
                                       .patches = std::uint32_t(patches),
                                       .states = std::uint32_t(states.size())},
                      std::uint32_t(size()));
    commands.run();
    return result_->download();
}

std::vector<glm::vec3> RelightSession::with_direct(const State& state,
                                                   std::span<const glm::vec3> reflected) const
{
    std::vector<glm::vec3> light(reflected.begin(), reflected.end());
    parallel_for(size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = 0; s < state.factors.size(); ++s) {
            if (state.factors[s] == glm::vec3(0.0f))
                continue;
            if (const Moved* moved = moved_of(state, s))
                for (std::size_t i = first; i < last; ++i)
                    light[i] += state.factors[s] * moved->direct[i];
            else
                add_scaled(light, light_.sources[s], state.factors[s], first, last);
        }
    });
    return light;
}

}  // namespace lumel
