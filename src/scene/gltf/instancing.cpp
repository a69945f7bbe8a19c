#include "scene/gltf/instancing.h"

#include <array>
#include <cmath>
#include <utility>

#include <glm/glm.hpp>

#include "scene/gltf/accessor.h"
#include "scene/gltf/extensions.h"

namespace lumel {

namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
/// A node takes some hundred bytes, and many nodes of a small file may use one such list.
constexpr std::size_t kMaxInstances = std::size_t(1) << 20;
/// Tolerance for unit quaternions, which may have 8 bits per component.
constexpr double kTurnTolerance = 0.02;

/// A transform attribute of instances, and the node member it becomes.
struct Channel {
    const char* attribute;
    const char* member;
    const char* type;
    std::size_t components;
};
constexpr std::array<Channel, 3> kInstanceChannels = {{
    {"TRANSLATION", "translation", "VEC3", 3},
    {"ROTATION", "rotation", "VEC4", 4},
    {"SCALE", "scale", "VEC3", 3},
}};

/// Values of one channel for all instances.
struct Values {
    const Channel* channel = nullptr;
    std::vector<float> numbers;  ///< [instances][components]
};

/// Normalises quaternions stored as integers; floats are unchanged.
void normalise(const JsonView& view, std::vector<float>& numbers, bool floats)
{
    for (std::size_t i = 0; i < numbers.size(); i += 4) {
        const glm::dvec4 turn(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]);
        const double length = glm::length(turn);
        if (!(std::abs(length - 1.0) <= kTurnTolerance))
            view.fail("is not a unit quaternion at instance " + std::to_string(i / 4));
        for (int c = 0; !floats && c < 4; ++c)
            numbers[i + std::size_t(c)] = float(turn[c] / length);
    }
}

Values read_values(const GltfDocument& document, const JsonView& view, const Channel& channel)
{
    const JsonView root = document.root();
    const std::size_t index = view.index(root.count("accessors"), "accessors");
    if (!root.get("accessors").at(index).find("bufferView"))
        view.fail("refers to an accessor without data");
    const AccessorData data = read_accessor(document, index);
    if (data.type != channel.type)
        view.fail("refers to an accessor of " + data.type + ", but needs " + channel.type);
    const bool floats = data.component_type == ComponentType::f32;
    if (!floats && !data.normalized)
        view.fail("refers to whole numbers that are not normalized");
    Values values{&channel, to_floats(data)};
    for (std::size_t i = 0; i < values.numbers.size(); ++i)
        if (!std::isfinite(values.numbers[i]))
            view.fail("is not finite at instance " + std::to_string(i / channel.components));
    if (channel.components == 4)
        normalise(view, values.numbers, floats);
    return values;
}

/// The node of one instance, without its transform.
Json instance_of(const JsonView& node, std::size_t number)
{
    Json instance = Json::object();
    if (const auto name = node.find("name"))
        instance["name"] = name->string() + " " + std::to_string(number);
    for (const char* key : {"mesh", "skin", "weights"})
        if (const auto member = node.find(key))
            instance[key] = member->json();
    const auto extras = node.find("extras");
    if (extras && extras->json().is_object() && extras->json().contains("lumel"))
        instance["extras"]["lumel"] = extras->json()["lumel"];
    return instance;
}

/// A node with its instances.
struct Crowd {
    std::size_t node = 0;
    std::vector<Json> instances;
};

Crowd read_crowd(const GltfDocument& document, const JsonView& node, std::size_t index,
                 std::size_t room)
{
    const JsonView attributes = node.extension(kInstancing)->get("attributes");
    std::vector<Values> channels;
    std::size_t count = 0;
    for (const Channel& channel : kInstanceChannels) {
        const auto view = attributes.find(channel.attribute);
        if (!view)
            continue;
        channels.push_back(read_values(document, *view, channel));
        const std::size_t length = channels.back().numbers.size() / channel.components;
        if (count != 0 && length != count)
            view->fail("has " + std::to_string(length) + " instances, but another attribute has " +
                       std::to_string(count));
        count = length;
    }
    if (channels.empty())
        attributes.fail("has no TRANSLATION, ROTATION or SCALE");
    if (count > room)
        attributes.fail("makes more than " + std::to_string(kMaxInstances) +
                        " instances in the file");
    node.count("children");  // throws unless it is a list or absent

    Crowd crowd{index, {}};
    for (std::size_t i = 0; i < count && node.find("mesh"); ++i) {
        Json& instance = crowd.instances.emplace_back(instance_of(node, i + 1));
        for (const Values& values : channels) {
            Json place = Json::array();
            for (std::size_t c = 0; c < values.channel->components; ++c)
                place.push_back(double(values.numbers[i * values.channel->components + c]));
            instance[values.channel->member] = std::move(place);
        }
    }
    return crowd;
}

}  // namespace

void expand_instances(GltfDocument& document)
{
    // JsonViews refer to locations in the JSON, so it changes only after all nodes are read.
    std::vector<Crowd> crowds;
    std::size_t room = kMaxInstances;
    document.root().each("nodes", [&](const JsonView& node, std::size_t i) {
        if (!node.extension(kInstancing))
            return;
        crowds.push_back(read_crowd(document, node, i, room));
        room -= crowds.back().instances.size();
    });
    for (Crowd& crowd : crowds) {
        Json& nodes = document.json["nodes"];
        for (Json& instance : crowd.instances) {
            nodes[crowd.node]["children"].push_back(nodes.size());
            nodes.push_back(std::move(instance));
        }
        for (const char* key : {"mesh", "skin", "weights"})
            nodes[crowd.node].erase(key);
        erase_extension(nodes[crowd.node], kInstancing);
    }
    forget_extension(document.json, kInstancing);
}

}  // namespace lumel
