#include "bench/papers/moving.h"

#include <glm/gtc/matrix_transform.hpp>

#include "atlas/near/still_part.h"
#include "base/core/usage.h"
#include "bench/papers/iteration_cost.h"
#include "truth/metrics.h"

namespace lumel::bench {

glm::mat4 turned(const Scene& scene, std::uint32_t box, double degrees)
{
    const glm::mat4& place = scene.instances[box].transform;
    const MovedBox bounds = box_of(scene, box, place);
    const glm::vec3 centre = 0.5f * (bounds.low + bounds.high);
    const glm::mat4 turn = glm::rotate(glm::translate(glm::mat4(1.0f), centre),
                                       float(glm::radians(degrees)), glm::vec3(0.0f, 1.0f, 0.0f));
    return glm::translate(turn, -centre) * place;
}

Update update_after_move(LiveScene& live, std::uint32_t instance, const glm::mat4& place)
{
    const gpu::StageTimes before = live.times();
    const std::uint64_t hemicubes = live.state().hemicubes;
    Update update;
    const double begin = cpu_seconds();
    live.move(instance, place);
    do {  // batch by batch, until the move is redistributed
        update.alone_ms += live.update(0.0).milliseconds;
    } while (live.state().under_way);
    update.alone_cpu_ms = 1e3 * (cpu_seconds() - begin);
    update.alone_hemicubes = live.state().hemicubes - hemicubes;
    update.alone = live.irradiance();
    update.alone_stages = since(before, live.times());
    const double rest = cpu_seconds();
    update.whole_ms = update.alone_ms + live.settle().milliseconds;
    update.whole_cpu_ms = update.alone_cpu_ms + 1e3 * (cpu_seconds() - rest);
    update.whole_hemicubes = live.state().hemicubes - hemicubes;
    update.stages = since(before, live.times());
    return update;
}

Image in_a_row(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    Image row(int(irradiance.size()), 1, 4);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        float* texel = row.at(int(i), 0);
        for (int c = 0; c < 3; ++c)
            texel[c] = irradiance[i][c];
        texel[3] = lumels.lumels[i].flags & kLumelBuried ? 0.0f : 1.0f;
    }
    return row;
}

ShareOfMove share_of_move(const Lumels& lumels, const BeforeAndAfter& found,
                          const BeforeAndAfter& wanted)
{
    std::vector<glm::vec3> followed = wanted.before;
    for (std::size_t i = 0; i < followed.size(); ++i)
        followed[i] += found.after[i] - found.before[i];
    const Image row = in_a_row(lumels, wanted.after);
    const auto from_wanted = [&](const std::vector<glm::vec3>& irradiance) {
        return compare_maps(in_a_row(lumels, irradiance), row).relative_rmse;
    };
    const double change = from_wanted(wanted.before);
    return {change, from_wanted(found.after) / change, from_wanted(followed) / change};
}

}  // namespace lumel::bench
