#include "bench/cut.h"

namespace lumel::bench {
namespace {

/// Appends values at the grid points of every triangle, row by row from its first corner.
template <class T>
std::vector<T> spread(const std::vector<T>& values, const std::vector<std::uint32_t>& indices,
                      int pieces)
{
    std::vector<T> out;
    for (std::size_t k = 0; !values.empty() && k + 2 < indices.size(); k += 3) {
        const T &a = values[indices[k]], &b = values[indices[k + 1]], &c = values[indices[k + 2]];
        for (int row = 0; row <= pieces; ++row)
            for (int i = 0; i <= row; ++i)
                out.push_back((a * float(pieces - row) + b * float(row - i) + c * float(i)) /
                              float(pieces));
    }
    return out;
}

std::vector<std::uint32_t> grid_indices(std::size_t triangles, int pieces)
{
    std::vector<std::uint32_t> indices;
    const auto points = std::uint32_t((pieces + 1) * (pieces + 2) / 2);
    for (std::uint32_t t = 0; t < triangles; ++t)
        for (int row = 0; row < pieces; ++row) {
            const std::uint32_t above = t * points + std::uint32_t(row * (row + 1) / 2);
            const std::uint32_t below = above + std::uint32_t(row) + 1;
            for (std::uint32_t i = 0; i <= std::uint32_t(row); ++i) {
                indices.insert(indices.end(), {above + i, below + i, below + i + 1});
                if (i < std::uint32_t(row))
                    indices.insert(indices.end(), {above + i, below + i + 1, above + i + 1});
            }
        }
    return indices;
}

}  // namespace

Scene cut(Scene scene, int pieces)
{
    for (Mesh& mesh : scene.meshes)
        for (Primitive& p : mesh.primitives) {
            const std::vector<std::uint32_t> corners = p.indices;
            p.positions = spread(p.positions, corners, pieces);
            p.colors = spread(p.colors, corners, pieces);
            for (auto& texcoords : p.texcoords)
                texcoords = spread(texcoords, corners, pieces);
            p.normals.clear();
            p.indices = grid_indices(corners.size() / 3, pieces);
        }
    return scene;
}

}  // namespace lumel::bench
