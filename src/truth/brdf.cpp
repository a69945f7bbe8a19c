#include "truth/brdf.h"

#include <algorithm>
#include <cmath>

#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "rays/paths/directions.h"

namespace lumel {

namespace {

/// Unit direction with density cosθ / π about `normal`.
glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& at)
{
    const glm::vec2 disc = square_to_disc(at);
    return turn_to(normal, disc.x, disc.y, std::sqrt(std::max(0.0f, 1.0f - glm::dot(disc, disc))));
}

/// Unit direction with density (n + 1) / 2π cosⁿ about `mirror`.
glm::vec3 lobe_direction(const glm::vec3& mirror, float shininess, const glm::vec2& at)
{
    const float cosine = std::pow(at.x, 1.0f / (shininess + 1.0f));
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const float angle = 2.0f * kPi * at.y;
    return turn_to(mirror, sine * std::cos(angle), sine * std::sin(angle), cosine);
}

}  // namespace

Brdf::Brdf(const Reflectance& look, const glm::vec3& normal, const glm::vec3& toward)
    : normal_(normal),
      mirror_(2.0f * glm::dot(normal, toward) * normal - toward),
      reflectance_(look.diffuse + look.specular),
      gloss_(0.0f),
      shininess_(look.shininess),
      cos_toward_(glm::dot(normal, toward)),
      chance_(0.0f)
{
    for (int c = 0; c < 3; ++c)
        if (look.specular[c] > 0.0f)
            gloss_[c] = look.specular[c] / reflectance_[c];
    // No lobe if the interpolated normal faces away from the outgoing direction.
    if (cos_toward_ > 0.0f && sum_of(look.specular) > 0.0f)
        chance_ = sum_of(look.specular) / sum_of(reflectance_);
}

Brdf::Response Brdf::respond(const glm::vec3& incoming) const
{
    const float cos_in = glm::dot(normal_, incoming);
    Response response{1.0f - gloss_, cos_in / kPi};
    if (chance_ > 0.0f) {
        const float along = std::max(0.0f, glm::dot(mirror_, incoming));
        const float lobe = (shininess_ + 1.0f) / (2.0f * kPi) * std::pow(along, shininess_);
        response.shape += gloss_ * (kPi * lobe / std::max(cos_in, cos_toward_));
        response.density = (1.0f - chance_) * response.density + chance_ * lobe;
    }
    return response;
}

glm::vec3 Brdf::sample(glm::vec2 at) const
{
    // Selects a component, and rescales the number to 0…1.
    if (at.x < chance_) {
        at.x /= chance_;
        return lobe_direction(mirror_, shininess_, at);
    }
    at.x = (at.x - chance_) / (1.0f - chance_);
    return cosine_direction(normal_, at);
}

}  // namespace lumel
