#pragma once
// What a shader is given, by the names and types that it declares. For each compute shader, and for
// each raster pass, the build writes a header beside its SPIR-V (cmake/LumelShaders.cmake):
//
//     #include "methods/stochastic/stochastic.receive.comp.h"         solve/stochastic.receive.comp
//     #include "raster/eyes/hemicube.raster.h"            hemicube.vert and the stages with it
//
// with a type lumel::shaders::StochasticReceive that holds
//
//     Bindings   one member for each array, texture and triangle tree that the shader reaches, in
//                the order of their declarations; none may be left out
//     Params     its push constants
//     Mesh       of a raster pass: one member for each input of the vertex shader
//
// and what Kernel and Raster need to know of it. The header also checks that C++ and the shader lay
// the structs that they share out alike.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gpu/array.h"
#include "gpu/texture.h"

namespace lumel::gpu {

using Spirv = std::span<const std::uint32_t>;

/// constants: a small array that every invocation reads at the same index (a uniform block).
enum class SlotKind : std::uint8_t { array, constants, texture, uint_texture, tree };

/// Where a stage reads a member of its Bindings.
struct Slot {
    std::uint32_t binding;  ///< in the descriptor set
    std::uint32_t member;   ///< of Bindings
    SlotKind kind;
};

class TriangleTree;

/// An array, a texture with a sampler, whatever it holds, or a triangle tree.
struct Binding {
    const Buffer* buffer = nullptr;
    const Target* texture = nullptr;
    const Sampler* sampler = nullptr;
    const TriangleTree* tree = nullptr;
};

/// An array that a shader reads as elements of another type: codes in words, floats by fours.
class Packed {
public:
    const Buffer& buffer() const { return *buffer_; }

private:
    template <class T>
    friend Packed packed(const Array<T>& array);
    explicit Packed(const Buffer& buffer) : buffer_(&buffer) {}

    const Buffer* buffer_;
};

template <class T>
Packed packed(const Array<T>& array)
{
    return Packed(array.buffer());
}

/// T[] that a shader reads or writes.
template <class T>
class ArrayBinding {
public:
    ArrayBinding(const Array<T>& array) : buffer_(&array.buffer()) {}
    ArrayBinding(const Packed& other) : buffer_(&other.buffer()) {}
    operator Binding() const { return {.buffer = buffer_}; }

private:
    const Buffer* buffer_;
};

/// A texture that a shader reads.
class TextureBinding {
public:
    TextureBinding(const Target& target, const Sampler& how) : target_(&target), sampler_(&how) {}
    operator Binding() const { return {.texture = target_, .sampler = sampler_}; }

private:
    const Target* target_;
    const Sampler* sampler_;
};

/// Triangles that a shader asks rays of.
class TreeBinding {
public:
    TreeBinding(const TriangleTree& tree) : tree_(&tree) {}
    operator Binding() const { return {.tree = tree_}; }

private:
    const TriangleTree* tree_;
};

/// Params of a shader without push constants.
struct NoParams {};

/// SPIR-V of a raster pass; those that it does not have are empty.
struct Stages {
    Spirv vertex;
    Spirv control, evaluation;  ///< of tessellated triangles (Device::can_tessellate); or neither
    Spirv fragment;             ///< empty: depth only
};

}  // namespace lumel::gpu
