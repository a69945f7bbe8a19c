#pragma once
// What techniques did for a move, and its tables and pictures ([Hoef13] chapter 5).

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/papers/moving.h"
#include "bench/papers/our_default.h"
#include "bench/papers/report.h"
#include "truth/metrics.h"

namespace lumel::bench {

enum MoveTechnique {
    kNothing,
    kGather,
    kProgressive,
    kIncremental,
    kCross,
    kPaperIncremental,
    kPaperCross,
    kPaperCrossIncremental,
    kTechniques
};
inline constexpr std::array<const char*, kTechniques> kTechniqueNames{
    "nothing done", "gather",
    "progressive",  "incremental",
    "cross",        "paper-incremental",
    "paper-cross",  "paper-cross-incremental"};

/// What one technique did after the last move.
struct MoveOutcome {
    Update update;
    std::vector<glm::vec3> alone, irradiance;  ///< after redistribution alone; at rest
    std::optional<MapError> alone_from_truth, from_truth;
    /// Relative RMSE from `progressive` at rest, with the same lumels.
    double alone_from_scratch = 0.0, from_scratch = 0.0;
    double change_left = 0.0;        ///< from_scratch relative to that of nothing done
    std::vector<glm::vec3> before;   ///< H [N] at rest before the last move
    std::optional<ShareOfMove> own;  ///< from solutions from scratch by the same technique
};

/// One scene.
struct MoveResults {
    std::string title;
    std::size_t still = 0, moving = 0;  ///< lumels
    std::size_t patches = 0, moving_patches = 0;
    std::size_t vertices = 0, triangles = 0;
    std::array<std::optional<MoveOutcome>, kTechniques> by;
    ShareOfMove other_seed{};  ///< progressive solutions with another seed, from `progressive`
    Solved ours;               ///< from scratch, with the box in its last place
    std::optional<MapError> ours_from_truth;
    std::vector<glm::vec3> truth;  ///< H [N] by paths; empty: none
    std::optional<Picture> picture;
};

void add_scenes(Report& report, const std::string& suffix, const std::vector<MoveResults>& all);
void add_errors(Report& report, const std::vector<MoveResults>& all);
/// by_processor: ratios are of processor time.
void add_times(Report& report, const std::string& suffix, const std::vector<MoveResults>& all,
               bool by_processor);
/// If all has the scenes of table 5.4.
void add_overview(Report& report, const std::vector<MoveResults>& all, bool by_processor);
/// Times until at rest of `many` over those of `few` vertices.
void add_growth(Report& report, const std::string& suffix, const std::vector<MoveResults>& few,
                const std::vector<MoveResults>& many, bool by_processor);

}  // namespace lumel::bench
