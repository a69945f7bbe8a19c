#pragma once
// A scene, decoded from its file and checked, independent of glTF's encoding.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/photometry.shared.h"
#include "scene/values/shininess.shared.h"
#include "scene/values/sky.h"

namespace lumel {

struct GltfDocument;

/// 8-bit RGBA, top row first, as in the file (sRGB-coded colour).
struct Texture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< [height][width][4]
};

enum class Wrap { repeat, mirrored, clamp };

/// Number of TEXCOORD sets for textures. Viewers must support two; a baked file has the lightmap's
/// in addition.
inline constexpr int kTexcoordSets = 4;

/// A material's reference to a texture.
struct TextureUse {
    int texture = -1;            ///< index into Scene::textures, -1: none
    int texcoord = 0;            ///< below kTexcoordSets: TEXCOORD_n
    glm::mat3 transform{1.0f};   ///< KHR_texture_transform: uv' = transform * (u, v, 1)
    Wrap wrap_s = Wrap::repeat;  ///< u
    Wrap wrap_t = Wrap::repeat;  ///< v
};

enum class AlphaMode { opaque, mask, blend };

/// Luminance limit [cd/m²], a hundred times that of the sun's disc. Larger values could overflow
/// sums of light.
inline constexpr float kMaxLuminance = 2e11f;

struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};     ///< linear; rgb is the diffuse albedo ρ
    TextureUse base_color_texture;  ///< sRGB, multiplies base_color
    float metallic = 1.0f;          ///< for glossy methods
    float roughness = 1.0f;
    TextureUse metallic_roughness_texture;  ///< linear; blue × metallic, green × roughness
    glm::vec3 dielectric_specular{0.04f};   ///< F0 of dielectrics, 0…1
    glm::vec3 emitted{0.0f};                ///< emissiveFactor × strength [cd/m²], linear
    TextureUse emissive_texture;            ///< sRGB, multiplies emitted
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  ///< for AlphaMode::mask
    /// Share of glass in the covered area: light passes straight, tinted by the base colour
    /// (without vertex colours). The rest is opaque.
    float transmission = 0.0f;
    bool double_sided = false;
    float texels_per_metre = 0.0f;  ///< extras.lumel: texel density, 0: not set
    int lightmap_page = 0;          ///< extras.lumel.page, from a bake
};

/// A triangle list. Vertex arrays have the order of the file's accessors; empty: absent.
struct Primitive {
    std::vector<glm::vec3> positions;                 ///< [V] mesh space [m]
    std::vector<glm::vec3> normals;                   ///< [V] unit length, or empty (flat shading)
    std::vector<glm::vec2> texcoords[kTexcoordSets];  ///< [V] TEXCOORD_n, or empty
    std::vector<glm::vec4> colors;       ///< [V] COLOR_0, multiplies base colour, or empty
    std::vector<std::uint32_t> indices;  ///< [3T] strips and fans unrolled, zero-area dropped
    int material = 0;                    ///< index into Scene::materials, always valid
    int source_primitive = 0;            ///< index in the file's mesh.primitives
    /// [V] Lightmap page of TEXCOORD_1, if a bake put parts on several; empty: that of the
    /// material.
    std::vector<std::uint16_t> lightmap_pages;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// A mesh placed in the world by a node.
struct Instance {
    std::string name;
    int mesh = 0;
    int node = 0;               ///< index in the file's nodes
    glm::mat4 transform{1.0f};  ///< mesh to world; a negative determinant flips the winding
    /// extras.lumel of the node, else of its mesh: texel density, 0: not set.
    float texels_per_metre = 0.0f;
};

struct PunctualLight {
    enum class Kind { directional, point, spot } kind = Kind::point;
    std::string name;
    glm::vec3 color{1.0f};         ///< linear
    float intensity = 1.0f;        ///< [cd] for point and spot, [lx] for directional
    float range = 0.0f;            ///< [m], 0: unlimited
    float inner_cone = 0.0f;       ///< [rad]
    float outer_cone = 0.785398f;  ///< [rad]
    /// Radius of the emitting sphere [m], uniform except for cone and profile; 0: a point. Point
    /// and spot only.
    float radius = 0.0f;
    /// Angular radius of a directional light's disc in the sky [rad]; 0: parallel light.
    float angle = 0.0f;
    int profile = -1;           ///< index into Scene::profiles, -1: none. Point and spot only.
    glm::mat4 transform{1.0f};  ///< light to world; its light is centred on -z
};

/// Photometric profile of a luminaire: luminous intensity [cd] over directions, interpolated
/// bilinearly. Polar angle 0 is the light's -z, azimuth 0 its +x, increasing towards +y.
struct Photometry {
    static constexpr int kPolarSteps = int(lumel::kPolarSteps);
    static constexpr int kAzimuthSteps = int(lumel::kAzimuthSteps);
    std::string name;
    std::vector<float> candela;  ///< [kAzimuthSteps][kPolarSteps + 1]
};

struct Camera {
    std::string name;
    int node = 0;                      ///< index in the file's nodes
    glm::mat4 transform{1.0f};         ///< camera to world; views along -z, +y up
    float vertical_fov = 0.8f;         ///< [rad]; ignored when orthographic
    float aspect = 0.0f;               ///< width / height, 0: unspecified
    float orthographic_height = 0.0f;  ///< [m], > 0 if orthographic
};

/// Material properties to read: base colour and emission, or also metallic, roughness and F0, which
/// otherwise keep their defaults.
enum class MaterialModel { diffuse, glossy };

/// Maximum reflectance by default. Fresh snow and white plaster reflect less; light between
/// surfaces of albedo 1 grows without bound.
inline constexpr float kMaxAlbedo = 0.95f;

struct Scene {
    std::string path;                              ///< source file
    MaterialModel model = MaterialModel::diffuse;  ///< material properties read
    float max_albedo = kMaxAlbedo;                 ///< of the brightest channel, see capped()
    std::vector<Texture> textures;
    std::vector<Material> materials;  ///< the file's, then the default material if needed
    std::vector<Mesh> meshes;         ///< the file's; without primitives if not shown
    std::vector<Instance> instances;  ///< default scene of the file, in node order
    std::vector<PunctualLight> lights;
    std::vector<Photometry> profiles;  ///< photometric profiles of lights
    Sky sky;
    std::vector<Camera> cameras;
    /// Origin of all transforms here in the file's world [m]: not 0 only for scenes far from it,
    /// where floats are too coarse.
    glm::dvec3 origin{0.0};
    std::vector<std::string> warnings;  ///< messages for the user
    std::size_t dropped_triangles = 0;  ///< zero-area triangles
    std::string hash;                   ///< 16 hex digits over all content that affects light
};

/// Reads glTF 2.0 (.gltf with its files, or .glb). Throws Error{input} with file, JSON pointer and
/// reason for invalid or unsupported content.
Scene read_gltf(const std::string& path, MaterialModel model = MaterialModel::diffuse);
/// Reads a document, the file of document.path. Throws likewise.
Scene read_gltf(const GltfDocument& document, MaterialModel model = MaterialModel::diffuse);

/// Index of the first instance with this name. Throws Error{input} if there is none.
std::uint32_t find_instance(const Scene& scene, const std::string& name);

/// True if the light's intensity and colour are not 0.
bool shines(const PunctualLight& light);

/// Luminous intensity [cd] of a point or spot light in a unit direction in the world: colour ×
/// intensity × cone (KHR_lights_punctual) × profile. With a profile, the intensity is a factor of
/// its candela.
glm::vec3 intensity_towards(const Scene& scene, const PunctualLight& light,
                            const glm::vec3& direction);

/// Window factor of 1 / r² at distance r [m] for a light with a range: KHR_lights_punctual's
/// max(min(1 - (r / range)⁴, 1), 0); 1 without one.
float range_window(const PunctualLight& light, float distance);

/// Darkens an albedo whose brightest channel is above `most`, keeping its hue:
/// ρ · min(1, most / max ρ).
glm::vec3 capped(const glm::vec3& albedo, float most);

/// Material properties at a point. `texcoord`: TEXCOORD_n. Reflectances are linear and capped at
/// Scene::max_albedo. Glass reflects by its opacity only.
struct MaterialSample {
    glm::vec3 albedo;    ///< ρ: total reflectance, taken as diffuse
    glm::vec3 diffuse;   ///< ρ_d for glossy methods
    glm::vec3 specular;  ///< ρ_s; ρ_d + ρ_s is capped too
    float roughness;     ///< glTF's, 0…1
    float opacity;       ///< (opaque: 1; mask: 0 or 1; blend: alpha 0…1) × (1 - transmission)
    glm::vec3 tint;      ///< 0…1, of transmitted light: its share is 1 - opacity, times this
    glm::vec3 emitted;   ///< luminance [cd/m²], linear
};
MaterialSample sample_material(const Scene& scene, int material,
                               const glm::vec2 texcoord[kTexcoordSets],
                               const glm::vec4& vertex_color);

/// Exponent n of a Phong lobe about the mirror direction with the width of glTF's roughness,
/// 1…kMaxShininess: mirrors are blurred.
float shininess_of(double roughness);

/// True if part of the primitive may transmit light: it is cut out, blended or glass.
bool may_be_transparent(const Material& material, const Primitive& primitive);

/// True if the material's transmittance may depend on the colour of light.
bool is_coloured_glass(const Material& material);

/// True if the material is constant over a surface (reads no textures).
bool is_uniform(const Material& material);

}  // namespace lumel
