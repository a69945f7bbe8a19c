#pragma once
// The options of the transport matrix as a table.

#include "methods/matrix/options.h"
#include "solve/shooting/common_options.h"
#include "solve/transport/patch_shots.shared.h"

namespace lumel {

/// Three matrices of n × n numbers and their inverse have to fit into memory, and take n³
/// operations.
inline constexpr std::int64_t kMinPatches = 8, kMaxPatches = 16384;
inline constexpr std::int64_t kMaxReflections = 1'000'000;

inline constexpr OptionWord kAllReflections[] = {{"all", 0}};
inline constexpr OptionWord kForms[] = {{"tiles", MatrixForm::tiles}, {"bc1", MatrixForm::bc1}};

inline constexpr OptionInfo kMatrixOptions[] = {
    seed_option(member<&MatrixOptions::seed>),
    batch_option(member<&MatrixOptions::transport, &TransportOptions::views, &ViewOptions::batch>,
                 kMaxPatchBatch),
    projection_option(
        member<&MatrixOptions::transport, &TransportOptions::views, &ViewOptions::projection>),
    hemicube_option(
        member<&MatrixOptions::transport, &TransportOptions::views, &ViewOptions::hemicube>),
    {.name = "patches",
     .help = "Largest number of patches that exchange light; memory grows with its square",
     .lowest = kMinPatches,
     .highest = kMaxPatches,
     .member = member<&MatrixOptions::transport, &TransportOptions::patches>},
    {.name = "bounces",
     .help = "Reflections that count",
     .words = kAllReflections,
     .unit = "K",
     .lowest = 1,
     .highest = kMaxReflections,
     .member = member<&MatrixOptions::transport, &TransportOptions::bounces>},
    {.name = "form",
     .help = "Storage of the matrix for relighting: tiles of the coefficients that matter, or the "
             "paper's texture of BC1 blocks, which is larger and requires a device with such "
             "textures",
     .words = kForms,
     .member = member<&MatrixOptions::form>},
};

}  // namespace lumel
