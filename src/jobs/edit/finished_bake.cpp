#include "jobs/edit/finished_bake.h"

#include <filesystem>
#include <utility>

#include "jobs/edit/edited_scene.h"
#include "methods/methods.h"
#include "results/record/light_settings.h"

namespace lumel {

FinishedBake::FinishedBake(const std::string& folder) : FinishedBake(read_locked(folder)) {}

FinishedBake::FinishedBake(const OutputFolder& written) : FinishedBake(read(written.path({}))) {}

FinishedBake::Files FinishedBake::read_locked(const std::string& folder)
{
    const ResultsLock as_it_is(folder);
    return read(folder);
}

FinishedBake::Files FinishedBake::read(const std::string& folder)
{
    const std::filesystem::path path(folder);
    BakeRecord record = read_bake_record(folder);
    check_whole(folder, record);
    check_light_files(record.lights);
    StoredSolution solution = read_solution((path / kSolutionFile).string());
    Scene scene = read_scene((path / kSceneFile).string(),
                             method_of(record.solver.method).materials, record.lights);
    return {std::move(record), std::move(solution), std::move(scene)};
}

FinishedBake::FinishedBake(Files files)
    : record(std::move(files.record)),
      solution(std::move(files.solution)),
      prepared(
          std::move(files.scene),
          [&](const Scene& scene, const RayScene&, const ProgressCallback&) {
              return written_atlas(scene, record.pages, float(record.texels_per_metre),
                                   solution.charts);
          },
          [&](const Scene&, const RayScene&, const Atlas&, Lumels& lumels,
              const ProgressCallback&) { return bury_as_before(solution, lumels); })
{
    for (const Lumel& lumel : prepared.lumels.lumels)
        irradiance.push_back(solution.irradiance(lumel, lumel.texel));
}

}  // namespace lumel
