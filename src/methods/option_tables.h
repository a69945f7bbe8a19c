#pragma once
// What each method can be told: the tables of its options.

#include <cstdint>
#include <limits>

#include "links/trace/links.h"
#include "methods/directions/directions.h"
#include "methods/gather/gather.h"
#include "methods/glossy/glossy.h"
#include "methods/matrix/matrix.h"
#include "methods/option_fields.h"
#include "methods/progressive/progressive.h"
#include "methods/stochastic/stochastic.h"

namespace lumel::option_tables {

inline constexpr int kMinHemicube = 16, kMaxHemicube = 2048;  // sides that devices draw [pixels]
inline constexpr int kMinMap = 16, kMaxMap = 4096;            // sides [pixels]
inline constexpr std::uint32_t kMaxSeed = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::uint32_t kMaxSlabs = 64;  // a direction has twice as many maps
// Three matrices of n × n numbers and their inverse have to fit into memory, and take n³
// operations.
inline constexpr std::uint32_t kMinPatches = 8, kMaxPatches = 16384;
inline constexpr std::uint32_t kMaxReflections = 1'000'000;
/// Maps that fit the images of common devices.
inline constexpr std::uint32_t kMaxDirectionBatch = 256;

// Values that are words.

inline constexpr Word<SampleRule> kRules[] = {{"area", SampleRule::area},
                                              {"centre", SampleRule::centre}};
inline constexpr Word<Projection> kProjections[] = {{"hemicube", Projection::hemicube},
                                                    {"hemisphere", Projection::hemisphere}};
inline constexpr Word<Scheme> kSchemes[] = {{"phased", Scheme::phased}, {"paper", Scheme::paper}};
inline constexpr Word<Layers> kLayers[] = {
    {"list", Layers::list}, {"peel", Layers::peel}, {"stochastic", Layers::stochastic}};
inline constexpr Word<Rays> kRays[] = {{"auto", Rays::automatic},
                                       {"host", Rays::host},
                                       {"query", Rays::query},
                                       {"raster", Rays::raster}};
inline constexpr Word<MatrixForm> kForms[] = {{"tiles", MatrixForm::tiles},
                                              {"bc1", MatrixForm::bc1}};
inline constexpr Word<bool> kSwitch[] = {{"on", true}, {"off", false}};
inline constexpr Word<int> kLookups[] = {{"1", 1}, {"3", 3}, {"5", 5}};

// Where options are in the structs.

inline constexpr auto seed = [](auto& o) -> auto&
{
    return o.seed;
};
inline constexpr auto rule = [](auto& o) -> auto&
{
    return o.rule;
};
inline constexpr auto scheme = [](auto& o) -> auto&
{
    return o.scheme;
};
inline constexpr auto averaging = [](auto& o) -> auto&
{
    return o.iteration.scheme;
};
inline constexpr auto batch = [](auto& o) -> auto&
{
    return o.batch;
};
inline constexpr auto hemicube = [](auto& o) -> auto&
{
    return o.hemicube;
};
inline constexpr auto eye_batch = [](auto& o) -> auto&
{
    return o.views.batch;
};
inline constexpr auto eye_hemicube = [](auto& o) -> auto&
{
    return o.views.hemicube;
};
inline constexpr auto projection = [](auto& o) -> auto&
{
    return o.views.projection;
};
inline constexpr auto filter = [](auto& o) -> auto&
{
    return o.filter;
};
inline constexpr auto ray_caster = [](auto& o) -> auto&
{
    return o.rays;
};
inline constexpr auto layers = [](auto& o) -> auto&
{
    return o.layers;
};
inline constexpr auto lookups = [](auto& o) -> auto&
{
    return o.lookups;
};
inline constexpr auto slabs = [](auto& o) -> auto&
{
    return o.slabs;
};
inline constexpr auto map_side = [](auto& o) -> auto&
{
    return o.map_side;
};
inline constexpr auto patch_batch = [](auto& o) -> auto&
{
    return o.transport.views.batch;
};
inline constexpr auto patch_hemicube = [](auto& o) -> auto&
{
    return o.transport.views.hemicube;
};
inline constexpr auto patch_projection = [](auto& o) -> auto&
{
    return o.transport.views.projection;
};
inline constexpr auto patches = [](auto& o) -> auto&
{
    return o.transport.patches;
};
inline constexpr auto bounces = [](auto& o) -> auto&
{
    return o.transport.bounces;
};

inline constexpr auto form = [](auto& o) -> auto&
{
    return o.form;
};

// Options that several methods read.

inline constexpr Label kSeed{"seed", "N", "Random seed"};
inline constexpr Label kScheme{"scheme", "phased|paper",
                               "Iteration scheme: phased, with exact near pairs, or the papers'"};
inline constexpr Label kSampling{"sampling", "area|centre",
                                 "Receive over the covered area of a lumel or at its centre"};
inline constexpr Label kBatch{"batch", "K", "Shooters (or hemicubes, or directions) per iteration"};
inline constexpr Label kProjection{
    "projection", "hemicube|hemisphere",
    "Draw what shooters see on five faces (hemicube) or on one disc"};
inline constexpr Label kHemicube{
    "hemicube", "N",
    "Side of a hemicube's front face in pixels; a hemisphere's disc is twice as wide"};

template <class Options>
constexpr OptionInfo seed_option()
{
    return number<Options, 0u, kMaxSeed, seed>(kSeed);
}

inline constexpr OptionInfo kLinksOptions[] = {
    seed_option<LinksOptions>(),
    choice<LinksOptions, kRules, rule>(kSampling),
    choice<LinksOptions, kSwitch, filter>(
        {"filter", "on|off",
         "Average lumels with those around them that look alike; without it the result is exact in "
         "expectation"}),
    choice<LinksOptions, kRays, ray_caster>(
        {"rays", "auto|host|query|raster",
         "What casts the rays: the host, ray queries of the device (VK_KHR_ray_query), or drawings "
         "by the device for rays that leave lumels; auto: the host on a device that is a CPU, else "
         "queries where the device has them, else drawings"}),
};

inline constexpr OptionInfo kStochasticOptions[] = {
    seed_option<StochasticOptions>(),
    choice<StochasticOptions, kSchemes, averaging>(kScheme),
    choice<StochasticOptions, kRules, rule>(kSampling),
    number<StochasticOptions, 1, kMaxBatch, eye_batch>(kBatch),
    choice<StochasticOptions, kProjections, projection>(kProjection),
    number<StochasticOptions, kMinHemicube, kMaxHemicube, eye_hemicube>(kHemicube),
};

inline constexpr OptionInfo kGlossyOptions[] = {
    seed_option<GlossyOptions>(),
    choice<GlossyOptions, kSchemes, scheme>(kScheme),
    choice<GlossyOptions, kRules, rule>(kSampling),
    number<GlossyOptions, 1, kMaxGlossyBatch, eye_batch>(kBatch),
    choice<GlossyOptions, kProjections, projection>(kProjection),
    number<GlossyOptions, kMinHemicube, kMaxHemicube, eye_hemicube>(kHemicube),
};

inline constexpr OptionInfo kDirectionsOptions[] = {
    seed_option<DirectionsOptions>(),
    choice<DirectionsOptions, kSchemes, averaging>(kScheme),
    choice<DirectionsOptions, kRules, rule>(kSampling),
    number<DirectionsOptions, 1, kMaxDirectionBatch, batch>(kBatch),
    choice<DirectionsOptions, kLayers, layers>(
        {"layers", "list|peel|stochastic",
         "What is kept of surfaces behind one another: all of them, at once (list) or one after "
         "another (peel), or one a pixel at random (stochastic)"}),
    choice<DirectionsOptions, kLookups, lookups>(
        {"lookups", "1|3|5", "Side of the square of pixels read among stochastic layers", "layers",
         "stochastic"}),
    number<DirectionsOptions, 1u, kMaxSlabs, slabs, Zero::automatic>(
        {"slabs", "auto|N",
         "Slabs that each direction is cut into, so that fewer surfaces compete for a pixel of "
         "stochastic layers; auto: as many as the overdraw requires",
         "layers", "stochastic"}),
    number<DirectionsOptions, kMinMap, kMaxMap, map_side, Zero::automatic>(
        {"map-side", "auto|N", "Side of a direction's maps in pixels; auto: as suits the lumels"}),
};

inline constexpr OptionInfo kProgressiveOptions[] = {
    seed_option<ProgressiveOptions>(),
    number<ProgressiveOptions, 1, kMaxPatchBatch, eye_batch>(kBatch),
    choice<ProgressiveOptions, kProjections, projection>(kProjection),
    number<ProgressiveOptions, kMinHemicube, kMaxHemicube, eye_hemicube>(kHemicube),
};

inline constexpr OptionInfo kGatherOptions[] = {
    seed_option<GatherOptions>(),
    choice<GatherOptions, kRules, rule>(kSampling),
    number<GatherOptions, 1, kMaxHemicubes, batch>(kBatch),
    number<GatherOptions, kMinHemicube, kMaxHemicube, hemicube>(kHemicube),
};

inline constexpr OptionInfo kMatrixOptions[] = {
    seed_option<MatrixOptions>(),
    number<MatrixOptions, 1, kMaxPatchBatch, patch_batch>(kBatch),
    choice<MatrixOptions, kProjections, patch_projection>(kProjection),
    number<MatrixOptions, kMinHemicube, kMaxHemicube, patch_hemicube>(kHemicube),
    number<MatrixOptions, kMinPatches, kMaxPatches, patches>(
        {"patches", "N",
         "Largest number of patches that exchange light; memory grows with its square"}),
    number<MatrixOptions, 1u, kMaxReflections, bounces, Zero::all>(
        {"bounces", "all|K", "Reflections that count"}),
    choice<MatrixOptions, kForms, form>(
        {"form", "tiles|bc1",
         "How the matrix is stored for relighting: tiles of the coefficients that matter, or the "
         "paper's texture of BC1 blocks, which is larger and needs a device with such textures"}),
};

}  // namespace lumel::option_tables
