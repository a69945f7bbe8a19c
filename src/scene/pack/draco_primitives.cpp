#include "scene/pack/draco_primitives.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "base/core/parallel.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/page_parts.h"

namespace lumel {
namespace {

// Steps are powers of two, and multiples of them are exact: corners at round coordinates stay, and
// vertices that primitives of a mesh share remain at one position, without gaps.

/// Of positions, along the longest side of a mesh, at least: 0.03 mm in a room of 8 m, 1/32 of a
/// pixel of an image of 8192 that shows all of it.
constexpr double kPositionSteps = 1 << 18;
/// Of lightmap coordinates: 1/64 of a texel of the largest lightmap, 16384 texels.
constexpr double kLightmapStep = 1.0 / (1 << 20);
/// Of other texture coordinates: 1/16 of a texel of 4096.
constexpr double kTextureStep = 1.0 / (1 << 16);
/// Of colours: 1/16 of the step of 8 bits.
constexpr double kColorStep = 1.0 / (1 << 12);
/// Of tangents: 0.02 degrees apart.
constexpr double kTangentStep = 1.0 / (1 << 12);
/// Of octahedral normals: off by 0.02 degrees at most.
constexpr int kNormalBits = 14;

/// Draco counts steps in floats, which are exact up to 2^24.
constexpr int kMaxGridBits = 24;
constexpr std::size_t kMaxComponents = 4;
constexpr std::int64_t kTriangleList = 4;
constexpr std::size_t kJsonOfStream = 160;  // bytes that a packed primitive adds, about

using Kind = DracoInput::Kind;

bool is_float(const AccessorData& data)
{
    return data.component_type == ComponentType::f32;
}

Kind kind_of(const std::string& name)
{
    if (name == "POSITION")
        return Kind::position;
    if (name == "NORMAL")
        return Kind::normal;
    if (name.starts_with("TEXCOORD_"))
        return Kind::texcoord;
    return name.starts_with("COLOR_") ? Kind::color : Kind::other;
}

/// 0: exact.
double step_of(const std::string& name, double position_step)
{
    switch (kind_of(name)) {
    case Kind::position:
        return position_step;
    case Kind::texcoord:
        return name == "TEXCOORD_1" ? kLightmapStep : kTextureStep;
    case Kind::color:
        return kColorStep;
    default:
        return name == "TANGENT" ? kTangentStep : 0.0;
    }
}

/// Smallest and largest of each component.
std::pair<std::vector<float>, std::vector<float>> range_of(const AccessorData& data)
{
    const std::vector<float> values = to_floats(data);
    std::vector<float> min(values.begin(), values.begin() + std::ptrdiff_t(data.components));
    std::vector<float> max = min;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t c = i % data.components;
        min[c] = std::min(min[c], values[i]);
        max[c] = std::max(max[c], values[i]);
    }
    return {min, max};
}

/// Empty if the range has too many steps: the values stay exact.
std::optional<DracoGrid> grid_of(const AccessorData& data, double step)
{
    const auto [min, max] = range_of(data);
    DracoGrid grid{.origin = {}, .step = float(step), .bits = 1};
    double most = 1.0;
    for (std::size_t c = 0; c < data.components; ++c) {
        grid.origin.push_back(float(std::floor(double(min[c]) / step) * step));
        most = std::max(most, std::ceil((double(max[c]) - double(grid.origin[c])) / step));
    }
    if (most >= double(1 << kMaxGridBits))
        return std::nullopt;
    grid.bits = int(std::bit_width(std::uint32_t(most)));
    return grid;
}

/// Reads a primitive; decides how its attributes are rounded.
class Packer {
public:
    explicit Packer(const GltfDocument& document) : document_(document)
    {
        for_primitives([&](const Json& primitive, std::size_t, std::size_t) {
            for (const std::size_t accessor : accessors_of(primitive))
                ++uses_[accessor];
        });
    }

    std::vector<PackedPrimitive> pack() const
    {
        std::vector<Candidate> candidates;
        for_primitives([&](const Json& primitive, std::size_t m, std::size_t p) {
            if (is_packable(primitive))
                candidates.push_back({.json = &primitive, .mesh = m, .index = p});
        });
        std::map<std::size_t, double> steps;
        for (const Candidate& one : candidates)
            if (!steps.contains(one.mesh))
                steps[one.mesh] = position_step(one.mesh);
        std::vector<std::optional<PackedPrimitive>> packed(candidates.size());
        parallel_for(candidates.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                packed[i] = pack(candidates[i], steps.at(candidates[i].mesh));
        });
        std::vector<PackedPrimitive> smaller;
        for (std::optional<PackedPrimitive>& one : packed)
            if (one)
                smaller.push_back(std::move(*one));
        return smaller;
    }

private:
    struct Candidate {
        const Json* json = nullptr;
        std::size_t mesh = 0, index = 0;
    };

    template <class Visit>
    void for_primitives(const Visit& visit) const
    {
        if (!document_.json.contains("meshes"))
            return;
        const Json& meshes = document_.json["meshes"];
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            const Json& primitives = meshes[m].at("primitives");
            for (std::size_t p = 0; p < primitives.size(); ++p)
                visit(primitives[p], m, p);
        }
    }

    static std::vector<std::size_t> accessors_of(const Json& primitive)
    {
        std::vector<std::size_t> accessors;
        for (const auto& [name, accessor] : primitive.at("attributes").items())
            accessors.push_back(index_of(accessor));
        if (primitive.contains("indices"))
            accessors.push_back(index_of(primitive["indices"]));
        if (primitive.contains("targets"))
            for (const Json& target : primitive["targets"])
                for (const auto& [name, accessor] : target.items())
                    accessors.push_back(index_of(accessor));
        return accessors;
    }

    static bool is_packable(const Json& primitive)
    {
        return primitive.value("mode", kTriangleList) == kTriangleList && !is_part(primitive) &&
               !primitive.contains("targets") && primitive.at("attributes").contains("POSITION");
    }

    /// Of all primitives of a mesh.
    double position_step(std::size_t mesh) const
    {
        float extent = 0.0f;
        std::vector<float> min, max;
        for (const Json& primitive : document_.json["meshes"][mesh]["primitives"]) {
            if (!is_packable(primitive))
                continue;
            const auto [from, to] =
                range_of(read_accessor(document_, index_of(primitive["attributes"]["POSITION"])));
            if (min.empty())
                min = from, max = to;
            for (std::size_t c = 0; c < std::min(min.size(), from.size()); ++c) {
                min[c] = std::min(min[c], from[c]);
                max[c] = std::max(max[c], to[c]);
                extent = std::max(extent, max[c] - min[c]);
            }
        }
        return extent > 0.0f && std::isfinite(extent)
                   ? std::exp2(std::floor(std::log2(double(extent)))) / kPositionSteps
                   : 0.0;
    }

    std::optional<PackedPrimitive> pack(const Candidate& one, double position_step) const
    {
        PackedPrimitive packed{
            .mesh = one.mesh, .primitive = one.index, .attributes = {}, .encoded = {}};
        std::map<std::size_t, std::uint32_t> ids;  // by accessor
        std::vector<DracoInput> inputs;
        std::vector<double> steps;
        double plain_bytes = 0.0;
        for (const auto& [name, reference] : (*one.json)["attributes"].items()) {
            const std::size_t accessor = index_of(reference);
            const double step = step_of(name, position_step);
            const auto [known, is_new] = ids.try_emplace(accessor, std::uint32_t(inputs.size()));
            packed.attributes.push_back({.name = name,
                                         .id = known->second,
                                         .accessor = document_.json["accessors"][accessor]});
            if (!is_new) {
                steps[known->second] = std::min(steps[known->second], step);
                continue;
            }
            inputs.push_back(
                {.kind = kind_of(name), .data = read_accessor(document_, accessor), .grid = {}});
            steps.push_back(step);
            plain_bytes += share_of(accessor, inputs.back().data);
        }
        if (!are_sound(inputs))
            return std::nullopt;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            DracoInput& input = inputs[i];
            if (input.kind == Kind::normal && is_float(input.data))
                input.normal_bits = kNormalBits;
            else if (is_float(input.data) && steps[i] > 0.0)
                input.grid = grid_of(input.data, steps[i]);
        }
        const std::optional<std::vector<std::uint32_t>> indices =
            indices_of(*one.json, inputs.front().data.count, plain_bytes);
        if (!indices)
            return std::nullopt;
        std::optional<EncodedDraco> encoded = encode_draco(*indices, inputs);
        if (!encoded || double(encoded->stream.size() + kJsonOfStream) >= plain_bytes)
            return std::nullopt;
        packed.encoded = std::move(*encoded);
        return packed;
    }

    /// Bytes that an accessor takes for each of its uses.
    double share_of(std::size_t accessor, const AccessorData& data) const
    {
        return double(data.bytes.size()) / double(uses_.at(accessor));
    }

    /// True for finite vectors, as many of each attribute.
    static bool are_sound(const std::vector<DracoInput>& inputs)
    {
        return std::ranges::all_of(inputs, [&](const DracoInput& input) {
            const AccessorData& data = input.data;
            return data.count == inputs.front().data.count && data.components <= kMaxComponents &&
                   !data.type.starts_with("MAT") &&
                   (!is_float(data) || std::ranges::all_of(to_floats(data), [](float value) {
                       return std::isfinite(value);
                   }));
        });
    }

    /// Empty if they are no triangles of the vertices. Adds their bytes.
    std::optional<std::vector<std::uint32_t>> indices_of(const Json& primitive,
                                                         std::size_t vertices, double& bytes) const
    {
        std::vector<std::uint32_t> indices(vertices);
        if (primitive.contains("indices")) {
            const std::size_t accessor = index_of(primitive["indices"]);
            const AccessorData data = read_accessor(document_, accessor);
            bytes += share_of(accessor, data);
            indices = to_unsigned(data);
        } else {
            std::iota(indices.begin(), indices.end(), 0u);
        }
        if (indices.empty() || indices.size() % 3 != 0 || std::ranges::max(indices) >= vertices)
            return std::nullopt;
        return indices;
    }

    const GltfDocument& document_;
    std::map<std::size_t, std::size_t> uses_;  ///< by primitives, of accessors
};

}  // namespace

std::vector<PackedPrimitive> pack_primitives(const GltfDocument& document)
{
    return Packer(document).pack();
}

}  // namespace lumel
