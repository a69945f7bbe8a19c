#include "scene/load/gltf_attributes.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf/accessor.h"
#include "scene/gltf/extensions.h"
#include "scene/values/geometry_checks.h"

namespace lumel {

namespace {

/// 8- and 16-bit integers that only KHR_mesh_quantization allows.
enum class Quantized { none, normalized_signed, all };

/// Allowed types and formats of an attribute, besides floats.
struct AttributeRule {
    const char* types;         ///< "VEC3" or "VEC3 VEC4"
    bool normalized_unsigned;  ///< normalised 8- and 16-bit unsigned integers
    Quantized quantized;
};

constexpr AttributeRule kPositionRule{"VEC3", false, Quantized::all};
constexpr AttributeRule kNormalRule{"VEC3", false, Quantized::normalized_signed};
constexpr AttributeRule kTexcoordRule{"VEC2", true, Quantized::all};
constexpr AttributeRule kColorRule{"VEC3 VEC4", true, Quantized::none};

bool allows(const AttributeRule& rule, const AccessorData& data, bool quantization)
{
    const ComponentType type = data.component_type;
    if (type == ComponentType::f32 || type == ComponentType::u32)
        return type == ComponentType::f32;
    const bool is_unsigned = type == ComponentType::u8 || type == ComponentType::u16;
    if (rule.normalized_unsigned && is_unsigned && data.normalized)
        return true;
    return quantization &&
           (rule.quantized == Quantized::all ||
            (rule.quantized == Quantized::normalized_signed && !is_unsigned && data.normalized));
}

void check_rule(const JsonView& view, const AccessorData& data, const AttributeRule& rule,
                bool quantization)
{
    if (std::string(rule.types).find(data.type) == std::string::npos || data.type.size() != 4)
        view.fail("refers to an accessor of type " + data.type + ", but needs " + rule.types);
    if (!allows(rule, data, quantization))
        view.fail("refers to an accessor with component type " +
                  std::to_string(static_cast<int>(data.component_type)) +
                  (data.normalized ? " (normalized)" : "") + ", which this attribute cannot have" +
                  (quantization ? "" : " without KHR_mesh_quantization"));
}

/// The attributes of one primitive or morph target.
class AttributeSet {
public:
    AttributeSet(const GltfDocument& document, const JsonView& attributes)
        : document_(document),
          attributes_(attributes),
          quantization_(uses_extension(document.root(), "KHR_mesh_quantization"))
    {
        attributes.as_object();
    }

    /// Vectors of N floats; empty if the attribute is absent.
    template <int N>
    std::vector<glm::vec<N, float>> read(const char* name, const AttributeRule& rule) const
    {
        const auto view = attributes_.find(name);
        if (!view)
            return {};
        const std::size_t accessor = view->index(document_.root().count("accessors"), "accessors");
        const AccessorData data = read_accessor(document_, accessor);
        check_rule(*view, data, rule, quantization_);
        const std::vector<float> floats = to_floats(data);
        std::vector<glm::vec<N, float>> vectors(data.count, glm::vec<N, float>(1.0f));
        for (std::size_t i = 0; i < data.count; ++i)
            for (std::size_t c = 0; c < std::min<std::size_t>(N, data.components); ++c)
                vectors[i][int(c)] = floats[i * data.components + c];
        return vectors;
    }

    /// Reads finite vectors of the given number, else throws.
    template <int N>
    std::vector<glm::vec<N, float>> read_finite(const char* name, const AttributeRule& rule,
                                                std::size_t length) const
    {
        const auto vectors = read<N>(name, rule);
        for (std::size_t i = 0; i < vectors.size(); ++i)
            for (int c = 0; c < N; ++c)
                if (!std::isfinite(vectors[i][c]))
                    fail(name, "element " + std::to_string(i) + " is " +
                                   (std::isnan(vectors[i][c]) ? "not a number" : "infinite"));
        check_length(name, vectors.size(), length);
        return vectors;
    }

    void check_length(const char* name, std::size_t length, std::size_t expected) const
    {
        if (length != 0 && length != expected)
            fail(name, "has " + std::to_string(length) + " elements, but POSITION has " +
                           std::to_string(expected));
    }

    [[noreturn]] void fail(const char* name, const std::string& what) const
    {
        attributes_.get(name).fail(what);
    }

private:
    const GltfDocument& document_;
    JsonView attributes_;
    bool quantization_;
};

/// Adds the morph targets at their default weights (the rest pose).
void apply_morph_targets(const GltfDocument& document, const JsonView& view,
                         const std::vector<float>& weights, Primitive& primitive)
{
    view.each("targets", [&](const JsonView& target, std::size_t i) {
        const float weight = i < weights.size() ? weights[i] : 0.0f;
        if (weight == 0.0f)
            return;
        const AttributeSet set(document, target);
        const std::size_t count = primitive.positions.size();
        const auto moves = set.read_finite<3>("POSITION", kPositionRule, count);
        const auto turns = set.read_finite<3>("NORMAL", kNormalRule, count);
        for (std::size_t v = 0; v < moves.size(); ++v)
            primitive.positions[v] += weight * moves[v];
        for (std::size_t v = 0; v < std::min(turns.size(), primitive.normals.size()); ++v)
            primitive.normals[v] += weight * turns[v];
    });
}

}  // namespace

void read_attributes(const GltfDocument& document, const JsonView& view,
                     const std::vector<float>& weights, Primitive& primitive)
{
    const AttributeSet set(document, view.get("attributes"));
    primitive.positions = set.read<3>("POSITION", kPositionRule);
    const std::size_t count = primitive.positions.size();
    if (count == 0)
        view.fail("has no POSITION attribute");
    primitive.normals = set.read<3>("NORMAL", kNormalRule);
    set.check_length("NORMAL", primitive.normals.size(), count);
    for (int i = 0; i < kTexcoordSets; ++i)
        primitive.texcoords[i] =
            set.read_finite<2>(("TEXCOORD_" + std::to_string(i)).c_str(), kTexcoordRule, count);
    primitive.colors = set.read_finite<4>("COLOR_0", kColorRule, count);
    apply_morph_targets(document, view, weights, primitive);

    for (std::size_t i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(primitive.positions[i][c]) <= kLargestCoordinate)) {
                const float value = primitive.positions[i][c];
                set.fail("POSITION", "vertex " + std::to_string(i) +
                                         (std::isnan(value) ? " is not a number"
                                          : std::isinf(value)
                                              ? " is infinite"
                                              : " lies beyond 1e9, too far out to be computed"));
            }
}

}  // namespace lumel
