#pragma once
// Small glTF files made in memory, for tests.

#include <initializer_list>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "../support/temporary_folder.h"
#include "base/core/error.h"
#include "scene/gltf/document.h"
#include "scene/values/scene.h"

namespace lumel::test {

/// A folder of a test's own that files are written to.
class TempFolder : public TemporaryFolder {
public:
    std::string path(const std::string& name) const { return *this / name; }
    std::string write(const std::string& name, const Bytes& bytes) const;
    std::string write(const std::string& name, const std::string& text) const;
};

/// JSON and one buffer that grow together.
struct GltfBuilder {
    Json json = {{"asset", {{"version", "2.0"}}}};
    Bytes buffer;

    /// Appends bytes as a bufferView; returns its index.
    int add_view(const void* data, std::size_t size, int stride = 0);
    /// Appends an accessor over a new bufferView; returns its index.
    template <typename T>
    int add_accessor(const std::vector<T>& values, const char* type, int component_type,
                     std::size_t count, bool normalized = false)
    {
        const int view = add_view(values.data(), values.size() * sizeof(T));
        Json accessor = {{"bufferView", view},
                         {"componentType", component_type},
                         {"count", count},
                         {"type", type}};
        if (normalized)
            accessor["normalized"] = true;
        return push("accessors", accessor);
    }
    int add_positions(const std::vector<glm::vec3>& positions);
    /// Replaces one element of accessor 0 by a sparse accessor.
    void replace_sparsely(std::uint16_t index, const glm::vec3& value);
    /// Appends to a list of the file; returns the index.
    int push(const char* list, const Json& element);
    /// A primitive in a mesh of its own on a node of the default scene; returns the node.
    int show(const Json& primitive);

    Bytes glb() const;
    /// Writes scene.glb into the folder; returns its path.
    std::string write(const TempFolder& folder) const;
    /// Writes and reads it.
    Scene read(MaterialModel model = MaterialModel::diffuse) const;
};

/// One triangle (0,0,0) (1,0,0) (0,1,0), no indices: accessor 0, mesh 0, node 0.
GltfBuilder one_triangle();
/// A minimal PNG of the given texels, uncompressed. rgba: [height][width][4].
Bytes make_png(int width, int height, const Bytes& rgba);

/// The message of the Error{input} that reading it must end with; empty if it does not.
std::string error_of(const GltfBuilder& builder);
std::string error_of_file(const std::string& path);

bool contains(const std::string& text, const std::string& part);
/// True if one of the scene's warnings contains `part`.
bool warns(const Scene& scene, const std::string& part);

}  // namespace lumel::test
