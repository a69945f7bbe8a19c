#include "results/files/vertex_gather.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr std::size_t kVertexAlignment = 4;  // per vertex

std::size_t stride_of(const AccessorData& data)
{
    return (data.element_size + kVertexAlignment - 1) / kVertexAlignment * kVertexAlignment;
}

template <class T>
double component_as(const std::uint8_t* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
}

// The stored number, not normalised, as for glTF's min and max.
double component(ComponentType type, const std::uint8_t* element, std::size_t c)
{
    switch (type) {
    case ComponentType::i8:
        return component_as<std::int8_t>(element + c);
    case ComponentType::u8:
        return component_as<std::uint8_t>(element + c);
    case ComponentType::i16:
        return component_as<std::int16_t>(element + c * 2);
    case ComponentType::u16:
        return component_as<std::uint16_t>(element + c * 2);
    case ComponentType::u32:
        return component_as<std::uint32_t>(element + c * 4);
    case ComponentType::f32:
        break;
    }
    return component_as<float>(element + c * 4);
}

template <class T>
void negate_as(std::uint8_t* bytes)
{
    // The minimum integer has no negative.
    const double value = std::max(component_as<T>(bytes), -double(std::numeric_limits<T>::max()));
    const T negated = static_cast<T>(-value);
    std::memcpy(bytes, &negated, sizeof negated);
}

// For signed formats, as of directions.
void negate(ComponentType type, std::uint8_t* element, std::size_t c)
{
    if (type == ComponentType::i8)
        negate_as<std::int8_t>(element + c);
    else if (type == ComponentType::i16)
        negate_as<std::int16_t>(element + c * 2);
    else if (type == ComponentType::f32)
        negate_as<float>(element + c * 4);
}

}  // namespace

void add_bounds(Json& accessor, ComponentType type, std::size_t components,
                std::span<const std::uint8_t> bytes, std::size_t stride)
{
    Json low = Json::array(), high = Json::array();
    for (std::size_t c = 0; c < components; ++c) {
        double least = component(type, bytes.data(), c), most = least;
        for (std::size_t at = stride; at < bytes.size(); at += stride) {
            const double value = component(type, bytes.data() + at, c);
            least = std::min(least, value);
            most = std::max(most, value);
        }
        const bool whole = type != ComponentType::f32;
        low.push_back(whole ? Json(std::int64_t(least)) : Json(least));
        high.push_back(whole ? Json(std::int64_t(most)) : Json(most));
    }
    accessor["min"] = low;
    accessor["max"] = high;
}

const AccessorData& VertexGather::data_of(std::size_t accessor)
{
    const auto [place, is_new] = read_.try_emplace(accessor);
    if (is_new)
        place->second = read_accessor(builder_.document(), accessor);
    return place->second;
}

std::size_t VertexGather::gather(const Json& accessor, const std::vector<std::uint32_t>& vertices,
                                 const std::string& semantic)
{
    return gather(accessor, vertices, semantic, false);
}

std::size_t VertexGather::gather_turned(const Json& accessor,
                                        const std::vector<std::uint32_t>& vertices,
                                        const std::string& semantic)
{
    return gather(accessor, vertices, semantic, semantic == "NORMAL" || semantic == "TANGENT");
}

std::size_t VertexGather::gather(const Json& accessor, const std::vector<std::uint32_t>& vertices,
                                 const std::string& semantic, bool negated)
{
    const auto source = index_of(accessor);
    const std::size_t order = orders_.try_emplace(vertices, orders_.size()).first->second;
    const bool with_bounds = semantic == "POSITION" && !vertices.empty();
    const auto [place, is_new] = gathered_.try_emplace({source, order, with_bounds, negated});
    if (is_new)
        place->second = add_gathered(source, vertices, with_bounds, negated);
    return place->second;
}

std::size_t VertexGather::add_gathered(std::size_t source, std::span<const std::uint32_t> vertices,
                                       bool with_bounds, bool negated)
{
    const AccessorData& data = data_of(source);
    const std::size_t stride = stride_of(data);
    std::vector<std::uint8_t> bytes(vertices.size() * stride);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i] >= data.count)
            throw Error(ErrorKind::input, builder_.document().path,
                        "has changed while it was baked; bake it again");
        std::memcpy(bytes.data() + i * stride, data.bytes.data() + vertices[i] * data.element_size,
                    data.element_size);
        for (std::size_t c = 0; negated && c < data.components; ++c)
            negate(data.component_type, bytes.data() + i * stride, c);
    }

    // Keeps the other properties of the accessor: format, name and extras.
    Json gathered = builder_.document().json.at("accessors")[source];
    for (const char* key : {"byteOffset", "sparse", "min", "max"})
        gathered.erase(key);
    gathered["count"] = vertices.size();
    gathered["bufferView"] = builder_.add_view(bytes, ViewTarget::vertices, stride);
    if (with_bounds)
        add_bounds(gathered, data.component_type, data.components, bytes, stride);
    return builder_.add_accessor(std::move(gathered));
}

std::size_t VertexGather::add_texcoords(std::span<const glm::vec2> texcoords)
{
    std::vector<std::uint8_t> bytes(texcoords.size_bytes());
    std::memcpy(bytes.data(), texcoords.data(), bytes.size());
    const std::size_t view = builder_.add_view(bytes, ViewTarget::vertices, sizeof(glm::vec2));
    return builder_.add_accessor({{"bufferView", view},
                                  {"componentType", int(ComponentType::f32)},
                                  {"count", texcoords.size()},
                                  {"type", "VEC2"}});
}

std::size_t VertexGather::add_indices(const std::vector<std::uint32_t>& indices,
                                      std::size_t vertex_count)
{
    const bool is_short = vertex_count <= kShortIndexLimit;
    const auto [place, is_new] = indices_.try_emplace({indices, is_short});
    if (!is_new)
        return place->second;
    std::vector<std::uint8_t> bytes(indices.size() * (is_short ? 2 : 4));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto narrow = static_cast<std::uint16_t>(indices[i]);
        if (is_short)
            std::memcpy(bytes.data() + i * 2, &narrow, 2);
        else
            std::memcpy(bytes.data() + i * 4, &indices[i], 4);
    }
    const std::size_t view = builder_.add_view(bytes, ViewTarget::indices);
    const ComponentType type = is_short ? ComponentType::u16 : ComponentType::u32;
    place->second = builder_.add_accessor({{"bufferView", view},
                                           {"componentType", int(type)},
                                           {"count", indices.size()},
                                           {"type", "SCALAR"}});
    return place->second;
}

}  // namespace lumel
