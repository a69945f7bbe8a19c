#include "scene/load/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/core/parallel.h"
#include "base/json/json_file.h"
#include "scene/gltf/extensions.h"
#include "scene/gltf/extras.h"
#include "scene/load/gltf_image.h"

namespace lumel {

namespace {

constexpr Named<AlphaMode> kAlphaModes[] = {
    {"OPAQUE", AlphaMode::opaque}, {"MASK", AlphaMode::mask}, {"BLEND", AlphaMode::blend}};

class MaterialReader {
public:
    MaterialReader(const GltfDocument& document, MaterialModel model)
        : root_(document.root()),
          model_(model)
    {
    }

    MaterialList read(const std::vector<bool>& used)
    {
        root_.each("materials", [&](const JsonView& view, std::size_t i) {
            in_use_ = used[i];
            list_.materials.push_back(read_material(view));
        });
        return std::move(list_);
    }

private:
    Material read_material(const JsonView& view)
    {
        Material material;
        material.name = view.string_or("name", "");
        read_base_color(view, material);
        if (model_ == MaterialModel::glossy)
            read_gloss(view, material);
        read_emission(view, material);
        read_alpha(view, material);
        material.double_sided = view.boolean_or("doubleSided", false);
        material.texels_per_metre = density_in_extras(view);
        material.lightmap_page = page_in_extras(view);
        read_transmission(view, material);
        return material;
    }

    void read_transmission(const JsonView& view, Material& material)
    {
        const auto extension = view.extension("KHR_materials_transmission");
        if (!extension)
            return;
        const float factor = extension->number_or("transmissionFactor", 0.0f);
        material.transmission = std::clamp(factor, 0.0f, 1.0f);
        if (in_use_ && material.transmission > 0.0f && extension->find("transmissionTexture"))
            ++list_.transmission_textures;
    }

    /// Metals and dielectrics alike reflect their base colour diffusely here.
    void read_base_color(const JsonView& view, Material& material)
    {
        if (const auto specular = view.extension("KHR_materials_pbrSpecularGlossiness")) {
            specular->numbers("diffuseFactor", &material.base_color.x, 4);
            if (const auto info = specular->find("diffuseTexture"))
                material.base_color_texture = read_texture_use(*info);
        } else if (const auto pbr = view.find("pbrMetallicRoughness")) {
            pbr->numbers("baseColorFactor", &material.base_color.x, 4);
            if (const auto info = pbr->find("baseColorTexture"))
                material.base_color_texture = read_texture_use(*info);
        }
        const glm::vec4 clamped = glm::clamp(material.base_color, 0.0f, 1.0f);
        list_.clamped |= clamped != material.base_color;
        material.base_color = clamped;
    }

    /// Metallic, roughness, and the F0 of dielectrics: ((ior - 1) / (ior + 1))² × specular factors.
    void read_gloss(const JsonView& view, Material& material)
    {
        if (const auto pbr = view.find("pbrMetallicRoughness")) {
            material.metallic = pbr->number_or("metallicFactor", 1.0f);
            material.roughness = pbr->number_or("roughnessFactor", 1.0f);
            if (const auto info = pbr->find("metallicRoughnessTexture"))
                material.metallic_roughness_texture = read_texture_use(*info);
        }
        if (const auto extension = view.extension("KHR_materials_ior")) {
            const float ior = extension->number_or("ior", 1.5f);
            // An ior of 0 means a mirror at all angles.
            const float root = ior >= 1.0f ? (ior - 1.0f) / (ior + 1.0f) : 1.0f;
            material.dielectric_specular = glm::vec3(root * root);
        }
        if (const auto extension = view.extension("KHR_materials_specular")) {
            glm::vec3 color(1.0f);
            extension->numbers("specularColorFactor", &color.x, 3);
            material.dielectric_specular *= extension->number_or("specularFactor", 1.0f) * color;
        }
        material.dielectric_specular = glm::clamp(material.dielectric_specular, 0.0f, 1.0f);
    }

    void read_emission(const JsonView& view, Material& material)
    {
        view.numbers("emissiveFactor", &material.emitted.x, 3);
        if (const auto extension = view.extension("KHR_materials_emissive_strength"))
            material.emitted *= extension->number_or("emissiveStrength", 1.0f);
        for (int c = 0; c < 3; ++c)
            if (!(material.emitted[c] >= 0.0f && std::isfinite(material.emitted[c])))
                view.fail("emits a negative or infinite amount of light");
            else if (material.emitted[c] > kMaxLuminance)
                view.fail(lumel::quoted(material.name) + " emits " +
                          Json(shortest(material.emitted[c])).dump() +
                          " cd/m2, more than the sun; lower its emissive strength");
        if (const auto info = view.find("emissiveTexture"))
            material.emissive_texture = read_texture_use(*info);
    }

    void read_alpha(const JsonView& view, Material& material)
    {
        if (const auto mode = view.find("alphaMode"))
            material.alpha_mode = named_by(*mode, kAlphaModes);
        material.alpha_cutoff = view.number_or("alphaCutoff", material.alpha_cutoff);
        if (material.alpha_cutoff < 0.0f)
            view.get("alphaCutoff").fail("must not be negative");
    }

    TextureUse read_texture_use(const JsonView& info)
    {
        const std::size_t count = root_.count("textures");
        const std::size_t index = info.get("index").index(count, "textures");
        const JsonView texture = root_.get("textures").at(index);
        TextureUse use;
        use.texture = texture_slot(texture);
        if (const auto sampler = texture.find("sampler"))
            read_wrap(sampler->index(root_.count("samplers"), "samplers"), use);
        if (const auto texcoord = info.find("texCoord"))
            use.texcoord = texcoord_of(*texcoord);
        if (const auto transform = info.extension("KHR_texture_transform"))
            read_transform(*transform, use);
        return use;
    }

    int texcoord_of(const JsonView& view) const
    {
        const std::int64_t set = view.integer(0, INT32_MAX);
        constexpr std::int64_t kLargest = kTexcoordSets - 1;
        if (set > kLargest && in_use_)
            view.fail("refers to TEXCOORD_" + std::to_string(set) +
                      ", but only TEXCOORD_0 to TEXCOORD_" + std::to_string(kLargest) +
                      " are read");
        return int(std::min(set, kLargest));
    }

    /// Index of a texture's image in Scene::textures; images are shared.
    int texture_slot(const JsonView& texture)
    {
        const auto source = texture.find("source");
        if (!source) {
            constexpr const char* kBasis = "KHR_texture_basisu";
            if (texture.extension(kBasis))
                refuse_extension(texture, kBasis);
            list_.missing_textures += in_use_;
            return -1;
        }
        const std::size_t image = source->index(root_.count("images"), "images");
        if (!in_use_)
            return -1;
        auto& images = list_.images;
        const auto known = std::find(images.begin(), images.end(), image);
        if (known != images.end())
            return int(known - images.begin());
        images.push_back(image);
        return int(images.size()) - 1;
    }

    void read_wrap(std::size_t sampler, TextureUse& use) const
    {
        const JsonView view = root_.get("samplers").at(sampler);
        const auto wrap = [&](const char* key) {
            constexpr std::int64_t kRepeat = 10497;
            constexpr std::int64_t kClamp = 33071;
            constexpr std::int64_t kMirrored = 33648;
            const auto member = view.find(key);
            const std::int64_t mode = member ? member->integer(0, INT32_MAX) : kRepeat;
            if (mode != kRepeat && mode != kClamp && mode != kMirrored)
                member->fail("is " + std::to_string(mode) + ", which is no wrap mode");
            return mode == kRepeat ? Wrap::repeat : mode == kClamp ? Wrap::clamp : Wrap::mirrored;
        };
        use.wrap_s = wrap("wrapS");
        use.wrap_t = wrap("wrapT");
    }

    void read_transform(const JsonView& view, TextureUse& use) const
    {
        glm::vec2 offset(0.0f);
        glm::vec2 scale(1.0f);
        view.numbers("offset", &offset.x, 2);
        view.numbers("scale", &scale.x, 2);
        const float rotation = view.number_or("rotation", 0.0f);
        // Scale, then rotation (counter-clockwise with v pointing down), then translation.
        const float c = std::cos(rotation);
        const float s = std::sin(rotation);
        use.transform = glm::mat3(glm::vec3(c, -s, 0.0f) * scale.x, glm::vec3(s, c, 0.0f) * scale.y,
                                  glm::vec3(offset, 1.0f));
        if (const auto texcoord = view.find("texCoord"))
            use.texcoord = texcoord_of(*texcoord);
    }

    JsonView root_;
    MaterialModel model_;
    MaterialList list_;
    bool in_use_ = false;
};

}  // namespace

MaterialList read_materials(const GltfDocument& document, const std::vector<bool>& used,
                            MaterialModel model)
{
    return MaterialReader(document, model).read(used);
}

std::vector<Texture> read_textures(const GltfDocument& document,
                                   const std::vector<std::size_t>& images)
{
    std::vector<Texture> textures(images.size());
    std::vector<std::exception_ptr> failures(images.size());
    parallel_for(images.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            try {
                const JsonView view = document.root().get("images").at(images[i]);
                textures[i] = decode_image(read_image_bytes(document, images[i]), view.place());
            } catch (...) {
                failures[i] = std::current_exception();
            }
        }
    });
    // Rethrows in order, so that the message does not depend on thread timing.
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
    return textures;
}

}  // namespace lumel
