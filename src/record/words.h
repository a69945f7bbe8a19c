#pragma once
// Choices by the words that options and reports have for them.

#include <array>
#include <string>

#include "directional/directional.h"
#include "scene/parts.h"
#include "solve/solver.h"
#include "json/json_view.h"

namespace lumel {

template <class Value>
struct Word {
    const char* text;
    Value value;
};

/// All words of an enumeration.
template <class Value>
inline constexpr std::array<Word<Value>, 0> kWords{};

template <>
inline constexpr std::array<Word<Scheme>, 2> kWords<Scheme> = {
    {{"phased", Scheme::phased}, {"paper", Scheme::paper}}};
template <>
inline constexpr std::array<Word<SampleRule>, 2> kWords<SampleRule> = {
    {{"area", SampleRule::area}, {"centre", SampleRule::centre}}};
template <>
inline constexpr std::array<Word<Projection>, 2> kWords<Projection> = {
    {{"hemicube", Projection::hemicube}, {"hemisphere", Projection::hemisphere}}};
template <>
inline constexpr std::array<Word<Layers>, 3> kWords<Layers> = {
    {{"list", Layers::list}, {"peel", Layers::peel}, {"stochastic", Layers::stochastic}}};
template <>
inline constexpr std::array<Word<Directional>, 3> kWords<Directional> = {
    {{"none", Directional::none}, {"sh1", Directional::sh1}, {"sh2", Directional::sh2}}};
template <>
inline constexpr std::array<Word<Parts>, 3> kWords<Parts> = {
    {{"all", Parts::all}, {"direct", Parts::direct}, {"indirect", Parts::indirect}}};

template <class Value>
std::string word_of(Value value)
{
    for (const Word<Value>& word : kWords<Value>)
        if (word.value == value)
            return word.text;
    return {};
}

/// Throws Error{input} for any other word.
template <class Value>
Value value_of_word(const JsonView& view)
{
    std::string known;
    for (const Word<Value>& word : kWords<Value>) {
        if (view.string() == word.text)
            return word.value;
        known += std::string(known.empty() ? "" : ", ") + word.text;
    }
    view.fail("is " + quoted(view.string()) + ", but must be one of " + known);
}

}  // namespace lumel
