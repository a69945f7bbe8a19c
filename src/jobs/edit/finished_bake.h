#pragma once
// A finished bake: its scene, lumels and light.

#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/edit/solution_file.h"
#include "results/files/folder.h"
#include "results/record/bake_record.h"

namespace lumel {

/// Must not move.
struct FinishedBake {
    /// Reads the folder of a bake, consistently even if it is being replaced. Throws Error{input}
    /// if the bake has only part of the light.
    explicit FinishedBake(const std::string& folder);
    /// Reads a bake that is written but not yet committed.
    explicit FinishedBake(const OutputFolder& written);
    FinishedBake(const FinishedBake&) = delete;
    FinishedBake& operator=(const FinishedBake&) = delete;

private:
    struct Files {
        BakeRecord record;
        StoredSolution solution;
        Scene scene;
    };
    static Files read(const std::string& folder);
    static Files read_locked(const std::string& folder);
    explicit FinishedBake(Files files);

public:
    BakeRecord record;
    StoredSolution solution;
    SolveScene prepared;
    std::vector<glm::vec3> irradiance;  ///< [N] H as solved [lx]
};

}  // namespace lumel
