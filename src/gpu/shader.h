#pragma once
// Shader interfaces, by the names and types that shaders declare. For each compute shader and each
// raster pass, the build writes a header beside its SPIR-V (cmake/LumelShaders.cmake):
//
//     #include "methods/stochastic/stochastic.receive.comp.h"       stochastic.receive.comp
//     #include "raster/eyes/hemicube.raster.h"            hemicube.vert and the stages with it
//
// with a type lumel::shaders::StochasticReceive that has
//
//     Bindings   one member per array, texture and triangle tree that the shader uses, in the order
//                declared; all are required
//     Params     push constants
//     Mesh       raster passes: one member per input of the vertex shader
//
// and data for Kernel and Raster. The header also checks that C++ and the shader give shared
// structs the same layout.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gpu/array.h"
#include "gpu/texture.h"

namespace lumel::gpu {

using Spirv = std::span<const std::uint32_t>;

/// constants: a small array with a uniform index (a uniform block).
enum class SlotKind : std::uint8_t { array, constants, texture, uint_texture, tree };

/// Binding of a Bindings member in a stage.
struct Slot {
    std::uint32_t binding;  ///< number in the descriptor set
    std::uint32_t member;   ///< index in Bindings
    SlotKind kind;
};

class TriangleTree;

/// An array, a texture with its sampler, or a triangle tree.
struct Binding {
    const Buffer* buffer = nullptr;
    const Target* texture = nullptr;
    const Sampler* sampler = nullptr;
    const TriangleTree* tree = nullptr;
};

/// An array that a shader reads as another type: codes in words, floats in fours.
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

/// T[] for a shader to read or write.
template <class T>
class ArrayBinding {
public:
    ArrayBinding(const Array<T>& array) : buffer_(&array.buffer()) {}
    ArrayBinding(const Packed& other) : buffer_(&other.buffer()) {}
    operator Binding() const { return {.buffer = buffer_}; }

private:
    const Buffer* buffer_;
};

/// A texture for a shader to read.
class TextureBinding {
public:
    TextureBinding(const Target& target, const Sampler& how) : target_(&target), sampler_(&how) {}
    operator Binding() const { return {.texture = target_, .sampler = sampler_}; }

private:
    const Target* target_;
    const Sampler* sampler_;
};

/// A triangle tree for a shader's ray queries.
class TreeBinding {
public:
    TreeBinding(const TriangleTree& tree) : tree_(&tree) {}
    operator Binding() const { return {.tree = tree_}; }

private:
    const TriangleTree* tree_;
};

/// Params of a shader without push constants.
struct NoParams {};

/// SPIR-V of a raster pass; absent stages are empty.
struct Stages {
    Spirv vertex;
    Spirv control, evaluation;  ///< both for tessellation (Device::can_tessellate), or neither
    Spirv fragment;             ///< empty: depth only
};

}  // namespace lumel::gpu
