#include "results/preview/background.h"

#include "base/images/image_files.h"

namespace lumel {

void put_sky_behind(Image& picture, const Sky& sky, const View& view, float exposure)
{
    if (sky.empty())
        return;
    Image behind(picture.width, picture.height, 4);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            if (picture.at(x, y)[3] >= 1.0f)
                continue;
            const glm::vec2 place((float(x) + 0.5f) / float(picture.width),
                                  (float(y) + 0.5f) / float(picture.height));
            const glm::vec3 radiance = sky_radiance(sky, ray_through(view, place).direction);
            for (int c = 0; c < 3; ++c)
                behind.at(x, y)[c] = radiance[c];
        }
    const Image shown = tone_map(behind, exposure);
    for (std::size_t i = 0; i < picture.values.size(); i += 4) {
        const float covered = picture.values[i + 3];
        for (std::size_t c = 0; c < 3; ++c)
            picture.values[i + c] =
                covered * picture.values[i + c] + (1.0f - covered) * shown.values[i + c];
        picture.values[i + 3] = 1.0f;
    }
}

}  // namespace lumel
