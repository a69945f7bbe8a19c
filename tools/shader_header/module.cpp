#include "module.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace {

// The part of the SPIR-V specification (1.6) that is read here, under its names.
enum Op : std::uint32_t {
    OpName = 5,
    OpMemberName = 6,
    OpEntryPoint = 15,
    OpExecutionMode = 16,
    OpTypeInt = 21,
    OpTypeFloat = 22,
    OpTypeVector = 23,
    OpTypeMatrix = 24,
    OpTypeImage = 25,
    OpTypeSampledImage = 27,
    OpTypeArray = 28,
    OpTypeRuntimeArray = 29,
    OpTypeStruct = 30,
    OpTypePointer = 32,
    OpConstant = 43,
    OpFunction = 54,
    OpFunctionCall = 57,
    OpVariable = 59,
    OpImageTexelPointer = 60,
    OpLoad = 61,
    OpAccessChain = 65,
    OpInBoundsAccessChain = 66,
    OpArrayLength = 68,
    OpDecorate = 71,
    OpMemberDecorate = 72,
    OpExecutionModeId = 331,
    OpTypeAccelerationStructureKHR = 5341,
};
enum Decoration : std::uint32_t {
    ArrayStride = 6,
    Location = 30,
    BindingNumber = 33,
    Offset = 35,
};
enum Storage : std::uint32_t {
    UniformConstant = 0,
    InputVariable = 1,
    Uniform = 2,
    OutputVariable = 3,
    PushConstant = 9,
    StorageBuffer = 12,
};
enum Mode : std::uint32_t { LocalSize = 17, LocalSizeId = 38 };

constexpr std::uint32_t kMagic = 0x07230203, kHeaderWords = 5;

using Operands = std::span<const std::uint32_t>;

struct Instruction {
    std::uint32_t op;
    Operands operands;
};

struct Variable {
    std::uint32_t id, pointer_type, storage;
};

std::string text_of(Operands words)
{
    const auto* begin = reinterpret_cast<const char*>(words.data());
    return {begin, std::find(begin, begin + words.size_bytes(), '\0')};
}

/// The module's instructions by what they are about.
class Reader {
public:
    explicit Reader(std::span<const std::uint32_t> words);
    Module module() const;

private:
    void read(const Instruction& instruction);
    void read_use(const Instruction& instruction);

    const Instruction& type(std::uint32_t id) const { return types_.at(id); }
    std::uint32_t pointee(const Variable& v) const { return type(v.pointer_type).operands[2]; }
    std::string name(std::uint32_t id) const;
    std::optional<std::uint32_t> decoration(std::uint32_t id, std::uint32_t which) const;

    Type describe(std::uint32_t id) const;
    Type describe_struct(std::uint32_t id) const;
    std::uint32_t only_member(std::uint32_t id) const;
    void add_binding(Module& module, const Variable& variable) const;
    void add_interface(Module& module, const Variable& variable) const;
    std::uint32_t group_size() const;
    void reach(std::uint32_t function);
    bool is_reached(std::uint32_t variable) const;

    std::uint32_t stage_ = 0, main_ = 0;
    std::uint32_t function_ = 0;                                     ///< that is being read
    std::map<std::uint32_t, std::set<std::uint32_t>> uses_, calls_;  ///< by function
    std::set<std::uint32_t> reached_;                                ///< functions, from main()
    std::uint32_t mode_ = 0;                 ///< how the group's size is given
    std::vector<std::uint32_t> group_size_;  ///< literals or ids of constants
    std::map<std::uint32_t, std::string> names_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> decorations_, offsets_;
    std::map<std::uint32_t, Instruction> types_;
    std::map<std::uint32_t, std::uint32_t> constants_;
    std::vector<Variable> variables_;
};

Reader::Reader(std::span<const std::uint32_t> words)
{
    if (words.size() < kHeaderWords || words[0] != kMagic)
        throw std::runtime_error("not SPIR-V");
    for (std::size_t at = kHeaderWords; at < words.size();) {
        const std::size_t length = words[at] >> 16;
        if (length == 0 || at + length > words.size())
            throw std::runtime_error("broken SPIR-V");
        read({words[at] & 0xffffu, words.subspan(at + 1, length - 1)});
        at += length;
    }
    reach(main_);
}

void Reader::reach(std::uint32_t function)
{
    if (!reached_.insert(function).second)
        return;
    if (const auto calls = calls_.find(function); calls != calls_.end())
        for (const std::uint32_t called : calls->second)
            reach(called);
}

bool Reader::is_reached(std::uint32_t variable) const
{
    return std::any_of(reached_.begin(), reached_.end(), [&](std::uint32_t function) {
        const auto uses = uses_.find(function);
        return uses != uses_.end() && uses->second.contains(variable);
    });
}

void Reader::read_use(const Instruction& instruction)
{
    const Operands o = instruction.operands;
    switch (instruction.op) {
    case OpFunction:
        function_ = o[1];
        break;
    case OpFunctionCall:
        calls_[function_].insert(o[2]);
        uses_[function_].insert(o.begin() + 3, o.end());
        break;
    case OpImageTexelPointer:
    case OpLoad:
    case OpAccessChain:
    case OpInBoundsAccessChain:
    case OpArrayLength:
        uses_[function_].insert(o[2]);
        break;
    default:
        break;
    }
}

void Reader::read(const Instruction& instruction)
{
    read_use(instruction);
    const Operands o = instruction.operands;
    switch (instruction.op) {
    case OpName:
        names_[o[0]] = text_of(o.subspan(1));
        break;
    case OpMemberName:
        member_names_[{o[0], o[1]}] = text_of(o.subspan(2));
        break;
    case OpEntryPoint:
        stage_ = o[0];
        main_ = o[1];
        break;
    case OpExecutionMode:
    case OpExecutionModeId:
        if (o[1] == LocalSize || o[1] == LocalSizeId) {
            mode_ = o[1];
            group_size_.assign(o.begin() + 2, o.end());
        }
        break;
    case OpDecorate:
        decorations_[{o[0], o[1]}] = o.size() > 2 ? o[2] : 0;
        break;
    case OpMemberDecorate:
        if (o[2] == Offset)
            offsets_[{o[0], o[1]}] = o[3];
        break;
    case OpConstant:
        constants_[o[1]] = o[2];
        break;
    case OpVariable:
        variables_.push_back({o[1], o[0], o[2]});
        break;
    case OpTypeAccelerationStructureKHR:
        types_[o[0]] = instruction;
        break;
    default:
        if (instruction.op >= OpTypeInt && instruction.op <= OpTypePointer)
            types_[o[0]] = instruction;
    }
}

std::string Reader::name(std::uint32_t id) const
{
    const auto found = names_.find(id);
    return found == names_.end() ? "" : found->second;
}

std::optional<std::uint32_t> Reader::decoration(std::uint32_t id, std::uint32_t which) const
{
    const auto found = decorations_.find({id, which});
    return found == decorations_.end() ? std::nullopt : std::optional(found->second);
}

Type vector_of(const Type& component, std::uint32_t count)
{
    const char* prefix = component.name == "float"           ? "glm::vec"
                         : component.name == "std::uint32_t" ? "glm::uvec"
                                                             : "glm::ivec";
    return {prefix + std::to_string(count), component.bytes * count, {}};
}

Type matrix_of(const Type& column, std::uint32_t count)
{
    const std::uint32_t rows = column.bytes / std::uint32_t(sizeof(float));
    if (rows != count)
        throw std::runtime_error("has a matrix that is not square");
    return {"glm::mat" + std::to_string(count), column.bytes * count, {}};
}

Type Reader::describe(std::uint32_t id) const
{
    const Instruction& is = type(id);
    const Operands o = is.operands;
    switch (is.op) {
    case OpTypeInt:
        return {o[2] != 0 ? "std::int32_t" : "std::uint32_t", o[1] / 8, {}};
    case OpTypeFloat:
        return {"float", o[1] / 8, {}};
    case OpTypeVector:
        return vector_of(describe(o[1]), o[2]);
    case OpTypeMatrix:
        return matrix_of(describe(o[1]), o[2]);
    case OpTypeArray: {
        const Type element = describe(o[1]);
        const std::uint32_t count = constants_.at(o[2]);
        return {"std::array<" + element.name + ", " + std::to_string(count) + ">",
                decoration(id, ArrayStride).value_or(element.bytes) * count,
                {}};
    }
    case OpTypeStruct:
        return describe_struct(id);
    default:
        throw std::runtime_error("has an array of elements that C++ has no type for");
    }
}

Type Reader::describe_struct(std::uint32_t id) const
{
    const Operands members = type(id).operands.subspan(1);
    Type result{"lumel::" + name(id), 0, {}};
    for (std::uint32_t i = 0; i < members.size(); ++i) {
        const std::uint32_t offset = offsets_.at({id, i});
        result.fields.push_back({member_names_.at({id, i}), offset});
        result.bytes = std::max(result.bytes, offset + describe(members[i]).bytes);
    }
    return result;
}

std::uint32_t Reader::only_member(std::uint32_t id) const
{
    const Operands members = type(id).operands.subspan(1);
    if (members.size() != 1)
        throw std::runtime_error("the block " + name(id) +
                                 " must have one member: an array, or a value of one type");
    return members[0];
}

/// An array's name and elements; a single value counts as an array of one.
void Reader::add_binding(Module& module, const Variable& variable) const
{
    const auto number = decoration(variable.id, BindingNumber);
    if (!number || !is_reached(variable.id))
        return;
    const std::uint32_t what = pointee(variable);
    if (type(what).op == OpTypeAccelerationStructureKHR) {
        module.bindings.push_back({*number, name(variable.id), Kind::tree, {}});
        return;
    }
    if (variable.storage == UniformConstant) {
        const std::uint32_t image =
            type(what).op == OpTypeSampledImage ? type(what).operands[1] : what;
        const bool floats = type(type(image).operands[1]).op == OpTypeFloat;
        module.bindings.push_back(
            {*number, name(variable.id), floats ? Kind::texture : Kind::uint_texture, {}});
        return;
    }
    const std::uint32_t member = only_member(what);
    const bool is_array = type(member).op == OpTypeArray || type(member).op == OpTypeRuntimeArray;
    Type element = describe(is_array ? type(member).operands[1] : member);
    if (is_array)
        element.bytes = decoration(member, ArrayStride).value_or(element.bytes);
    module.bindings.push_back({*number, member_names_.at({what, 0}),
                               variable.storage == Uniform ? Kind::constants : Kind::array,
                               element});
}

void Reader::add_interface(Module& module, const Variable& variable) const
{
    const auto location = decoration(variable.id, Location);
    if (!location)
        return;
    if (variable.storage == OutputVariable)
        module.has_color = module.has_color || module.stage == Stage::fragment;
    else if (module.stage == Stage::vertex) {
        const Type is = describe(pointee(variable));
        module.inputs.push_back({*location, name(variable.id), is.name, is.bytes / 4});
    }
}

std::uint32_t Reader::group_size() const
{
    std::vector<std::uint32_t> size = group_size_;
    if (mode_ == LocalSizeId)
        for (std::uint32_t& side : size)
            side = constants_.at(side);
    if (size.size() != 3 || size[1] != 1 || size[2] != 1)
        throw std::runtime_error("its groups must have one dimension");
    return size[0];
}

Module Reader::module() const
{
    Module module;
    module.stage = Stage(stage_);
    if (module.stage == Stage::compute)
        module.group_size = group_size();
    for (const Variable& variable : variables_) {
        if (variable.storage == UniformConstant || variable.storage == Uniform ||
            variable.storage == StorageBuffer)
            add_binding(module, variable);
        else if (variable.storage == InputVariable || variable.storage == OutputVariable)
            add_interface(module, variable);
        else if (variable.storage == PushConstant)
            module.params = describe(only_member(pointee(variable)));
    }
    std::sort(module.bindings.begin(), module.bindings.end(),
              [](const Binding& a, const Binding& b) { return a.number < b.number; });
    std::sort(module.inputs.begin(), module.inputs.end(),
              [](const Input& a, const Input& b) { return a.location < b.location; });
    return module;
}

}  // namespace

Module read_module(std::span<const std::uint32_t> words)
{
    return Reader(words).module();
}
