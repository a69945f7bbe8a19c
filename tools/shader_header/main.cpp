// shader_header <header> <name> <source folder> {<shader> <module> <dependencies>}…
//
// Writes the C++ header of a kernel (one compute shader) or of a raster pass (its stages): what it
// is given, by the names and types that the shaders declare. gpu/shader.h says what the header
// holds, cmake/LumelShaders.cmake when it is written.
//
//     <name>          as in files, stochastic.receive
//     <shader>        path below the source folder
//     <module>        its SPIR-V with names
//     <dependencies>  make rule of the files it includes: their *.shared.h declare its types
//
// A header that would not change is not touched, so that nothing is compiled again.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "module.h"

namespace {

namespace fs = std::filesystem;

struct Shader {
    std::string path, symbol;
    Module module;
    std::set<std::string> includes;
};

/// What all stages of a pass declare, and where each stage has it.
struct Interface {
    struct Slot {
        std::uint32_t number;
        std::size_t member;
    };
    std::vector<Binding> members;
    std::vector<Slot> slots;
    std::optional<Type> params;
};

std::string read_file(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::uint32_t> read_words(const fs::path& path)
{
    const std::string bytes = read_file(path);
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::copy_n(bytes.data(), words.size() * sizeof(std::uint32_t),
                reinterpret_cast<char*>(words.data()));
    return words;
}

/// `stochastic.receive` → StochasticReceive
std::string type_name(const std::string& name)
{
    std::string result;
    bool begins = true;
    for (const char c : name) {
        const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (letter)
            result += begins ? char(std::toupper(static_cast<unsigned char>(c))) : c;
        begins = !letter;
    }
    return result;
}

std::string symbol_of(std::string path)
{
    for (char& c : path)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0)
            c = '_';
    return "lumel_spirv_" + path;
}

std::set<std::string> shared_headers(const fs::path& dependencies, const fs::path& folder)
{
    std::set<std::string> headers;
    std::istringstream rule(read_file(dependencies));
    for (std::string file; rule >> file;)
        if (file.ends_with(".shared.h"))
            headers.insert(fs::weakly_canonical(file).lexically_relative(folder).string());
    return headers;
}

Shader read_shader(char** arguments, const fs::path& folder)
{
    const std::string path = arguments[0];
    try {
        return {path, symbol_of(path), read_module(read_words(arguments[1])),
                shared_headers(arguments[2], folder)};
    } catch (const std::exception& error) {
        throw std::runtime_error(path + ": " + error.what());
    }
}

void require(bool holds, const Shader& shader, const std::string& otherwise)
{
    if (!holds)
        throw std::runtime_error(shader.path + ": " + otherwise);
}

/// Stages that declare the same name are given the same thing.
Interface join(const std::vector<Shader>& shaders)
{
    Interface all;
    for (const Shader& shader : shaders) {
        for (const Binding& binding : shader.module.bindings) {
            const auto same =
                std::find_if(all.members.begin(), all.members.end(),
                             [&](const Binding& b) { return b.name == binding.name; });
            if (same != all.members.end())
                require(same->kind == binding.kind && same->element.name == binding.element.name,
                        shader, binding.name + " is of another type in the stage before");
            for (const Interface::Slot& slot : all.slots)
                require(slot.number != binding.number, shader,
                        binding.name + " has the number of another binding");
            all.slots.push_back(
                {binding.number, std::size_t(std::distance(all.members.begin(), same))});
            if (same == all.members.end())
                all.members.push_back(binding);
        }
        const std::optional<Type>& params = shader.module.params;
        require(!params || !all.params || params->name == all.params->name, shader,
                "has other parameters than the stage before");
        if (!all.params)
            all.params = params;
    }
    return all;
}

std::string binding_type(const Binding& binding)
{
    if (binding.kind == Kind::tree)
        return "gpu::TreeBinding";
    const bool is_array = binding.kind == Kind::array || binding.kind == Kind::constants;
    return is_array ? "gpu::ArrayBinding<" + binding.element.name + ">" : "gpu::TextureBinding";
}

const char* kind_name(Kind kind)
{
    switch (kind) {
    case Kind::array:
        return "array";
    case Kind::constants:
        return "constants";
    case Kind::texture:
        return "texture";
    case Kind::uint_texture:
        return "uint_texture";
    case Kind::tree:
        return "tree";
    }
    return "";
}

/// Both compilers must lay a struct out alike.
void write_check(std::ostream& out, const Type& type)
{
    out << "static_assert(sizeof(" << type.name << ") == " << type.bytes;
    for (const Field& field : type.fields)
        out << " &&\n              offsetof(" << type.name << ", " << field.name
            << ") == " << field.offset;
    out << ");\n";
}

void write_checks(std::ostream& out, const Interface& all)
{
    std::set<std::string> checked;
    const auto check = [&](const Type& type) {
        if (checked.insert(type.name).second)
            write_check(out, type);
    };
    for (const Binding& binding : all.members)
        if (!binding.element.name.empty())
            check(binding.element);
    if (all.params)
        check(*all.params);
}

void write_list(std::ostream& out, const char* type, const char* from, const auto& members)
{
    out << "    static std::array<gpu::Binding, " << members.size()
        << "> list([[maybe_unused]] const " << type << "& " << from << ")\n    {\n        return {";
    for (const auto& member : members)
        out << (&member == &members.front() ? "" : ", ") << from << '.' << member.name;
    out << "};\n    }\n";
}

void write_interface(std::ostream& out, const Interface& all)
{
    out << "    struct Bindings {\n";
    for (const Binding& binding : all.members)
        out << "        " << binding_type(binding) << ' ' << binding.name << ";\n";
    out << "    };\n    using Params = " << (all.params ? all.params->name : "gpu::NoParams")
        << ";\n    static constexpr std::array<gpu::Slot, " << all.slots.size() << "> kSlots{{\n";
    for (const Interface::Slot& slot : all.slots)
        out << "        {" << slot.number << ", " << slot.member
            << ", gpu::SlotKind::" << kind_name(all.members[slot.member].kind) << "},\n";
    out << "    }};\n";
    write_list(out, "Bindings", "given", all.members);
}

std::string spirv_of(const Shader& shader)
{
    return "{" + shader.symbol + ", " + shader.symbol + "_words}";
}

void write_kernel(std::ostream& out, const Shader& shader)
{
    out << "    static constexpr std::uint32_t kGroupSize = " << shader.module.group_size
        << ";\n    static gpu::Spirv spirv() { return " << spirv_of(shader) << "; }\n";
}

const char* stage_name(Stage stage)
{
    switch (stage) {
    case Stage::vertex:
        return "vertex";
    case Stage::control:
        return "control";
    case Stage::evaluation:
        return "evaluation";
    case Stage::fragment:
        return "fragment";
    case Stage::compute:
        break;
    }
    throw std::runtime_error("a raster pass has no compute stage");
}

void write_raster(std::ostream& out, const std::vector<Shader>& shaders)
{
    const std::vector<Input>& inputs = shaders.front().module.inputs;
    out << "    struct Mesh {\n";
    for (const Input& input : inputs)
        out << "        gpu::ArrayBinding<" << input.type << "> " << input.name << ";\n";
    out << "    };\n    static constexpr std::array<std::uint32_t, " << inputs.size()
        << "> kComponents{";
    for (const Input& input : inputs)
        out << (&input == &inputs.front() ? "" : ", ") << input.components;
    out << "};\n    static constexpr bool kHasColor = " << std::boolalpha
        << shaders.back().module.has_color << ";\n";
    write_list(out, "Mesh", "mesh", inputs);
    out << "    static gpu::Stages stages()\n    {\n        return {";
    for (const Shader& shader : shaders)
        out << (&shader == &shaders.front() ? "" : ",\n                ") << '.'
            << stage_name(shader.module.stage) << " = " << spirv_of(shader);
    out << "};\n    }\n";
}

std::string header_of(const std::string& name, const std::vector<Shader>& shaders)
{
    const Interface all = join(shaders);
    const bool is_kernel = shaders.front().module.stage == Stage::compute;
    std::ostringstream out;
    out << "#pragma once\n// Generated from";
    std::set<std::string> includes;
    for (const Shader& shader : shaders) {
        out << ' ' << shader.path;
        includes.insert(shader.includes.begin(), shader.includes.end());
    }
    out << ".\n\n#include <array>\n#include <cstddef>\n#include <cstdint>\n\n";
    for (const std::string& include : includes)
        out << "#include \"" << include << "\"\n";
    out << "#include \"gpu/shader.h\"\n\n";
    for (const Shader& shader : shaders)
        out << "extern \"C\" const std::uint32_t " << shader.symbol
            << "[];\nextern \"C\" const std::size_t " << shader.symbol << "_words;\n";
    out << "\nnamespace lumel::shaders {\n\n";
    write_checks(out, all);
    out << "\nstruct " << type_name(name) << " {\n    static constexpr const char* kName = \""
        << fs::path(shaders.front().path).parent_path().string() << '/' << name << "\";\n";
    write_interface(out, all);
    if (is_kernel)
        write_kernel(out, shaders.front());
    else
        write_raster(out, shaders);
    out << "};\n\n}  // namespace lumel::shaders\n";
    return out.str();
}

void write_if_other(const fs::path& path, const std::string& text)
{
    if (fs::exists(path) && read_file(path) == text)
        return;
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

int main(int count, char** arguments)
{
    try {
        if (count < 7 || (count - 4) % 3 != 0)
            throw std::runtime_error("shader_header <header> <name> <source folder> "
                                     "{<shader> <module> <dependencies>}…");
        std::vector<Shader> shaders;
        for (int i = 4; i < count; i += 3)
            shaders.push_back(read_shader(arguments + i, fs::weakly_canonical(arguments[3])));
        write_if_other(arguments[1], header_of(arguments[2], shaders));
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
