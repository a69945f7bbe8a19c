#pragma once
// A file of two quads, with all that a writer has to keep.

#include <fstream>

#include <gtest/gtest.h>

#include "../../support/temporary_folder.h"
#include "base/images/image_files.h"
#include "hand_atlas.h"
#include "results/files/gltf_write.h"
#include "scene/gltf/document.h"

namespace lumel::test {

/// Two nodes show one mesh of one quad, whose colour is read through TEXCOORD_1.
class TwoQuads : public testing::Test {
protected:
    void SetUp() override
    {
        std::ofstream(folder_ / "quad.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(kData), sizeof kData);
        Image texture(1, 1, 3);
        texture.values = {1.0f, 0.0f, 0.0f};
        write_png(folder_ / "red.png", texture);
    }

    Json file() const
    {
        return Json::parse(R"({
            "asset": {"version": "2.0", "generator": "a test", "copyright": "nobody"},
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
            "scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
            "nodes": [{"mesh": 0, "name": "left"},
                      {"mesh": 0, "translation": [2, 0, 0]},
                      {"mesh": 0, "name": "outside"},
                      {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
            "meshes": [{"name": "quad", "extras": {"kept": true}, "primitives": [{
                "attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 1}, "mode": 5,
                "material": 0, "extras": {"also": "kept"}}]}],
            "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorTexture":
                {"index": 0, "texCoord": 1}}}],
            "textures": [{"source": 0}], "images": [{"uri": "red.png"}],
            "buffers": [{"uri": "quad.bin", "byteLength": 80}],
            "bufferViews": [{"buffer": 0, "byteLength": 48},
                            {"buffer": 0, "byteOffset": 48, "byteLength": 32}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}]
        })");
    }

    Scene scene(const Json& json) const
    {
        std::ofstream(folder_ / "quads.gltf") << json.dump();
        return read_gltf(folder_ / "quads.gltf");
    }

    Json lit(const Json& json) const
    {
        const Scene read = scene(json);
        const Atlas atlas = corner_atlas(read);
        write_scene_glb(folder_ / "scene.glb", load_gltf_document(read.path), read, atlas,
                        any_map(atlas));
        return load_gltf_document(folder_ / "scene.glb").json;
    }

    Json baked(const Json& json) const
    {
        const Scene read = scene(json);
        const Atlas atlas = corner_atlas(read);
        write_baked_glb(folder_ / "baked.glb", load_gltf_document(read.path), read, atlas,
                        any_map(atlas));
        return load_gltf_document(folder_ / "baked.glb").json;
    }

    static constexpr float kData[20] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1};
    TemporaryFolder folder_;
};

}  // namespace lumel::test
