#pragma once
// The options of illumination along directions as a table.

#include "methods/directions/options.h"
#include "solve/shooting/common_options.h"

namespace lumel {

inline constexpr std::int64_t kMaxDirectionBatch = 256;  // maps that common devices' images hold
inline constexpr std::int64_t kMaxSlabs = 64;            // a direction has twice as many maps
inline constexpr std::int64_t kMinMapSide = 16, kMaxMapSide = 4096;  // [pixels]

inline constexpr OptionWord kLayers[] = {
    {"list", Layers::list}, {"peel", Layers::peel}, {"stochastic", Layers::stochastic}};
inline constexpr OptionWord kLookups[] = {{"1", 1}, {"3", 3}, {"5", 5}};
inline constexpr OptionWord kLookupTests[] = {{"planes", LookupTest::planes},
                                              {"paper", LookupTest::paper}};
inline constexpr OptionWord kAutomatic[] = {{"auto", 0}};

inline constexpr OptionInfo kDirectionsOptions[] = {
    seed_option(member<&DirectionsOptions::seed>),
    scheme_option(member<&DirectionsOptions::iteration, &IterationOptions::scheme>),
    sampling_option(member<&DirectionsOptions::rule>),
    batch_option(member<&DirectionsOptions::batch>, kMaxDirectionBatch),
    {.name = "layers",
     .help = "How overlapping surfaces are stored: all in one pass (list), all in several passes "
             "(peel), or one per pixel at random (stochastic)",
     .words = kLayers,
     .member = member<&DirectionsOptions::layers>},
    {.name = "lookups",
     .help = "Side in pixels of the square that is read from stochastic layers",
     .words = kLookups,
     .member = member<&DirectionsOptions::lookups>,
     .with = "layers",
     .with_value = "stochastic"},
    {.name = "lookup-test",
     .help = "Samples of stochastic layers that can hide others from a lumel: those in front by "
             "their own plane and the lumel's (planes), or by the lumel's alone (paper)",
     .words = kLookupTests,
     .member = member<&DirectionsOptions::lookup_test>,
     .with = "layers",
     .with_value = "stochastic"},
    {.name = "slabs",
     .help = "Slabs per direction; with more, fewer surfaces compete for a pixel of stochastic "
             "layers; auto: as many as the overdraw requires",
     .words = kAutomatic,
     .lowest = 1,
     .highest = kMaxSlabs,
     .member = member<&DirectionsOptions::slabs>,
     .with = "layers",
     .with_value = "stochastic"},
    {.name = "map-side",
     .help = "Side of a direction's maps in pixels; auto: from the size of lumels",
     .words = kAutomatic,
     .lowest = kMinMapSide,
     .highest = kMaxMapSide,
     .member = member<&DirectionsOptions::map_side>},
};

}  // namespace lumel
