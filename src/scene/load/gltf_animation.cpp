// Animations of a glTF file: glTF 2.0, section 3.11, and KHR_animation_pointer.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>
#include <string_view>

#include "base/core/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/document.h"
#include "scene/load/gltf_nodes.h"
#include "scene/values/animation.h"

namespace lumel {

namespace {

constexpr Named<Interpolation> kInterpolations[] = {{"STEP", Interpolation::step},
                                                    {"LINEAR", Interpolation::linear},
                                                    {"CUBICSPLINE", Interpolation::cubic_spline}};

/// Tolerance for unit quaternions, which may have 8 bits per component.
constexpr double kUnitTolerance = 0.02;
constexpr const char* kPointer = "KHR_animation_pointer";
constexpr const char* kStrength = "KHR_materials_emissive_strength";

/// Kind of an animated property.
enum class Quantity { vector, rotation, colour, strength };

/// Accessor type of one value.
const char* type_of(Quantity quantity)
{
    if (quantity == Quantity::strength)
        return "SCALAR";
    return quantity == Quantity::rotation ? "VEC4" : "VEC3";
}

/// A material property addressed by a JSON pointer.
struct MaterialPointer {
    std::size_t material = 0;
    Quantity quantity = Quantity::colour;
};

/// Parses "/materials/3/emissiveFactor" and the strength; nullopt for other pointers.
std::optional<MaterialPointer> parse_pointer(const std::string& pointer)
{
    constexpr std::string_view kStart = "/materials/";
    if (!pointer.starts_with(kStart))
        return std::nullopt;
    MaterialPointer parsed;
    const char* const end = pointer.data() + pointer.size();
    const auto number = std::from_chars(pointer.data() + kStart.size(), end, parsed.material);
    const std::string_view rest(number.ptr, std::size_t(end - number.ptr));
    if (rest == std::string("/extensions/") + kStrength + "/emissiveStrength")
        parsed.quantity = Quantity::strength;
    else if (rest != "/emissiveFactor")
        return std::nullopt;
    return number.ec == std::errc() ? std::optional(parsed) : std::nullopt;
}

class AnimationReader {
public:
    AnimationReader(const GltfDocument& document, std::size_t index)
        : document_(document),
          root_(document.root()),
          view_(root_.get("animations").at(index))
    {
    }

    Animation read()
    {
        animation_.name = view_.string_or("name", "");
        read_nodes();
        view_.get("channels").each([&](const JsonView& channel, std::size_t) { read(channel); });
        for (const AnimatedNode& node : animation_.nodes)
            for (const auto* track : {&node.translation, &node.rotation, &node.scale})
                note_end(*track);
        for (const AnimatedMaterial& material : animation_.materials)
            for (const auto* track : {&material.factor, &material.strength})
                note_end(*track);
        if (ignored_ > 0)
            animation_.warnings.push_back(
                std::to_string(ignored_) + (ignored_ == 1 ? " channel" : " channels") +
                " of the animation left out: only translation, rotation and scale of nodes and "
                "the emission of materials are played");
        return std::move(animation_);
    }

private:
    void read_nodes()
    {
        const std::vector<int> parents = parents_of(root_);
        root_.each("nodes", [&](const JsonView& node, std::size_t i) {
            animation_.nodes.push_back({.parent = parents[i], .rest = read_place(node)});
        });
    }

    void note_end(const std::optional<Track>& track)
    {
        if (track)
            animation_.duration = std::max(animation_.duration, track->times.back());
    }

    void read(const JsonView& channel)
    {
        const JsonView target = channel.get("target");
        const std::string path = target.get("path").string();
        if (path == "pointer")
            read_pointer(channel, target);
        else if (path == "translation" || path == "rotation" || path == "scale")
            read_node(channel, target, path);
        else
            ++ignored_;
    }

    void read_node(const JsonView& channel, const JsonView& target, const std::string& path)
    {
        const auto reference = target.find("node");
        if (!reference)  // reserved for extensions
            return;
        AnimatedNode& node = animation_.nodes[reference->index(animation_.nodes.size(), "nodes")];
        if (node.rest.matrix)
            reference->fail("refers to a node that has a matrix, which cannot be animated");
        const bool turns = path == "rotation";
        set(path == "translation" ? node.translation : (turns ? node.rotation : node.scale),
            channel, turns ? Quantity::rotation : Quantity::vector);
    }

    void read_pointer(const JsonView& channel, const JsonView& target)
    {
        const auto extension = target.extension(kPointer);
        if (!extension)
            target.fail(std::string("has the path \"pointer\", but no ") + kPointer);
        const JsonView pointer = extension->get("pointer");
        const auto parsed = parse_pointer(pointer.string());
        if (!parsed) {
            ++ignored_;
            return;
        }
        if (parsed->material >= root_.count("materials"))
            pointer.fail("is " + quoted(pointer.string()) + ", but the file has " +
                         std::to_string(root_.count("materials")) + " materials");
        AnimatedMaterial& material = material_of(parsed->material);
        set(parsed->quantity == Quantity::strength ? material.strength : material.factor, channel,
            parsed->quantity);
    }

    AnimatedMaterial& material_of(std::size_t index)
    {
        auto& list = animation_.materials;
        const auto known = std::find_if(list.begin(), list.end(), [&](const AnimatedMaterial& m) {
            return m.material == int(index);
        });
        if (known != list.end())
            return *known;
        const JsonView view = root_.get("materials").at(index);
        glm::vec3 factor(0.0f);
        view.numbers("emissiveFactor", &factor.x, 3);
        const auto strength = view.extension(kStrength);
        list.push_back({.material = int(index),
                        .rest_factor = factor,
                        .rest_strength = strength
                                             ? double(strength->number_or("emissiveStrength", 1.0f))
                                             : 1.0});
        return list.back();
    }

    void set(std::optional<Track>& track, const JsonView& channel, Quantity quantity)
    {
        if (track)
            channel.get("target").fail("is the target of an earlier channel too");
        const JsonView index = channel.get("sampler");
        track = read_track(
            view_.get("samplers").at(index.index(view_.count("samplers"), "samplers")), quantity);
    }

    Track read_track(const JsonView& sampler, Quantity quantity) const
    {
        Track track;
        if (const auto mode = sampler.find("interpolation"))
            track.interpolation = named_by(*mode, kInterpolations);
        track.times = read_times(sampler.get("input"));
        const bool spline = track.interpolation == Interpolation::cubic_spline;
        track.values =
            read_values(sampler.get("output"), quantity, track.times.size() * (spline ? 3 : 1));
        check_values(sampler.get("output"), track, quantity);
        return track;
    }

    AccessorData accessor_of(const JsonView& index, const char* type) const
    {
        const AccessorData data =
            read_accessor(document_, index.index(root_.count("accessors"), "accessors"));
        if (data.type != type)
            index.fail("refers to an accessor of " + data.type + ", but needs " + type);
        if (data.component_type != ComponentType::f32 && !data.normalized)
            index.fail("refers to whole numbers that are not normalized");
        return data;
    }

    std::vector<double> read_times(const JsonView& index) const
    {
        const AccessorData data = accessor_of(index, "SCALAR");
        if (data.component_type != ComponentType::f32)
            index.fail("refers to times that are not floats");
        std::vector<double> times;
        for (const float time : to_floats(data)) {
            if (!(time >= 0.0f && std::isfinite(time)))
                index.fail("has a time that is negative or not finite");
            if (!times.empty() && !(double(time) > times.back()))
                index.fail("has times that do not rise at key " + std::to_string(times.size()));
            times.push_back(time);
        }
        return times;
    }

    std::vector<glm::dvec4> read_values(const JsonView& index, Quantity quantity,
                                        std::size_t count) const
    {
        const AccessorData data = accessor_of(index, type_of(quantity));
        if (data.count != count)
            index.fail("has " + std::to_string(data.count) + " values, but its keys need " +
                       std::to_string(count));
        const std::vector<float> numbers = to_floats(data);
        std::vector<glm::dvec4> values(count, glm::dvec4(0.0));
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (!std::isfinite(numbers[i]))
                index.fail("has a value that is not finite");
            values[i / data.components][glm::length_t(i % data.components)] = numbers[i];
        }
        return values;
    }

    static void check_values(const JsonView& index, const Track& track, Quantity quantity)
    {
        const bool spline = track.interpolation == Interpolation::cubic_spline;
        for (std::size_t key = 0; key < track.times.size(); ++key) {
            const glm::dvec4& value = track.values[spline ? 3 * key + 1 : key];
            const std::string name = "key " + std::to_string(key);
            if (quantity == Quantity::rotation &&
                !(std::abs(glm::length(value) - 1.0) <= kUnitTolerance))
                index.fail("is not a unit quaternion at " + name);
            if ((quantity == Quantity::colour || quantity == Quantity::strength) &&
                glm::any(glm::lessThan(value, glm::dvec4(0.0))))
                index.fail("emits a negative amount of light at " + name);
        }
    }

    const GltfDocument& document_;
    JsonView root_, view_;
    Animation animation_;
    std::size_t ignored_ = 0;
};

Animation read(const std::string& path, std::size_t index)
{
    const GltfDocument document = load_gltf_document(path);
    const std::size_t count = document.root().count("animations");
    if (count == 0)
        throw Error(ErrorKind::input, path, "has no animation");
    if (index >= count)
        throw Error(ErrorKind::input, path,
                    "has no animation " + std::to_string(index) + "; its animations are 0 to " +
                        std::to_string(count - 1));
    return AnimationReader(document, index).read();
}

}  // namespace

Animation read_animation(const std::string& path, std::size_t index)
{
    try {
        return read(path, index);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::input, path, "needs more memory than there is");
    }
}

}  // namespace lumel
