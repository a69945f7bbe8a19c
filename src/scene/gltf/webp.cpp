#include "scene/gltf/webp.h"

#include "scene/gltf/extensions.h"

namespace lumel {
namespace {

constexpr const char* kWebp = "EXT_texture_webp";

}  // namespace

void name_webp_images(GltfDocument& document)
{
    const JsonView root = document.root();
    root.each("textures", [&](const JsonView& texture, std::size_t) {
        if (const auto extension = texture.extension(kWebp))
            if (const auto source = extension->find("source"))
                source->index(root.count("images"), "images");
    });
    if (document.json.contains("textures"))
        for (Json& texture : document.json["textures"]) {
            const Json::json_pointer source(std::string("/extensions/") + kWebp + "/source");
            if (!texture.contains("source") && texture.contains(source)) {
                Json image = texture[source];
                texture["source"] = std::move(image);
            }
            erase_extension(texture, kWebp);
        }
    forget_extension(document.json, kWebp);
}

}  // namespace lumel
