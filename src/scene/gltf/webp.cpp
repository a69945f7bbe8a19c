#include "scene/gltf/webp.h"

#include <algorithm>
#include <utility>

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
    bool kept = false;
    if (document.json.contains("textures"))
        for (Json& texture : document.json["textures"]) {
            const Json::json_pointer source(std::string("/extensions/") + kWebp + "/source");
            if (!texture.contains(source) || texture.contains("source")) {
                kept = kept || texture.contains(source);
                continue;
            }
            Json image = texture[source];
            texture["source"] = std::move(image);
            erase_extension(texture, kWebp);
        }
    if (!kept)
        forget_extension(document.json, kWebp);
}

void require_webp_images(Json& gltf, const std::vector<bool>& is_webp)
{
    bool any = false;
    if (gltf.contains("textures"))
        for (Json& texture : gltf["textures"]) {
            const auto source = texture.find("source");
            if (source == texture.end() || index_of(*source) >= is_webp.size() ||
                !is_webp[index_of(*source)])
                continue;
            Json image = *source;
            texture.erase(source);
            texture["extensions"][kWebp] = {{"source", std::move(image)}};
            any = true;
        }
    if (any)
        for (const char* key : {"extensionsUsed", "extensionsRequired"})
            if (Json& names = gltf[key]; std::ranges::find(names, kWebp) == names.end())
                names.push_back(kWebp);
}

}  // namespace lumel
