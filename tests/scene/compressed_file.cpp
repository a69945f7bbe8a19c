#include "compressed_file.h"

#include <cmath>

namespace lumel::test {

Wave::Wave()
{
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::vec2 at(float(x) / (kSide - 1), float(y) / (kSide - 1));
            positions.emplace_back(at.x, 0.3f * std::sin(5.0f * at.x) * at.y, at.y);
            normals.push_back(glm::normalize(glm::vec3(-1.5f * std::cos(5.0f * at.x) * at.y, 1.0f,
                                                       -0.3f * std::sin(5.0f * at.x))));
            texcoords.push_back(at * 0.5f);
        }
    for (int y = 0; y + 1 < kSide; ++y)
        for (int x = 0; x + 1 < kSide; ++x) {
            const int first = y * kSide + x;
            for (const int corner :
                 {first, first + kSide, first + 1, first + 1, first + kSide, first + kSide + 1})
                indices.push_back(std::uint16_t(corner));
        }
}

Json wave_primitive()
{
    return {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}, {"indices", 3}};
}

GltfBuilder Wave::plain() const
{
    GltfBuilder builder;
    builder.add_positions(positions);
    builder.add_accessor(normals, "VEC3", 5126, normals.size());
    builder.add_accessor(texcoords, "VEC2", 5126, texcoords.size());
    builder.add_accessor(indices, "SCALAR", 5123, indices.size());
    builder.show(wave_primitive());
    return builder;
}

}  // namespace lumel::test
