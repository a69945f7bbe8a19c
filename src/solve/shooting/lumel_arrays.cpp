#include "solve/shooting/lumel_arrays.h"

#include <algorithm>

namespace lumel {

std::vector<glm::vec4> surfaces_of(const Lumels& lumels)
{
    std::vector<glm::vec4> surfaces;
    for (const Lumel& lumel : lumels.lumels)
        surfaces.emplace_back(lumel.albedo, (lumel.flags & kLumelBuried) ? 0.0f : lumel.area);
    return surfaces;
}

std::vector<glm::vec3> emission_of(const Lumels& lumels)
{
    std::vector<glm::vec3> emission;
    for (const Lumel& lumel : lumels.lumels)
        emission.push_back((lumel.flags & kLumelBuried) ? glm::vec3(0.0f) : lumel.emission);
    return emission;
}

Lumels black(Lumels lumels)
{
    for (Lumel& lumel : lumels.lumels)
        lumel.albedo = glm::vec3(0.0f);
    for (Gloss& gloss : lumels.gloss)
        gloss.diffuse = gloss.specular = glm::vec3(0.0f);
    return lumels;
}

float reflecting_area(const Lumels& lumels)
{
    float sum = 0.0f;
    for (const Lumel& lumel : lumels.lumels)
        if (!(lumel.flags & kLumelBuried) &&
            std::max({lumel.albedo.r, lumel.albedo.g, lumel.albedo.b}) > 0.0f)
            sum += lumel.area;
    return sum;
}

float emissive_share(const Lumels& lumels, std::span<const glm::vec3> known)
{
    constexpr float kRounding = 1e-4f;  // where the emission is reflected light
    float shines = 0.0f, all = 0.0f;
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        if (lumel.flags & kLumelBuried)
            continue;
        const glm::vec3 reflected = known.empty() ? glm::vec3(0.0f) : lumel.albedo * known[i];
        if (luminance(lumel.emission - reflected) > kRounding * luminance(lumel.emission))
            shines += lumel.area;
        all += lumel.area;
    }
    return all > 0.0f ? shines / all : 0.0f;
}

double emitted_power(const Lumels& lumels, std::span<const glm::vec3> emission)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < emission.size(); ++i)
        sum += luminance(emission[i]) * double(lumels.lumels[i].area);
    return sum;
}

double irradiance_sum(std::span<const glm::vec3> irradiance)
{
    double sum = 0.0;
    for (const glm::vec3& h : irradiance)
        sum += double(h.r) + double(h.g) + double(h.b);
    return sum;
}

void add_light(std::vector<glm::vec3>& sum, std::span<const glm::vec3> more)
{
    for (std::size_t i = 0; i < more.size(); ++i)
        sum[i] += more[i];
}

}  // namespace lumel
