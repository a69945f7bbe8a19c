#pragma once
// Edits a glTF document and writes it as one .glb file.

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/compression.h"
#include "scene/gltf/document.h"
#include "scene/pack/draco_primitives.h"

namespace lumel {

/// Formats of images in a file.
enum class Pictures {
    as_they_are,  ///< byte for byte; WebP requires its extension
    plain,        ///< PNG and JPEG, which all viewers read; WebP becomes PNG
};

/// glTF's numbers for the use of a bufferView.
enum class ViewTarget { none = 0, vertices = 34962, indices = 34963 };

/// Starts as a copy of a document, whose JSON can then be changed freely. release() drops data that
/// the JSON no longer refers to; then new data can be added. Indices never change: new data takes
/// the indices of released data. The document must outlive the builder.
class GlbBuilder {
public:
    explicit GlbBuilder(const GltfDocument& document);

    Json json;
    const GltfDocument& document() const { return document_; }

    /// Drops the data of accessors and bufferViews that only the original JSON referred to, and
    /// embeds the files of all images. Images that cannot be read keep their URI. Call once.
    void release(Pictures pictures = Pictures::as_they_are);

    /// Appends data as a new bufferView. stride: of vertex arrays [bytes], else 0.
    std::size_t add_view(std::span<const std::uint8_t> bytes, ViewTarget target,
                         std::size_t stride = 0);
    std::size_t add_accessor(Json accessor);
    /// Appends a PNG, a bilinear clamping sampler, and a texture of both, at the index of the
    /// retired texture if any. ktx2: the image in KTX2, for loaders with KHR_texture_basisu; or
    /// empty.
    std::size_t add_texture(const std::string& name, std::span<const std::uint8_t> png,
                            std::span<const std::uint8_t> ktx2 = {});
    /// Releases a texture and its images. Requires that nothing else uses them. Call before
    /// release().
    void retire_texture(std::size_t texture);

    /// The finished file. Throws Error{output} if it exceeds GLB's 4 GiB.
    std::vector<std::uint8_t> finish(Compression compression = Compression::none);

private:
    void look_at_images(Pictures pictures);
    std::set<std::size_t> free_elements(const char* name, const Json& empty,
                                        std::set<std::size_t> (*used_in)(const Json&));
    void copy_views();
    void embed_images(Pictures pictures);
    std::size_t compress();
    void pack_triangles();
    void free_unused(const std::set<std::size_t>& accessors, const std::set<std::size_t>& views);
    void trim(const char* name, std::set<std::size_t>& free);
    void add_packed(const PackedPrimitive& packed);
    std::size_t append(std::span<const std::uint8_t> bytes);
    std::size_t add_image(const std::string& name, const char* type,
                          std::span<const std::uint8_t> file);

    const GltfDocument& document_;
    std::vector<std::uint8_t> binary_;
    std::set<std::size_t> free_views_, free_accessors_, free_textures_, free_images_;
    std::map<std::size_t, Bytes> unpacked_images_;  ///< PNGs, by image
    std::vector<bool> is_webp_;                     ///< by image
};

/// All accessors used by meshes, skins and animations of a glTF.
std::set<std::size_t> used_accessors(const Json& json);

/// Images of a texture, its own and those of extensions.
std::set<std::size_t> images_of(const Json& texture);

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
