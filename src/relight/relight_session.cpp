// With D_s the direct light of source s, f_s its factor, P the mean over patches:
//
//     H = Σ_s f_s D_s + W M Σ_s f_s (P D_s),     W: from patches to lumels.

#include "relight/relight_session.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "relight/matrix_file.h"
#include "json/json_view.h"

namespace lumel {
namespace {

/// That share what is read of the matrix.
constexpr std::uint32_t kStatesAtOnce = 16;
/// Lumels worth a task of their own.
constexpr std::size_t kLumelsPerTask = 4096;

void check_factor(const std::string& name, const glm::vec3& factor)
{
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(factor[c]) || factor[c] < 0.0f)
            throw Error(ErrorKind::input, "",
                        "the factor of " + lumel::quoted(name) + " is not a number of 0 or more");
}

bool contains(const std::vector<std::string>& list, const std::string& value)
{
    return std::find(list.begin(), list.end(), value) != list.end();
}

std::string list_of(const std::vector<std::string>& names)
{
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + lumel::quoted(name);
    return list;
}

}  // namespace

RelightSession::RelightSession(const gpu::Device& device, Relightable light)
    : device_(&device),
      light_(std::move(light)),
      factors_(light_.sources.size(), glm::vec3(1.0f))
{
    const std::size_t patches = light_.patches.size();
    if (patches == 0)
        return;
    for (const SourceLight& source : light_.sources)
        means_.push_back(light_.patches.means(light_.area, source.direct));
    multiply_.emplace(device, light_.matrix, kStatesAtOnce);
    direct_.emplace(device, kStatesAtOnce * patches, "relight.direct");
    reflected_.emplace(device, kStatesAtOnce * patches, "relight.reflected");
}

RelightSession::RelightSession(const gpu::Device& device, const std::string& path)
    : RelightSession(device, read_relightable(path))
{
}

std::vector<std::string> RelightSession::names() const
{
    std::vector<std::string> names;
    for (const SourceLight& source : light_.sources)
        names.push_back(source.name);
    return names;
}

std::vector<std::size_t> RelightSession::sources_of(const std::string& name) const
{
    std::vector<std::size_t> named, shining;
    for (std::size_t s = 0; s < light_.sources.size(); ++s) {
        if (light_.sources[s].name == name)
            named.push_back(s);
        if (contains(light_.sources[s].materials, name))
            shining.push_back(s);
    }
    if (named.empty() && shining.empty())
        throw Error(ErrorKind::input, "",
                    "there is no light " + lumel::quoted(name) + "; there are " +
                        (names().empty() ? "none at all" : list_of(names())));
    return named.empty() ? shining : named;
}

void RelightSession::set_light(const std::string& name, const glm::vec3& factor)
{
    check_factor(name, factor);
    for (const std::size_t s : sources_of(name))
        factors_[s] = factor;
}

RelightSession::Factors RelightSession::factors_of(const LightState& state) const
{
    check_factor("others", state.others);
    Factors factors(light_.sources.size(), state.others);
    std::vector<std::string> set_by(factors.size());
    for (const auto& [name, factor] : state.lights) {
        check_factor(name, factor);
        for (const std::size_t s : sources_of(name)) {
            if (!set_by[s].empty())
                throw Error(ErrorKind::input, "",
                            lumel::quoted(set_by[s]) + " and " + lumel::quoted(name) +
                                " are the same light");
            set_by[s] = name;
            factors[s] = factor;
        }
    }
    return factors;
}

std::vector<glm::vec3> RelightSession::irradiance()
{
    return std::move(irradiance_of(std::span(&factors_, 1)).front());
}

std::vector<std::vector<glm::vec3>> RelightSession::irradiance(std::span<const LightState> states)
{
    std::vector<Factors> factors;
    for (const LightState& state : states)
        factors.push_back(factors_of(state));
    return irradiance_of(factors);
}

std::vector<std::vector<glm::vec3>> RelightSession::irradiance_of(std::span<const Factors> states)
{
    std::vector<std::vector<glm::vec3>> maps;
    for (std::size_t first = 0; first < states.size(); first += kStatesAtOnce) {
        const std::size_t count = std::min<std::size_t>(kStatesAtOnce, states.size() - first);
        const std::span<const Factors> some = states.subspan(first, count);
        const std::vector<glm::vec3> onward = reflected(some);
        const std::size_t patches = light_.patches.size();
        for (std::size_t i = 0; i < count; ++i)
            maps.push_back(sum_at_lumels(some[i], std::span(onward).subspan(i * patches, patches)));
    }
    return maps;
}

/// M Σ_s f_s (P D_s): [states][n]
std::vector<glm::vec3> RelightSession::reflected(std::span<const Factors> states)
{
    if (!multiply_)
        return {};
    const std::size_t patches = light_.patches.size();
    std::vector<glm::vec3> direct(kStatesAtOnce * patches, glm::vec3(0.0f));
    for (std::size_t i = 0; i < states.size(); ++i)
        for (std::size_t s = 0; s < means_.size(); ++s)
            for (std::size_t p = 0; p < patches; ++p)
                direct[i * patches + p] += states[i][s] * means_[s][p];
    direct_->upload(direct);
    gpu::Commands commands(*device_);
    multiply_->record(commands, *direct_, *reflected_, std::uint32_t(states.size()));
    commands.run();
    return reflected_->download();
}

std::vector<glm::vec3> RelightSession::sum_at_lumels(const Factors& factors,
                                                     std::span<const glm::vec3> reflected) const
{
    std::vector<glm::vec3> light =
        multiply_ ? light_.transfer.apply(reflected) : std::vector<glm::vec3>(size());
    parallel_for(size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = 0; s < factors.size(); ++s)
            if (factors[s] != glm::vec3(0.0f))
                for (std::size_t i = first; i < last; ++i)
                    light[i] += factors[s] * light_.sources[s].direct[i];
    });
    return light;
}

}  // namespace lumel
