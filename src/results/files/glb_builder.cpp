#include "results/files/glb_builder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/core/error.h"
#include "base/images/image_files.h"
#include "results/files/vertex_gather.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/draco.h"
#include "scene/gltf/extras.h"
#include "scene/gltf/meshopt.h"
#include "scene/gltf/page_parts.h"
#include "scene/gltf/webp.h"
#include "scene/load/webp_image.h"

namespace lumel {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"
constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::size_t kChunkAlignment = 4;     // alignment of chunks and of views, for floats
constexpr std::size_t kJsonOfExtension = 160;  // bytes that a compressed view adds, about
constexpr int kLinear = 9729, kClampToEdge = 33071;

// Placeholders for released elements without a successor; nothing refers to them.
const Json kEmptyAccessor = {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
const Json kEmptyView = {{"buffer", 0}, {"byteLength", 1}};

// Ignores values that are not indices: extras and unknown extensions can use the same names.
void insert_index(const Json& parent, const char* key, std::set<std::size_t>& indices)
{
    const auto found = parent.find(key);
    if (found == parent.end())
        return;
    if (const auto index = whole_number(*found); index && *index >= 0)
        indices.insert(std::size_t(*index));
}

void insert_members(const Json& parent, const char* key, std::set<std::size_t>& indices)
{
    const auto found = parent.find(key);
    if (found != parent.end() && found->is_object())
        for (const auto& [name, index] : found->items())
            insert_index(*found, name.c_str(), indices);
}

/// Removes indices from `size` on, which parts of the file that are not read can have.
void drop_from(std::set<std::size_t>& indices, std::size_t size)
{
    indices.erase(indices.lower_bound(size), indices.end());
}

const Json& list(const Json& parent, const char* key)
{
    static const Json kNone = Json::array();
    const auto found = parent.find(key);
    return found != parent.end() && found->is_array() ? *found : kNone;
}

std::set<std::size_t> used_views(const Json& json)
{
    std::set<std::size_t> views;
    for_objects(json, [&](const Json& object) { insert_index(object, "bufferView", views); });
    if (const auto lamps = lamps_view_in_extras(json))
        views.insert(*lamps);
    return views;
}

std::size_t bytes_of_index(const Json& accessor)
{
    switch (ComponentType(accessor.at("componentType").get<int>())) {
    case ComponentType::u32:
        return 4;
    case ComponentType::u16:
        return 2;
    default:
        return 1;
    }
}

/// Bytes of an index, by the bufferViews of indices.
std::map<std::size_t, std::size_t> sizes_of_indices(const Json& json)
{
    std::map<std::size_t, std::size_t> sizes;
    for (const Json& mesh : list(json, "meshes"))
        for (const Json& primitive : list(mesh, "primitives")) {
            if (!primitive.contains("indices"))
                continue;
            const Json& accessor = json.at("accessors").at(index_of(primitive["indices"]));
            if (accessor.contains("bufferView"))
                sizes[index_of(accessor["bufferView"])] = bytes_of_index(accessor);
        }
    return sizes;
}

std::string mime_type_of(const Bytes& file)
{
    struct Signature {
        std::string_view bytes;
        std::size_t offset;
        const char* type;
    };
    constexpr std::array<Signature, 4> kSignatures = {{
        {"\x89PNG", 0, "image/png"},
        {"\xFF\xD8\xFF", 0, "image/jpeg"},
        {"WEBP", 8, "image/webp"},
        {"\xABKTX 20\xBB", 0, "image/ktx2"},
    }};
    for (const Signature& s : kSignatures)
        if (file.size() >= s.offset + s.bytes.size() &&
            std::memcmp(file.data() + s.offset, s.bytes.data(), s.bytes.size()) == 0)
            return s.type;
    return {};
}

/// A WebP image as PNG, as plain glTF lacks WebP; empty for other formats or if decoding fails.
std::optional<Bytes> plain_picture(const Bytes& file, const std::string& place)
{
    if (!is_webp(file))
        return std::nullopt;
    try {
        const Texture texture = decode_webp(file, place);
        return encode_png(texture.rgba, texture.width, texture.height);
    } catch (const Error&) {
        return std::nullopt;  // the scene was read without it, so light does not depend on it
    }
}

void append_word(std::vector<std::uint8_t>& out, std::size_t word)
{
    for (int shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<std::uint8_t>(word >> shift));
}

std::size_t aligned(std::size_t size)
{
    return (size + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment;
}

void pad(std::vector<std::uint8_t>& out, std::uint8_t filler)
{
    out.resize(aligned(out.size()), filler);
}

std::size_t put(Json& array, std::set<std::size_t>& free, Json value)
{
    if (free.empty()) {
        array.push_back(std::move(value));
        return array.size() - 1;
    }
    const std::size_t index = *free.begin();
    free.erase(free.begin());
    array[index] = std::move(value);
    return index;
}

}  // namespace

std::set<std::size_t> used_accessors(const Json& json)
{
    std::set<std::size_t> used;
    for (const Json& mesh : list(json, "meshes"))
        for (const Json& primitive : list(mesh, "primitives")) {
            insert_members(primitive, "attributes", used);
            insert_index(primitive, "indices", used);
            for (const std::size_t part : accessors_of_parts(primitive))
                used.insert(part);
            for (const Json& target : list(primitive, "targets"))
                for (const auto& [name, index] : target.items())
                    insert_index(target, name.c_str(), used);
        }
    for (const Json& skin : list(json, "skins"))
        insert_index(skin, "inverseBindMatrices", used);
    for (const Json& animation : list(json, "animations"))
        for (const Json& sampler : list(animation, "samplers")) {
            insert_index(sampler, "input", used);
            insert_index(sampler, "output", used);
        }
    return used;
}

std::set<std::size_t> images_of(const Json& texture)
{
    std::set<std::size_t> images;
    for_objects(texture, [&](const Json& object) { insert_index(object, "source", images); });
    return images;
}

GlbBuilder::GlbBuilder(const GltfDocument& document) : json(document.json), document_(document) {}

void GlbBuilder::release(Pictures pictures)
{
    is_webp_.assign(list(json, "images").size(), false);
    look_at_images(pictures);
    free_accessors_ = free_elements("accessors", kEmptyAccessor, used_accessors);
    free_views_ = free_elements("bufferViews", kEmptyView, used_views);
    copy_views();
    embed_images(pictures);
}

/// Finds WebP images in buffers, and unpacks them for Pictures::plain.
void GlbBuilder::look_at_images(Pictures pictures)
{
    const auto images = json.find("images");
    for (std::size_t i = 0; i < is_webp_.size(); ++i) {
        Json& image = (*images)[i];
        if (!image.contains("bufferView"))
            continue;
        const JsonView view(document_.path, image, "/images/" + std::to_string(i));
        try {
            const Bytes file = buffer_view_bytes(document_, view.get("bufferView"));
            auto png =
                pictures == Pictures::plain ? plain_picture(file, view.place()) : std::nullopt;
            is_webp_[i] = !png && is_webp(file);
            if (png) {
                image.erase("bufferView");
                unpacked_images_[i] = std::move(*png);
            }
        } catch (const Error&) {  // see embed_images()
        }
    }
}

/// Empties the elements of a list that only the document uses; returns their indices.
std::set<std::size_t> GlbBuilder::free_elements(const char* name, const Json& empty,
                                                std::set<std::size_t> (*used_in)(const Json&))
{
    std::set<std::size_t> free = used_in(document_.json);
    drop_from(free, list(json, name).size());
    for (const std::size_t live : used_in(json))
        free.erase(live);
    for (const std::size_t element : free)
        json[name][element] = empty;
    return free;
}

void GlbBuilder::copy_views()
{
    // Views of the same bytes stay shared.
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::size_t> copied;
    const auto views = json.find("bufferViews");
    for (std::size_t i = 0; views != json.end() && i < views->size(); ++i) {
        Json& view = (*views)[i];
        if (free_views_.contains(i))
            continue;
        const auto buffer = view.at("buffer").get<std::size_t>();
        const auto offset = view.value("byteOffset", std::size_t(0));
        const auto length = view.at("byteLength").get<std::size_t>();
        const auto [place, is_new] = copied.try_emplace({buffer, offset, length});
        if (is_new)
            place->second = append(std::span(document_.buffers[buffer]).subspan(offset, length));
        view["buffer"] = 0;
        view["byteOffset"] = place->second;
    }
}

void GlbBuilder::embed_images(Pictures pictures)
{
    const auto images = json.find("images");
    for (std::size_t i = 0; images != json.end() && i < images->size(); ++i) {
        Json& image = (*images)[i];
        if (const auto unpacked = unpacked_images_.find(i); unpacked != unpacked_images_.end()) {
            image["mimeType"] = "image/png";
            image["bufferView"] = add_view(unpacked->second, ViewTarget::none);
        }
        if (!image.contains("uri"))
            continue;
        Bytes file;
        try {
            JsonView view(document_.path, image, "/images/" + std::to_string(i));
            file = read_uri(view.get("uri"), document_.path);
            if (pictures == Pictures::plain)
                if (auto png = plain_picture(file, view.place()))
                    file = std::move(*png);
            is_webp_[i] = is_webp(file);
        } catch (const Error&) {
            continue;  // the scene was read without it, so light does not depend on it
        }
        std::string type = mime_type_of(file);
        if (type.empty())
            type = image.value("mimeType", std::string());
        if (type.empty())
            continue;
        image.erase("uri");
        image["mimeType"] = type;
        image["bufferView"] = add_view(file, ViewTarget::none);
    }
}

std::size_t GlbBuilder::append(std::span<const std::uint8_t> bytes)
{
    pad(binary_, 0);
    const std::size_t offset = binary_.size();
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return offset;
}

std::size_t GlbBuilder::add_view(std::span<const std::uint8_t> bytes, ViewTarget target,
                                 std::size_t stride)
{
    Json view = {{"buffer", 0}, {"byteOffset", append(bytes)}, {"byteLength", bytes.size()}};
    if (stride > 0)
        view["byteStride"] = stride;
    if (target != ViewTarget::none)
        view["target"] = int(target);
    return put(json["bufferViews"], free_views_, std::move(view));
}

std::size_t GlbBuilder::add_accessor(Json accessor)
{
    return put(json["accessors"], free_accessors_, std::move(accessor));
}

void GlbBuilder::retire_texture(std::size_t texture)
{
    for (const std::size_t image : images_of(json["textures"].at(texture))) {
        if (!json.contains("images") || image >= json["images"].size())
            continue;  // from an extension that is not read
        json["images"][image] = Json::object();
        free_images_.insert(image);
    }
    free_textures_.insert(texture);
}

std::size_t GlbBuilder::add_image(const std::string& name, const char* type,
                                  std::span<const std::uint8_t> file)
{
    return put(
        json["images"], free_images_,
        {{"name", name}, {"mimeType", type}, {"bufferView", add_view(file, ViewTarget::none)}});
}

std::size_t GlbBuilder::add_texture(const std::string& name, std::span<const std::uint8_t> png,
                                    std::span<const std::uint8_t> ktx2)
{
    const Json sampler = {{"magFilter", kLinear},
                          {"minFilter", kLinear},
                          {"wrapS", kClampToEdge},
                          {"wrapT", kClampToEdge}};
    Json& samplers = json["samplers"];
    const auto same = std::find(samplers.begin(), samplers.end(), sampler);
    const auto sampler_index = std::size_t(same - samplers.begin());
    if (same == samplers.end())
        samplers.push_back(sampler);

    Json texture = {
        {"name", name}, {"sampler", sampler_index}, {"source", add_image(name, "image/png", png)}};
    if (!ktx2.empty())
        texture["extensions"]["KHR_texture_basisu"]["source"] = add_image(name, "image/ktx2", ktx2);
    return put(json["textures"], free_textures_, std::move(texture));
}

/// Encodes bufferViews of vertices and indices that become smaller. Returns the size that they have
/// decoded.
std::size_t GlbBuilder::compress()
{
    const std::vector<std::uint8_t> plain = std::exchange(binary_, {});
    const std::map<std::size_t, std::size_t> index_sizes = sizes_of_indices(json);
    std::size_t decoded = 0;
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, Json> written;  // once each
    const auto views = json.find("bufferViews");
    for (std::size_t i = 0; views != json.end() && i < views->size(); ++i) {
        Json& view = (*views)[i];
        if (!view.contains("byteOffset"))
            continue;  // released, without data
        const std::size_t offset = view["byteOffset"], length = view["byteLength"];
        const auto index_size = index_sizes.find(i);
        const PlainView elements{.bytes = std::span(plain).subspan(offset, length),
                                 .stride = index_size != index_sizes.end()
                                               ? index_size->second
                                               : view.value("byteStride", std::size_t(0)),
                                 .is_indices = index_size != index_sizes.end()};
        const auto [place, is_new] =
            written.try_emplace({offset, length, elements.stride}, Json::object());
        if (is_new) {
            std::optional<EncodedView> encoded;
            if (is_encodable(elements))
                encoded = encode_meshopt(elements);
            if (encoded && encoded->bytes.size() + kJsonOfExtension < length) {
                encoded->extension.update({{"buffer", 0}, {"byteOffset", append(encoded->bytes)}});
                decoded = aligned(decoded);
                place->second = {{"buffer", 1}, {"byteOffset", decoded}};
                place->second["extensions"][kMeshoptExtension] = std::move(encoded->extension);
                decoded += length;
            } else {
                place->second = {{"buffer", 0}, {"byteOffset", append(elements.bytes)}};
            }
        }
        view.update(place->second, true);
    }
    return decoded;
}

/// Replaces the data of primitives by Draco streams where these are smaller.
void GlbBuilder::pack_triangles()
{
    GltfDocument plain{
        .path = document_.path, .json = json, .buffers = {std::exchange(binary_, {})}};
    const std::vector<PackedPrimitive> packed = pack_primitives(plain);
    if (packed.empty()) {
        binary_ = std::move(plain.buffers[0]);
        return;
    }
    for (const PackedPrimitive& one : packed) {
        Json& primitive = json["meshes"][one.mesh]["primitives"][one.primitive];
        primitive["attributes"] = Json::object();
        primitive.erase("indices");
    }
    free_unused(used_accessors(plain.json), used_views(plain.json));

    // The other data; views of the same bytes stay shared.
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> written;
    for (Json& view : json["bufferViews"]) {
        if (!view.contains("byteOffset"))
            continue;  // released, without data
        const std::size_t offset = view["byteOffset"], length = view["byteLength"];
        const auto [place, is_new] = written.try_emplace({offset, length});
        if (is_new)
            place->second = append(std::span(plain.buffers[0]).subspan(offset, length));
        view["byteOffset"] = place->second;
    }
    for (const PackedPrimitive& one : packed)
        add_packed(one);
    trim("accessors", free_accessors_);
    trim("bufferViews", free_views_);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        json[list].push_back(kDracoExtension);
}

/// Empties the accessors and bufferViews of these that the JSON no longer refers to.
void GlbBuilder::free_unused(const std::set<std::size_t>& accessors,
                             const std::set<std::size_t>& views)
{
    const std::set<std::size_t> live_accessors = used_accessors(json);
    for (const std::size_t accessor : accessors)
        if (!live_accessors.contains(accessor)) {
            json["accessors"][accessor] = kEmptyAccessor;
            free_accessors_.insert(accessor);
        }
    const std::set<std::size_t> live_views = used_views(json);
    for (const std::size_t view : views)
        if (!live_views.contains(view)) {
            json["bufferViews"][view] = kEmptyView;
            free_views_.insert(view);
        }
}

/// Removes free elements at the end of a list.
void GlbBuilder::trim(const char* name, std::set<std::size_t>& free)
{
    Json& array = json[name];
    while (!array.empty() && free.erase(array.size() - 1) > 0)
        array.erase(array.size() - 1);
}

/// Adds a stream and accessors of what it decodes to.
void GlbBuilder::add_packed(const PackedPrimitive& packed)
{
    const DracoMesh& mesh = packed.encoded.mesh;
    Json extension = {{"bufferView", add_view(packed.encoded.stream, ViewTarget::none)},
                      {"attributes", Json::object()}};
    Json attributes = Json::object();
    for (const PackedPrimitive::Attribute& attribute : packed.attributes) {
        extension["attributes"][attribute.name] = attribute.id;
        Json accessor = attribute.accessor;
        for (const char* key : {"bufferView", "byteOffset", "sparse", "min", "max"})
            accessor.erase(key);
        accessor["count"] = mesh.points;
        if (attribute.name == "POSITION") {
            const DracoAttribute& values =
                *std::ranges::find(mesh.attributes, attribute.id, &DracoAttribute::id);
            add_bounds(accessor, values.type.value(), values.components, values.bytes,
                       values.bytes.size() / mesh.points);
        }
        attributes[attribute.name] = add_accessor(std::move(accessor));
    }
    const bool is_short = mesh.points <= kShortIndexLimit;
    Json& primitive = json["meshes"][packed.mesh]["primitives"][packed.primitive];
    primitive["attributes"] = std::move(attributes);
    primitive["indices"] =
        add_accessor({{"componentType", int(is_short ? ComponentType::u16 : ComponentType::u32)},
                      {"count", mesh.indices.size()},
                      {"type", "SCALAR"}});
    primitive["extensions"][kDracoExtension] = std::move(extension);
}

std::vector<std::uint8_t> GlbBuilder::finish(Compression compression)
{
    if (compression == Compression::draco)
        pack_triangles();
    const std::size_t decoded = compression == Compression::meshopt ? compress() : 0;
    pad(binary_, 0);
    require_webp_images(json, is_webp_);
    json["asset"]["generator"] = "Lumel";
    json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    if (decoded > 0) {
        Json fallback = {{"byteLength", decoded}};
        fallback["extensions"][kMeshoptExtension]["fallback"] = true;
        json["buffers"].push_back(std::move(fallback));
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            json[list].push_back(kMeshoptExtension);
    }
    std::string text = json.dump();
    text.resize(aligned(text.size()), ' ');

    const std::size_t size =
        kHeaderSize + kChunkHeaderSize + text.size() + kChunkHeaderSize + binary_.size();
    if (size > UINT32_MAX)
        throw Error(ErrorKind::output, document_.path,
                    "with its lightmap takes more than the 4 GiB that a .glb can hold");
    std::vector<std::uint8_t> file;
    file.reserve(size);
    for (const std::size_t word :
         {std::size_t(kMagic), std::size_t(kVersion), size, text.size(), std::size_t(kJsonChunk)})
        append_word(file, word);
    file.insert(file.end(), text.begin(), text.end());
    append_word(file, binary_.size());
    append_word(file, kBinaryChunk);
    file.insert(file.end(), binary_.begin(), binary_.end());
    return file;
}

}  // namespace lumel
