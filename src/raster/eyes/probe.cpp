#include "raster/eyes/probe.h"

#include "base/core/frame.h"
#include "raster/eyes/probe.comp.h"

namespace lumel {
namespace {

}  // namespace

Eye eye_at(const glm::vec3& position, const glm::vec3& normal)
{
    constexpr float kTurn = 0.3f;  // so that pixels are not aligned to the edges of a box
    const glm::mat3 frame = frame_about(normal);
    const glm::vec3 t = glm::normalize(frame[0] + kTurn * frame[1]);
    return {position, t, glm::cross(normal, t), normal, 1u};
}

std::vector<std::vector<std::uint32_t>> ask(const gpu::Device& device, const EyeViews& views,
                                            const gpu::Array<Eye>& eyes,
                                            const gpu::Array<Question>& questions)
{
    const gpu::Kernel<shaders::Probe> probe(device, std::uint32_t(views.projection()));
    const gpu::Array<std::uint32_t> answers(device, questions.size());
    gpu::Commands commands(device);
    std::vector<std::vector<std::uint32_t>> all;
    for (std::uint32_t eye = 0; eye < eyes.size(); ++eye) {
        commands.dispatch(probe,
                          {.views = {views.image(), views.sampler()},
                           .eyes = eyes,
                           .questions = questions,
                           .answers = answers},
                          ProbeParams{views.layout(), eye, std::uint32_t(questions.size())},
                          questions.size());
        commands.run();
        all.push_back(answers.download());
    }
    return all;
}

}  // namespace lumel
