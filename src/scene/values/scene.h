#pragma once
// The contents of a scene file, decoded and checked: plain values, nothing of glTF's encoding.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/photometry.shared.h"
#include "scene/values/shininess.shared.h"
#include "scene/values/sky.h"

namespace lumel {

/// 8-bit RGBA, top row first, as stored in the file (colour channels sRGB-coded).
struct Texture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< [height][width][4]
};

enum class Wrap { repeat, mirrored, clamp };

/// TEXCOORD_0 and so on that textures may read. A viewer must support two; what was baked once has
/// the lightmap's place besides.
inline constexpr int kTexcoordSets = 4;

/// Where and how a material reads a texture.
struct TextureUse {
    int texture = -1;            ///< index into Scene::textures, -1: none
    int texcoord = 0;            ///< below kTexcoordSets: TEXCOORD_n
    glm::mat3 transform{1.0f};   ///< KHR_texture_transform: uv' = transform * (u, v, 1)
    Wrap wrap_s = Wrap::repeat;  ///< u
    Wrap wrap_t = Wrap::repeat;  ///< v
};

enum class AlphaMode { opaque, mask, blend };

/// Luminance that nothing has [cd/m²]: a hundred times that of the sun's disc. Beyond it sums of
/// light could overflow.
inline constexpr float kMaxLuminance = 2e11f;

struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};     ///< linear; rgb is taken as diffuse albedo ρ
    TextureUse base_color_texture;  ///< sRGB, multiplies base_color
    float metallic = 1.0f;          ///< for solvers that use gloss
    float roughness = 1.0f;
    TextureUse metallic_roughness_texture;  ///< linear; blue × metallic, green × roughness
    glm::vec3 dielectric_specular{0.04f};   ///< F0 of what is not metal, 0…1
    glm::vec3 emitted{0.0f};                ///< emissiveFactor × strength [cd/m²], linear
    TextureUse emissive_texture;            ///< sRGB, multiplies emitted
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  ///< for AlphaMode::mask
    /// Of what is there, the share that is glass: light passes straight, times the base colour
    /// (without the vertices'). The rest is as if it were not glass.
    float transmission = 0.0f;
    bool double_sided = false;
    float texels_per_metre = 0.0f;  ///< extras.lumel: density of its lightmap, 0: not set
    int lightmap_page = 0;          ///< extras.lumel.page, which a bake wrote
};

/// A triangle list. Vertex arrays keep the order of the file's accessors; empty: absent.
struct Primitive {
    std::vector<glm::vec3> positions;                 ///< [V] mesh space [m]
    std::vector<glm::vec3> normals;                   ///< [V] unit length, or empty (flat shading)
    std::vector<glm::vec2> texcoords[kTexcoordSets];  ///< [V] TEXCOORD_n, or empty
    std::vector<glm::vec4> colors;       ///< [V] COLOR_0, multiplies base colour, or empty
    std::vector<std::uint32_t> indices;  ///< [3T] strips and fans unrolled, zero-area dropped
    int material = 0;                    ///< index into Scene::materials, always valid
    int source_primitive = 0;            ///< index in the file's mesh.primitives
    /// [V] Page of the lightmap that TEXCOORD_1 is a place on, where a bake has put parts of it on
    /// several; or empty: that of its material.
    std::vector<std::uint16_t> lightmap_pages;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// One mesh placed in the world by one node.
struct Instance {
    std::string name;
    int mesh = 0;
    int node = 0;               ///< index in the file's nodes
    glm::mat4 transform{1.0f};  ///< mesh to world; a negative determinant flips the winding
    /// extras.lumel of the node, else of its mesh: density of its lightmap, 0: not set.
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
    /// Of the ball that shines, uniformly bright but for cone and profile [m]; 0: a point. Point
    /// and spot only.
    float radius = 0.0f;
    /// Half the angle that the disc of a directional light takes in the sky [rad]; 0: parallel.
    float angle = 0.0f;
    int profile = -1;           ///< index into Scene::profiles, -1: none. Point and spot only.
    glm::mat4 transform{1.0f};  ///< shines along -z
};

/// How a luminaire spreads its light: luminous intensity [cd] over directions, bilinear between
/// the values. Polar angle 0 is the light's -z, azimuth 0 its +x, growing towards +y.
struct Photometry {
    static constexpr int kPolarSteps = int(lumel::kPolarSteps);
    static constexpr int kAzimuthSteps = int(lumel::kAzimuthSteps);
    std::string name;
    std::vector<float> candela;  ///< [kAzimuthSteps][kPolarSteps + 1]
};

struct Camera {
    std::string name;
    int node = 0;                      ///< index in the file's nodes
    glm::mat4 transform{1.0f};         ///< looks along -z, +y up
    float vertical_fov = 0.8f;         ///< [rad]; ignored when orthographic
    float aspect = 0.0f;               ///< width / height, 0: free
    float orthographic_height = 0.0f;  ///< [m], > 0: orthographic camera
};

/// What is read of materials: base colour and emission alone, or metallic, roughness and F0 too,
/// which else keep their defaults.
enum class MaterialModel { diffuse, glossy };

struct Scene {
    std::string path;                              ///< the file it came from
    MaterialModel model = MaterialModel::diffuse;  ///< what was read of the materials
    std::vector<Texture> textures;
    std::vector<Material> materials;  ///< the file's, then the default material if needed
    std::vector<Mesh> meshes;         ///< the file's; those not shown have no primitives
    std::vector<Instance> instances;  ///< of the file's default scene, in node order
    std::vector<PunctualLight> lights;
    std::vector<Photometry> profiles;  ///< of lights
    Sky sky;
    std::vector<Camera> cameras;
    /// Where 0 of all transforms here is in the file's world [m]: not 0 only for scenes that lie
    /// far from there, where floats are too coarse.
    glm::dvec3 origin{0.0};
    std::vector<std::string> warnings;  ///< sentences for the user
    std::size_t dropped_triangles = 0;  ///< of zero area
    std::string hash;                   ///< 16 hex digits over all content that light depends on
};

/// Reads glTF 2.0 (.gltf with its files, or .glb).
/// Throws Error{input} with file, JSON pointer and reason for anything invalid or unsupported.
Scene read_gltf(const std::string& path, MaterialModel model = MaterialModel::diffuse);

/// Index of the first instance of that name. Throws Error{input} if there is none.
std::uint32_t find_instance(const Scene& scene, const std::string& name);

/// True if any light comes from it.
bool shines(const PunctualLight& light);

/// Luminous intensity [cd] of a point or spot light, colour and all, towards a unit direction in
/// the world: its intensity, cone (KHR_lights_punctual) and profile. A profile's candela stand in
/// for the intensity, which then is a factor.
glm::vec3 intensity_towards(const Scene& scene, const PunctualLight& light,
                            const glm::vec3& direction);

/// What is left of 1 / r² at distance r [m] where a light has a range: KHR_lights_punctual's window
/// max(min(1 - (r / range)⁴, 1), 0); 1 without one.
float range_window(const PunctualLight& light, float distance);

/// What a material looks like at one point. `texcoord`: TEXCOORD_n.
struct MaterialSample {
    glm::vec3 albedo;    ///< ρ, linear, clamped to 0…1: all that is reflected, taken as diffuse
    glm::vec3 diffuse;   ///< ρ_d, where gloss counts
    glm::vec3 specular;  ///< ρ_s; ρ_d + ρ_s ≤ 1
    float roughness;     ///< glTF's, 0…1
    float opacity;       ///< (opaque: 1; mask: 0 or 1; blend: alpha 0…1) × (1 - transmission)
    glm::vec3 tint;      ///< 0…1, of what passes: 1 - opacity of the light does, times this
    glm::vec3 emitted;   ///< luminance [cd/m²], linear
};
MaterialSample sample_material(const Scene& scene, int material,
                               const glm::vec2 texcoord[kTexcoordSets],
                               const glm::vec4& vertex_color);

/// Exponent n of a Phong lobe about the mirror direction that is as wide as glTF's roughness,
/// 1…kMaxShininess: mirrors are blurred.
float shininess_of(double roughness);

/// True if some of the primitive's surface may let light through: it is cut out, blended or glass.
bool may_be_transparent(const Material& material, const Primitive& primitive);

/// True if light of one colour may pass the material more than that of another.
bool is_coloured_glass(const Material& material);

/// True where the material's look does not vary over a surface (no textures are read).
bool is_uniform(const Material& material);

}  // namespace lumel
