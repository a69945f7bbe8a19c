#pragma once
// A finished bake, read back: its scene, its lumels and their light.

#include <string>
#include <vector>

#include "atlas/prepare/prepare.h"
#include "jobs/edit/solution_file.h"
#include "results/files/folder.h"
#include "results/record/bake_record.h"

namespace lumel {

/// Stays where it was made.
struct FinishedBake {
    /// Reads what lumel bake wrote into a folder, all of one bake whatever is written there
    /// meanwhile. Throws Error{input} for a bake of a part of the light.
    explicit FinishedBake(const std::string& folder);
    /// The same of what a bake has written and not yet committed.
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
    Prepared prepared;
    std::vector<glm::vec3> irradiance;  ///< [N] H as solved [lx]
};

}  // namespace lumel
