#include "scene/values/view.h"

#include <algorithm>
#include <cmath>

namespace lumel {

Ray ray_through(const View& view, const glm::vec2& place)
{
    const glm::vec2 offset(view.aspect * (2.0f * place.x - 1.0f), 1.0f - 2.0f * place.y);
    glm::vec3 origin(0.0f), direction(0.0f, 0.0f, -1.0f);
    if (view.orthographic_height > 0.0f)
        origin = glm::vec3(0.5f * view.orthographic_height * offset, 0.0f);
    else
        direction = glm::vec3(std::tan(0.5f * view.vertical_fov) * offset, -1.0f);
    return {glm::vec3(view.transform * glm::vec4(origin, 1.0f)),
            glm::normalize(glm::mat3(view.transform) * direction)};
}

int picture_height(int width, float aspect, int most)
{
    return int(std::clamp(std::round(float(width) / aspect), 1.0f, float(most)));
}

}  // namespace lumel
