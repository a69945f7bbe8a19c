// Cross redistribution radiosity as in the thesis.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 3.3 and 4.5, Algorithms 4.4 and 4.5.
//
// C are the static elements, M the movable patches. All of C's shot light B^s is crossed, that of
// lamps too: small lamps are undersampled, the thesis' main artefact (section 5.2.2). For each
// patch of M, in its old position:
//
//     render the world from its front                       look_from
//     render C's light from its back                        look_from in colour, resolve
//     for all elements i of C:                              receive
//         ΔH_i -= F_ij (B_j^s - P(C, j, i))
//
// then M's light is cleared, and for each patch in its new position:
//
//     render the world and C's light from its front         look_from, in depth and in colour
//     H_j += integral of the hemicube, B_j^s = E_j + ρ_j H_j      gather    R_g(C, M)
//     render C's light from its back                        look_from in colour, resolve
//     for all elements i of C:                              receive   R_p(M, C), R_x(C, C)
//         ΔH_i += F_ij (B_j^s - P(C, j, i))                           Eq. (3.3.1)
//     for all elements i of M:                                        R_p(M, M)
//         ΔH_i += F_ij B_j^s
//
// ΔH joins the light still to be shot. When B^s has changed in between, M is taken out with the B^s
// it was put in with, and put in with the new one: no error accumulates (section 4.5.2, Error
// analysis). Elements on M do not matter to the number of hemicubes: gathering is not
// substructured, so that all lumels of a patch receive the same light from C.
//
// CrossProjection::incremental is the thesis' other adaptation (section 4.5.2): B^s is the same in
// both positions, and rays that M occludes in both are culled. Its errors accumulate over moves.
//
// Differs from the thesis:
// - Patches are blocks of up to 4 × 4 lumels on any triangles, and the lumels are the grid of rays.
// - The front in the new position is rendered twice, for depth and for light.
// - The area that protrudes is that of the grid's cells whose rays are not culled, by triangles of
//   the objects, where the thesis clips polygons of quads.
// - Backs of patches of open meshes occlude light as well.
// - Of the light that movable patches send each other, patches of later batches alone send it on.

#include "methods/redistribution/paper_cross.h"

#include <algorithm>

#include "methods/gather/hemicube_light.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Sides of the front faces of the thesis' hemicubes [pixels], section 5.3.1.
constexpr std::uint32_t kPaperFrontSide = 64, kPaperBackSide = 16;

std::vector<std::uint32_t> movable(const Lumels& lumels)
{
    std::vector<std::uint32_t> flags;
    for (const Lumel& lumel : lumels.lumels)
        flags.push_back(lumel.flags & kLumelMoving ? 1 : 0);
    return flags;
}

}  // namespace

PaperCross::PaperCross(const gpu::Device& device, const Scene& scene, World& world,
                       const Lumels& lumels, ProgressiveRadiosity& solver,
                       const std::vector<char>& movers, const std::vector<char>& open,
                       CrossProjection projection, bool reprojects)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      solver_(&solver),
      part_(device),
      reset_(device),
      gather_(device),
      receive_(device, std::uint32_t(solver.shots().views().projection())),
      sides_(device, world, lumels, solver, open, kPaperBackSide, 1),
      front_views_(device, world, kPaperFrontSide, solver.shots().views().layout().near,
                   solver.shots().batch()),
      lumel_of_(device, view(nearest_lumels_by_side(lumels))),
      delta_form_factors_(device,
                          view(delta_form_factors(kPaperFrontSide, device.has_standard_samples()))),
      is_mover_(device, view(words_of(movers))),
      of_mover_(device, view(movable(lumels))),
      crossed_(device, lumels.lumels.size()),
      triangles_(device, 1),
      reprojects_(reprojects)
{
    for (std::uint32_t i = 0; i < movers.size(); ++i) {
        if (!movers[i] || projection == CrossProjection::whole)
            continue;
        for (const Primitive& primitive : scene.meshes[scene.instances[i].mesh].primitives)
            for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
                const auto corner = [&](std::size_t n) {
                    return primitive.positions[primitive.indices[t + n]];
                };
                local_triangles_.push_back({i, {corner(0), corner(1), corner(2)}});
            }
    }
}

gpu::Array<MoverTriangle> PaperCross::triangles_at(std::span<const glm::mat4> transforms) const
{
    std::vector<MoverTriangle> placed;
    for (const LocalTriangle& triangle : local_triangles_) {
        const auto at = [&](const glm::vec3& corner) {
            return glm::vec3(transforms[triangle.instance] * glm::vec4(corner, 1.0f));
        };
        placed.push_back({at(triangle.corners.a), at(triangle.corners.b), at(triangle.corners.c)});
    }
    return gpu::Array<MoverTriangle>(*device_, view(placed));
}

void PaperCross::begin(std::vector<glm::mat4> transforms, bool has_moved)
{
    after_ = std::move(transforms);
    next_ = 0;
    culls_ = has_moved && inserted_ && !local_triangles_.empty();
    if (culls_) {
        solver_->pacer().finish();
        triangles_ = triangles_at(after_);
    }
    if (inserted_)
        phase_ = Phase::out;
    else
        put_in();
}

/// Moves M to its new position, without light.
void PaperCross::put_in()
{
    const auto count = std::uint32_t(lumels_->lumels.size());
    gpu::Pacer& pacer = solver_->pacer();
    pacer.finish();
    if (culls_) {
        std::vector<glm::mat4> before;
        for (const Placement& placement : world_->placements())
            before.push_back(placement.now);
        triangles_ = triangles_at(before);
    }
    world_->place(after_);
    pacer.work("prepare", [&](gpu::Commands& commands) {
        commands.dispatch(
            reset_, {.lumels = world_->lumels(), .moved = is_mover_, .far = solver_->light().far},
            CountParams{count}, count);
        if (!culls_)
            commands.dispatch(
                part_, {.shot = solver_->light().shot, .is_lamp = of_mover_, .crossed = crossed_},
                CountParams{count}, count);
    });
    next_ = 0;
    inserted_ = true;
    phase_ = Phase::in;
}

bool PaperCross::step()
{
    if (!is_under_way())
        return false;
    sides_.look_from_fronts(next_);
    if (phase_ == Phase::in)
        gather();
    sides_.look_from_backs(light_of_still());
    receive();
    const std::uint64_t patches = std::min<std::uint64_t>(sides_.batch(), sides_.size() - next_);
    hemicubes_ += (phase_ == Phase::in ? 3 : 2) * patches;
    next_ += sides_.batch();
    if (next_ < sides_.listed())
        return true;
    if (phase_ == Phase::out)
        put_in();
    else
        phase_ = Phase::none;
    return is_under_way();
}

SurfaceLight PaperCross::light_of_still() const
{
    return {.lumel_of = &lumel_of_,
            .radiosity = &crossed_,
            .width = std::uint32_t(lumels_->width),
            .height = std::uint32_t(lumels_->height)};
}

void PaperCross::gather()
{
    const PatchShots& shots = solver_->shots();
    const ShotLight& light = solver_->light();
    front_views_.look_from(solver_->pacer(), shots.eyes(), light_of_still(), sides_.batch());
    solver_->pacer().dispatch(
        "gather", gather_,
        {.views = {front_views_.image(), front_views_.sampler()},
         .shots = shots.shots(),
         .delta_form_factor = delta_form_factors_,
         .surface = light.surface,
         .emission = light.emission,
         .far = light.far,
         .shot = light.shot},
        PaperGatherParams{.views = front_views_.layout(), .samples = gpu::kManySamples},
        std::size_t(sides_.batch()) * kPaperGatherGroup);
}

void PaperCross::receive()
{
    const PatchShots& shots = solver_->shots();
    const EyeViews& views = shots.views();
    solver_->pacer().dispatch_parts("cross to lumels", std::uint32_t(lumels_->lumels.size()),
                                    kProbeLumels, receive_,
                                    {.lumels = world_->lumels(),
                                     .views = {views.image(), views.sampler()},
                                     .eyes = shots.eyes(),
                                     .shots = shots.shots(),
                                     .shot = solver_->light().shot,
                                     .back = sides_.back(),
                                     .triangles = triangles_,
                                     .far = solver_->light().far},
                                    {.views = views.layout(),
                                     .back = sides_.back_layout(),
                                     .shots = sides_.batch(),
                                     .sign_factor = phase_ == Phase::in ? 1.0f : -1.0f,
                                     .triangles = culls_ ? std::uint32_t(triangles_.size()) : 0u,
                                     .reprojects = reprojects_ ? 1u : 0u});
}

}  // namespace lumel
