#pragma once
// Names of enum values in options and reports.

#include <array>
#include <string>

#include "atlas/lumels/sample_rule.h"
#include "atlas/packing/atlas.h"
#include "base/images/lightmap_format.h"
#include "base/json/json_view.h"
#include "results/directional/directional.h"
#include "scene/gltf/compression.h"
#include "scene/values/parts.h"

namespace lumel {

template <class Value>
struct EnumName {
    const char* text;
    Value value;
};

template <class Value>
inline constexpr std::array<EnumName<Value>, 0> kWords{};

template <>
inline constexpr std::array<EnumName<SampleRule>, 2> kWords<SampleRule> = {
    {{"area", SampleRule::area}, {"centre", SampleRule::centre}}};
template <>
inline constexpr std::array<EnumName<Directional>, 3> kWords<Directional> = {
    {{"none", Directional::none}, {"sh1", Directional::sh1}, {"sh2", Directional::sh2}}};
template <>
inline constexpr std::array<EnumName<Parts>, 3> kWords<Parts> = {
    {{"all", Parts::all}, {"direct", Parts::direct}, {"indirect", Parts::indirect}}};
template <>
inline constexpr std::array<EnumName<LightmapFormat>, 4> kWords<LightmapFormat> = {
    {{"ktx2", LightmapFormat::ktx2},
     {"rgb9e5", LightmapFormat::rgb9e5},
     {"png", LightmapFormat::png},
     {"none", LightmapFormat::none}}};
template <>
inline constexpr std::array<EnumName<Compression>, 3> kWords<Compression> = {
    {{"none", Compression::none},
     {"meshopt", Compression::meshopt},
     {"draco", Compression::draco}}};

template <>
inline constexpr std::array<EnumName<Sides>, 4> kWords<Sides> = {{{"auto", Sides::automatic},
                                                                  {"both", Sides::both},
                                                                  {"brighter", Sides::brighter},
                                                                  {"front", Sides::front}}};

template <class Value>
std::string word_of(Value value)
{
    for (const EnumName<Value>& word : kWords<Value>)
        if (word.value == value)
            return word.text;
    return {};
}

/// Throws Error{input} for an unknown name.
template <class Value>
Value value_of_word(const JsonView& view)
{
    std::string known;
    for (const EnumName<Value>& word : kWords<Value>) {
        if (view.string() == word.text)
            return word.value;
        known += std::string(known.empty() ? "" : ", ") + word.text;
    }
    view.fail("is " + quoted(view.string()) + ", but must be one of " + known);
}

}  // namespace lumel
