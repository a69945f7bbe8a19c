// Form factors of all reflections [SF17], used by solve/matrix and methods/matrix. Equations:
// methods/matrix/matrix.cpp.

#include "solve/transport/transport.h"

#include "solve/matrix/bounces.h"

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

}  // namespace

std::vector<glm::vec3> Transport::indirect(const Lumels& lumels,
                                           std::span<const glm::vec3> direct) const
{
    const std::vector<glm::vec3> arrived = patches.reflected_means(lumels, direct);
    return rows.apply(sent_by(patches, arrived, multiply(bounces, arrived)));
}

TransportBuilder::TransportBuilder(const gpu::Device& device, const World& world,
                                   const Lumels& lumels, const NearField& near,
                                   const TransportOptions& options)
    : lumels_(&lumels),
      around_(near.around),
      bounces_(options.bounces > 0 ? options.bounces - 1 : kAllBounces),
      patches_(make_voxel_patches(world, lumels, around_, options.patches)),
      factors_(device, world, lumels, near, patches_, options.views),
      rows_(lumels.lumels.size(), patches_.size())
{
}

void TransportBuilder::step()
{
    factors_.step([&](std::uint32_t, std::span<const float> received) { rows_.add(received); });
}

Transport TransportBuilder::finish()
{
    Transport result;
    result.form_factors = factors_.take_matrix();
    result.check = balance(result.form_factors, each_patch(patches_, &VoxelPatch::area),
                           closed_patches(patches_, around_.open));
    result.rows = rows_.finish(closed_lumels(lumels_->lumels.size(), around_.open));
    result.bounces = lumel::bounces(
        color_matrix(result.form_factors, each_patch(patches_, &VoxelPatch::color)), bounces_);
    result.patches = std::move(patches_);
    return result;
}

}  // namespace lumel
