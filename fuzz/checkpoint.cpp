#include <sstream>

#include "base/core/state_bytes.h"
#include "links/kept/link_table.h"
#include "readers.h"
#include "results/record/report.h"

namespace lumel::fuzz {

void read_checkpoint(Input input)
{
    std::istringstream stream(std::string(input.begin(), input.end()));
    StateReader reader(stream, input.size(), "checkpoint");
    // As a checkpoint begins, then what stands for all that solvers keep.
    std::string version, scene;
    double seconds = 0.0;
    std::vector<ConvergencePoint> curve;
    std::vector<std::vector<LinkBlock>> links;
    std::vector<glm::vec3> sky;
    std::map<std::string, double> times;
    reader(version, scene, seconds, curve, links, sky, times);
    reader.finish();
}

}  // namespace lumel::fuzz
