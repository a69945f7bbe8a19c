#pragma once
// What a shader declares, read from its SPIR-V. The module keeps its names: it is compiled without
// optimisation, beside the one that runs.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct Field {
    std::string name;
    std::uint32_t offset;  ///< [bytes]
};

/// A type with the layout that the shader gives it.
struct Type {
    std::string name;  ///< in C++, seen from namespace lumel
    std::uint32_t bytes;
    std::vector<Field> fields;  ///< of a struct
};

enum class Kind { array, constants, texture, uint_texture, tree };

struct Binding {
    std::uint32_t number;
    std::string name;
    Kind kind;
    Type element;  ///< of arrays and constants
};

/// What a vertex shader reads of each vertex.
struct Input {
    std::uint32_t location;
    std::string name;
    std::string type;  ///< in C++
    std::uint32_t components;
};

enum class Stage { vertex = 0, control = 1, evaluation = 2, fragment = 4, compute = 5 };

struct Module {
    Stage stage = Stage::compute;
    std::uint32_t group_size = 0;
    std::vector<Binding> bindings;  ///< that main() reaches, by number: as they are declared
    std::optional<Type> params;     ///< push constants
    std::vector<Input> inputs;      ///< by location
    bool has_color = false;         ///< draws into a colour target
};

/// Throws std::runtime_error with a sentence where the shader declares what Lumel's kernels do not
/// take: a block of several members, more than one dimension of a group.
Module read_module(std::span<const std::uint32_t> words);
