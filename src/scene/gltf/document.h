#pragma once
// Low-level glTF access: JSON, buffers, and accessors as plain bytes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/json/json_view.h"
#include "scene/gltf/files.h"

namespace lumel {

/// A .gltf or .glb file whose buffers, bufferViews and accessors are verified: all references
/// resolve and all bytes of accessors exist. Data that extensions compress or instance are
/// expanded, and area lights are meshes: the JSON is that of the plain file, with additions at the
/// end of its lists.
struct GltfDocument {
    std::string path;
    Json json;                   ///< the file's JSON, in its order
    std::vector<Bytes> buffers;  ///< [i] has exactly json["buffers"][i]["byteLength"] bytes,
                                 ///< or none if only compressed bufferViews use it

    JsonView root() const { return {path, json}; }
};

/// Changes that a bake makes to a scene file: it removes lamps, splits surfaces by side and by
/// lightmap page, and adds light probes.
enum class BakeChanges { undone, kept };

/// Reads a file, its external buffers and data URIs. Throws Error{input} with file, JSON pointer
/// and reason for invalid data and for unsupported required extensions.
GltfDocument load_gltf_document(const std::string& path, BakeChanges changes = BakeChanges::undone);

enum class ComponentType { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// The elements of an accessor, tightly packed in file order, without interleaving and with sparse
/// values applied: element i starts at bytes[i * element_size].
struct AccessorData {
    ComponentType component_type = ComponentType::f32;
    std::string type;            ///< "SCALAR", "VEC2" …
    std::size_t components = 1;  ///< per element: SCALAR 1 … MAT4 16
    bool normalized = false;
    std::size_t count = 0;
    std::size_t element_size = 0;  ///< [bytes], including glTF's padding of small matrices
    Bytes bytes;                   ///< [count][element_size], little-endian
};

/// `accessor`: index into json["accessors"].
AccessorData read_accessor(const GltfDocument& document, std::size_t accessor);

/// Contents of the file that "uri" or "bufferView" of an object refers to. Throws Error{input} if
/// it cannot be read or lies outside the scene's folder.
Bytes read_linked_bytes(const GltfDocument& document, const JsonView& view);

/// Encoded image file (PNG, JPEG, WebP). `image`: index into json["images"]. Throws Error{input} if
/// it cannot be read or lies outside the scene's folder.
Bytes read_image_bytes(const GltfDocument& document, std::size_t image);

}  // namespace lumel
