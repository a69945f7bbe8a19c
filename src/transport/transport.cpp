// Form factors of all reflections [SF17]: what solve/matrix and relight build on. Equations as in
// solve/matrix.cpp.

#include "transport/transport.h"

#include "matrix/bounces.h"

namespace lumel {
namespace {

/// [n] 1 for patches without an open lumel.
std::vector<char> closed_patches(const VoxelPatches& patches, std::span<const char> open)
{
    std::vector<char> closed(patches.size(), open.empty() ? 0 : 1);
    for (std::size_t i = 0; i < open.size(); ++i)
        if (open[i] && patches.patch_of[i] != kPatchless)
            closed[patches.patch_of[i]] = 0;
    return closed;
}

std::vector<char> closed_lumels(std::size_t count, std::span<const char> open)
{
    std::vector<char> closed(count, 0);
    for (std::size_t i = 0; i < open.size(); ++i)
        closed[i] = open[i] ? 0 : 1;
    return closed;
}

template <class Field>
auto each_patch(const VoxelPatches& patches, Field field)
{
    std::vector<std::decay_t<decltype(std::declval<VoxelPatch>().*field)>> values;
    for (const VoxelPatch& patch : patches.patches)
        values.push_back(patch.*field);
    return values;
}

std::vector<float> sums_of_rows(const SquareMatrix& matrix)
{
    std::vector<float> sums;
    for (std::size_t row = 0; row < matrix.size; ++row) {
        double sum = 0.0;
        for (std::size_t column = 0; column < matrix.size; ++column)
            sum += double(matrix.values[row * matrix.size + column]);
        sums.push_back(float(sum));
    }
    return sums;
}

}  // namespace

std::vector<glm::vec3> Transport::indirect(const Lumels& lumels,
                                           std::span<const glm::vec3> direct) const
{
    return transfer.apply(multiply(bounces, patches.means(lumels, direct)));
}

TransportBuilder::TransportBuilder(const gpu::Device& device, const World& world,
                                   const Lumels& lumels, const NearField& near,
                                   const TransportOptions& options)
    : lumels_(&lumels),
      around_(near.around),
      bounces_(options.bounces > 0 ? options.bounces : kAllBounces),
      patches_(make_voxel_patches(world, lumels, around_, options.patches)),
      factors_(device, world, lumels, near, patches_, options.views),
      fit_(world, lumels, patches_)
{
}

void TransportBuilder::step()
{
    factors_.step([&](std::uint32_t patch, std::span<const float> received) {
        const SquareMatrix& matrix = factors_.matrix();
        std::vector<float> column;
        for (std::uint32_t row = 0; row < matrix.size; ++row)
            column.push_back(matrix.at(row, patch));
        fit_.add(received, column);
    });
}

Transport TransportBuilder::finish()
{
    Transport result;
    const SquareMatrix found = factors_.matrix();
    result.form_factors = factors_.take_matrix();
    result.check = balance(result.form_factors, each_patch(patches_, &VoxelPatch::area),
                           closed_patches(patches_, around_.open));
    result.transfer = fit_.fit(found, sums_of_rows(result.form_factors),
                               closed_lumels(lumels_->lumels.size(), around_.open));
    result.bounces = lumel::bounces(
        color_matrix(result.form_factors, each_patch(patches_, &VoxelPatch::color)), bounces_);
    result.patches = std::move(patches_);
    return result;
}

}  // namespace lumel
