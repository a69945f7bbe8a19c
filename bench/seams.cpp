// Seams of a map before and after they are matched: how large, and what they look like.

#include <algorithm>

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/modes.h"
#include "results/preview/preview.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

constexpr int kWidth = 720;    ///< of each of both pictures [pixels]
constexpr int kBorder = 8;     ///< between them [pixels]
constexpr float kEnd = 0.02f;  ///< error at which the light is shown

std::vector<glm::vec3> light_of(const SolveScene& prepared, const gpu::Device& device,
                                const Settings& settings)
{
    SolverOptions options = solver_of(settings);
    options.target_error = kEnd;
    const NearField near = near_field_for(prepared.scene, prepared.rays, prepared.lumels, options);
    const World world(device, prepared.scene, prepared.lumels, &prepared.atlas);
    const auto solver = make_solver({.device = &device,
                                     .world = &world,
                                     .lumels = prepared.lumels,
                                     .near = near,
                                     .scene = &prepared},
                                    options);
    solve(*solver, options);
    return solver->irradiance();
}

/// finish_map without its last step.
Image with_seams(const Lumels& lumels, const std::vector<glm::vec3>& light)
{
    Image map = to_map(lumels, light);
    fill_buried(map, lumels, shown_lumels(lumels, light));
    dilate(map);
    return map;
}

Image side_by_side(const Image& left, const Image& right)
{
    Image both(left.width + kBorder + right.width, left.height, left.channels);
    std::fill(both.values.begin(), both.values.end(), 1.0f);
    for (int y = 0; y < left.height; ++y) {
        std::copy_n(left.at(0, y), left.width * left.channels, both.at(0, y));
        std::copy_n(right.at(0, y), right.width * right.channels, both.at(left.width + kBorder, y));
    }
    return both;
}

View view_for(const Settings& settings, const SolveScene& prepared)
{
    View view = choose_view(prepared.scene, prepared.rays);
    if (const std::vector<float>& from = settings.from; !from.empty()) {
        const glm::vec3 eye(from[0], from[1], from[2]), at(from[3], from[4], from[5]);
        view.transform = glm::inverse(glm::lookAt(eye, at, glm::vec3(0.0f, 1.0f, 0.0f)));
    }
    return view;
}

void print_row(const char* when, const SeamGaps& gaps)
{
    fmt::print("{:<8} {:>10.0f} {:>10.1f} {:>10.3f}\n", when, gaps.length, 100.0 * gaps.jumping,
               100.0 * gaps.gap);
}

}  // namespace

void show_seams(const Settings& settings)
{
    const gpu::Device device(settings.device);
    const SolveScene prepared = prepare(settings, settings.size);
    const Image before = with_seams(prepared.lumels, light_of(prepared, device, settings));
    Image after = before;
    match_seams(after, prepared.scene, prepared.atlas, prepared.lumels);

    fmt::print("{}: seams, and how much their two sides differ\n", settings.scene);
    fmt::print("{:<8} {:>10} {:>10} {:>10}\n", "", "texels", "jumps [%]", "gap [%]");
    print_row("before", seam_gaps(before, before, prepared.scene, prepared.atlas));
    print_row("after", seam_gaps(after, before, prepared.scene, prepared.atlas));

    const View view = view_for(settings, prepared);
    const auto picture = [&](const Image& map) {
        return render_preview(device, prepared.scene, prepared.atlas, map, view, kWidth);
    };
    fmt::print("device: {}\n", device.info().name);
    const Image left = picture(before), right = picture(after);
    write_png(settings.seams,
              tone_map(side_by_side(left, right), choose_exposure(left).value_or(1.0f)));
}

}  // namespace lumel::bench
