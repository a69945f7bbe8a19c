#pragma once
// Form factors between the patches of a simplified scene. See form_factors.cpp.

#include <functional>
#include <span>
#include <vector>

#include "atlas/near/near_field.h"
#include "gpu/pacer.h"
#include "raster/eyes/eye_views.h"
#include "raster/eyes/view_options.h"
#include "solve/matrix/color_matrix.h"
#include "solve/solver/solve_size.h"
#include "solve/transport/form_factors.look.comp.h"
#include "solve/transport/form_factors.receive.comp.h"
#include "solve/transport/form_factors.shared.h"
#include "solve/transport/patch_shots.shared.h"
#include "solve/transport/patches.h"
#include "solve/transport/voxel_patches.h"

namespace lumel {

/// Errors of the form factors before balancing.
struct FormFactorCheck {
    double reciprocity = 0.0;  ///< Σ |A_i F_ij - A_j F_ji| / Σ A_i F_ij
    double row_sum = 0.0;      ///< RMS of Σ_j F_ij - 1 over closed rows
    double worst_row_sum = 0.0;
    std::size_t closed = 0;  ///< rows that must add up to 1
};

/// Makes A_i F_ij = A_j F_ji, and closed rows [n] sum to 1; others keep their sums, at most 1.
/// area: [n].
FormFactorCheck balance(SquareMatrix& form_factors, std::span<const float> area,
                        std::span<const char> closed);

/// Computes form factors by batches of hemicubes, patch by patch.
class FormFactors {
public:
    /// Receives the irradiance [N] [lx] of all lumels if the radiosity of `patch` is 1 lm/m².
    using Column = std::function<void(std::uint32_t patch, std::span<const float> received)>;

    /// patches must outlive this.
    FormFactors(const gpu::Device& device, const World& world, const Lumels& lumels,
                const NearField& near, const VoxelPatches& patches, const ViewOptions& options);

    /// GPU memory [bytes], without blocks of patches, if the device's image sizes do not limit
    /// batches.
    static std::uint64_t device_bytes(const SolveSize& size, const ViewOptions& options);

    bool done() const { return next_ == blocks_.size(); }
    double fraction() const { return double(next_) / double(blocks_.size()); }  ///< done, 0…1
    /// Shoots the next batch; calls `take` for each patch that it completes.
    void step(const Column& take);

    /// [n][n] F_ij of the patches completed so far: irradiance of i per radiosity of j.
    const SquareMatrix& matrix() const { return matrix_; }
    SquareMatrix take_matrix() { return std::move(matrix_); }
    std::uint64_t shots() const { return next_; }
    const gpu::StageTimes& times() const { return pacer_.times(); }
    double longest_submission() const { return pacer_.longest_ms(); }

private:
    struct NearColumns {
        std::vector<std::size_t> first;    ///< [n + 1]
        std::vector<std::uint32_t> lumel;  ///< [nnz] receivers
        std::vector<float> factor;         ///< [nnz]
    };

    std::uint32_t batch_end() const;
    std::vector<std::uint32_t> columns_of_blocks() const;
    void shoot(std::uint32_t last);
    void complete(std::uint32_t patch, std::vector<float>& received, const Column& take);
    NearColumns near_columns(const NearField& near) const;

    const World* world_;
    const VoxelPatches* patches_;
    std::vector<float> lumel_area_;  ///< [N]
    std::uint32_t count_;            ///< N
    float near_radius_;
    NearColumns near_;
    std::vector<Patch> blocks_;  ///< in order of their patches
    std::uint32_t next_ = 0;     ///< block
    SquareMatrix matrix_;

    gpu::Kernel<shaders::FormFactorsLook> look_;
    gpu::Kernel<shaders::FormFactorsReceive> receive_;
    EyeViews views_;
    gpu::Array<Patch> block_array_;
    std::vector<std::uint32_t> column_of_;  ///< [blocks] of `received_`
    gpu::Array<std::uint32_t> columns_;     ///< column_of_ on the GPU
    gpu::Array<Eye> eyes_;                  ///< [K]
    gpu::Array<PatchShot> shots_;           ///< [K]
    gpu::Array<glm::vec3> sending_;         ///< [N] 1
    gpu::Array<float> received_;            ///< [K][N]
    std::vector<float> open_column_;        ///< [N] of a patch that the last batch left incomplete
    gpu::Pacer pacer_;  ///< last member: its destructor waits for work that uses others
};

}  // namespace lumel
