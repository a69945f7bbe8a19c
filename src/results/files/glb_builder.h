#pragma once
// A glTF document that is changed and written into one .glb file.

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/document.h"

namespace lumel {

/// glTF's numbers for what a bufferView is for.
enum class ViewTarget { none = 0, vertices = 34962, indices = 34963 };

/// Starts as a copy of a document, whose JSON may then be changed at will; release() drops
/// what the changed JSON no longer refers to; after it, new data is added. Indices never move:
/// new data takes the numbers of released data. The document must outlive the builder.
class GlbBuilder {
public:
    explicit GlbBuilder(const GltfDocument& document);

    Json json;
    const GltfDocument& document() const { return document_; }

    /// Drops the data of accessors and bufferViews that the document referred to and the JSON no
    /// longer does, and puts the files of all images into the buffer. Images that cannot be read
    /// keep their URI. Call once.
    void release();

    /// Appends data as a bufferView of its own. `stride` [bytes]: of vertex arrays, else 0.
    std::size_t add_view(std::span<const std::uint8_t> bytes, ViewTarget target,
                         std::size_t stride = 0);
    std::size_t add_accessor(Json accessor);
    /// Appends a PNG, a bilinear and clamping sampler, and the texture that joins them; takes the
    /// place of the retired texture if there is one. `ktx2`: the same in KTX2, which loaders that
    /// know KHR_texture_basisu take instead; or empty.
    std::size_t add_texture(const std::string& name, std::span<const std::uint8_t> png,
                            std::span<const std::uint8_t> ktx2 = {});
    /// Lets go of a texture and its images, which nothing else may use. Call before release().
    void retire_texture(std::size_t texture);

    /// The finished file. Throws Error{output} if it is beyond GLB's 4 GiB.
    std::vector<std::uint8_t> finish();

private:
    void unpack_images();
    void free_accessors();
    void free_views();
    void copy_views();
    void embed_images();
    std::size_t append(std::span<const std::uint8_t> bytes);
    std::size_t add_image(const std::string& name, const char* type,
                          std::span<const std::uint8_t> file);

    const GltfDocument& document_;
    std::vector<std::uint8_t> binary_;
    std::set<std::size_t> free_views_, free_accessors_, free_textures_, free_images_;
    std::map<std::size_t, Bytes> unpacked_images_;  ///< PNGs, by image
};

/// Every accessor that meshes, skins and animations of a glTF refer to.
std::set<std::size_t> used_accessors(const Json& json);

/// Images that a texture shows, for itself or by extensions.
std::set<std::size_t> images_of(const Json& texture);

/// The extras of a part of a glTF as an object; extras that are none become its member "value".
Json& extras_of(Json& part);

/// Calls visit(object) for `value` and every object inside it, but not inside extras.
template <class Value, class Visit>
void for_objects(Value& value, const Visit& visit)
{
    if (value.is_object())
        visit(value);
    if (value.is_structured())
        for (auto member = value.begin(); member != value.end(); ++member)
            if (!value.is_object() || member.key() != "extras")
                for_objects(*member, visit);
}

}  // namespace lumel
