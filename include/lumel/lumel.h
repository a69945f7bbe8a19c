// Lumel: lightmaps by radiosity, baked in memory, kept right while things move, or lit anew.
//
// This header is the whole interface; lumel/vulkan.h adds what hosts with a Vulkan device of their
// own need. Start at bake(), LiveScene, LiveLinks or Relight.
//
// Units    metres; right-handed, +y up; angles in radians; light and colours in linear Rec. 709:
//          irradiance in lx, luminance in cd/m², intensity of lamps in cd.
//          A diffuse surface of reflectance ρ under irradiance H shows the luminance ρ H / π.
// Memory   Arguments are copied, results belong to the caller. What is made with a Device refers
//          to it, and the Device must outlive it. Objects move; a moved-from one may only be
//          destroyed or assigned to.
// Threads  No call may overlap another that uses the same Device or object. Calls block until they
//          are done and use all processors. Devices of different Vulkan drivers may not be in use
//          at the same time in one process.
// Errors   A call that cannot do what it says throws Error; out of memory, std::bad_alloc. After
//          Error{input} all is as before the call; after Error{device} end what uses the Device.
//          The library prints nothing.
// Chance   Equal arguments, seed and device give equal bytes.
#ifndef LUMEL_LUMEL_H
#define LUMEL_LUMEL_H

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#define LUMEL_VERSION_MAJOR 0
#define LUMEL_VERSION_MINOR 1
#define LUMEL_VERSION_PATCH 0
/// Of this header, for comparisons: 10000 × major + 100 × minor + patch.
#define LUMEL_VERSION                                                                              \
    (10000 * LUMEL_VERSION_MAJOR + 100 * LUMEL_VERSION_MINOR + LUMEL_VERSION_PATCH)

#define LUMEL_API __attribute__((visibility("default")))

/// Everything is in namespace lumel; v0 marks what one binary interface has in common. The
/// library's own sources define LUMEL_BUILDING, since other names of theirs are in lumel itself.
#ifndef LUMEL_BUILDING
namespace lumel {
namespace v0 {
}
using namespace v0;
}  // namespace lumel
#endif

namespace lumel::v0 {

using Vec2 = std::array<float, 2>;
using Vec3 = std::array<float, 3>;
using Vec4 = std::array<float, 4>;
/// Column after column: element (row, column) is at [4 × column + row].
using Mat4 = std::array<float, 16>;

// What these hold is the library's own.
struct DeviceImpl;
struct SceneImpl;
struct LiveImpl;
struct LinksImpl;
struct RelightImpl;
struct RelightableBake;
struct HostDevice;  // lumel/vulkan.h

inline constexpr Mat4 kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// LUMEL_VERSION of the library that runs.
LUMEL_API int version() noexcept;

// ---------------------------------------------------------------------------------------- errors

enum class ErrorKind {
    input,    ///< an argument, a file or a scene is not as it must be
    device,   ///< there is no usable device, or it failed, or has too little memory
    output,   ///< a file cannot be written
    stopped,  ///< progress ended a bake before there was any light
};

/// what() is one sentence for the user: where, what is wrong, what to do.
class LUMEL_API Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& sentence);
    ~Error() override;
    ErrorKind kind() const noexcept { return kind_; }

private:
    ErrorKind kind_;
};

// ---------------------------------------------------------------------------------------- device

struct DeviceInfo {
    std::string name;
    std::string type;                ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;         ///< "1.3.230"
    std::string driver;              ///< name and version
    std::uint64_t memory_bytes = 0;  ///< of its largest device-local heap
    bool usable = false;
    std::string reason;  ///< why not usable, else empty
};

/// All Vulkan devices of this machine. Throws Error{device} if there is no Vulkan loader.
LUMEL_API std::vector<DeviceInfo> list_devices();

/// Where the work is done. For one that the host has made, see lumel/vulkan.h.
class LUMEL_API Device {
public:
    /// `pick`: an index into list_devices() or a part of a name; empty: the best, which is
    /// discrete before integrated before virtual before cpu.
    /// Throws Error{device} with what was found and why it will not do.
    explicit Device(const std::string& pick = "");
    ~Device();
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;

    const DeviceInfo& info() const;

    const DeviceImpl& impl() const noexcept { return *impl_; }  // for the library itself

private:
    friend LUMEL_API Device use_device(const HostDevice& host);
    explicit Device(std::unique_ptr<DeviceImpl> impl);

    std::unique_ptr<DeviceImpl> impl_;
};

// ----------------------------------------------------------------------------------------- scene

/// 8-bit RGBA, top row first.
struct Texture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< [height][width][4]; colours sRGB-coded, alpha linear
};

inline constexpr int kNone = -1;  ///< in place of an index

enum class Alpha { opaque, mask, blend };

/// As in glTF 2.0, whose texture coordinates have (0, 0) at the top left. Textures are read with
/// Primitive::texcoords, repeated and bilinear.
struct Material {
    std::string name;
    Vec4 base_color{0.8f, 0.8f, 0.8f, 1.0f};  ///< 0…1; RGB is the diffuse reflectance ρ
    int base_color_texture = kNone;           ///< multiplies it
    Vec3 emitted{0.0f, 0.0f, 0.0f};           ///< luminance [cd/m²]
    int emitted_texture = kNone;              ///< multiplies it
    float metallic = 0.0f;   ///< 0…1; only method "glossy" reads this and the next
    float roughness = 1.0f;  ///< 0…1
    int metallic_roughness_texture = kNone;  ///< linear; blue × metallic, green × roughness
    Alpha alpha = Alpha::opaque;             ///< what the alpha of the base colour means
    float alpha_cutoff = 0.5f;               ///< of Alpha::mask
    float transmission = 0.0f;               ///< 0…1, share that is glass: light passes straight
    bool double_sided = false;
};

/// Triangles of one material. Fronts are counter-clockwise.
struct Primitive {
    std::vector<Vec3> positions;  ///< [V]
    std::vector<Vec3> normals;    ///< [V], or empty: flat
    std::vector<Vec2> texcoords;  ///< [V], or empty
    std::vector<Vec2> lightmap;   ///< [V] a layout of your own in 0…1, used unless it overlaps
    std::vector<Vec4> colors;     ///< [V] linear, multiply the base colour; or empty
    std::vector<std::uint32_t> indices;  ///< [3T]
    std::uint32_t material = 0;          ///< index into SceneContent::materials
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// A mesh in its place. Each instance gets texels of its own.
struct Instance {
    std::string name;
    std::uint32_t mesh = 0;
    Mat4 transform = kIdentity;  ///< mesh to world
    int node = kNone;            ///< of a file: index of its node
};

/// A lamp that is no surface, as KHR_lights_punctual has it.
struct Light {
    enum class Kind { point, spot, directional } kind = Kind::point;
    std::string name;
    Vec3 color{1.0f, 1.0f, 1.0f};
    float intensity = 1.0f;             ///< [cd]; directional: [lx]
    Vec3 position{0.0f, 0.0f, 0.0f};    ///< not of directional
    Vec3 direction{0.0f, -1.0f, 0.0f};  ///< that it shines in, of any length; not of point
    float range = 0.0f;                 ///< where its light ends; 0: nowhere
    float inner_cone = 0.0f;            ///< half angles of a spot, 0 ≤ inner ≤ outer ≤ π/2
    float outer_cone = 0.785398f;
    float radius = 0.0f;  ///< of the ball that shines; 0: a point, with sharp shadows
    float angle = 0.0f;   ///< half the angle of the disc of a directional light; 0: sharp shadows
};

/// Luminance over all directions as a latitude-longitude image: row 0 is up (+y), the middle of
/// the image is towards +x, three quarters of its width towards +z.
struct Sky {
    int width = 0, height = 0;
    std::vector<Vec3> luminance;  ///< [height][width] [cd/m²]; empty: no sky
};

struct SceneContent {
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    Sky sky;
};

/// Sky and sun that Scene::add_daylight adds. The sky is of the file, else of the luminance, else,
/// with a sun, that of a clear day, else the scene's own.
struct Daylight {
    std::string sky_file;               ///< .exr or .hdr, latitude-longitude [cd/m²]; or empty
    std::optional<Vec3> sky_luminance;  ///< the same from everywhere [cd/m²]
    /// As bright as on a clear day.
    struct Sun {
        double azimuth = 0.0;    ///< clockwise from north (-z), seen from above: east (+x) is π/2
        double elevation = 0.0;  ///< above the horizon, up to π/2
    };
    std::optional<Sun> sun;
    float sky_scale = 1.0f;  ///< factor to the sky, not to the sun
    double rotation = 0.0;   ///< of sky and sun about +y, counter-clockwise seen from above
};

/// What is read of a file's materials.
enum class Materials {
    diffuse,  ///< base colour and emission
    glossy,   ///< metallic, roughness and specular too, for method "glossy"
};

/// A checked scene. Needs no device.
class LUMEL_API Scene {
public:
    /// Reads a glTF 2.0 file (.gltf or .glb) with the files it names.
    /// Throws Error{input} with the file, the place in it and the reason.
    static Scene load(const std::string& path, Materials materials = Materials::diffuse);
    /// Takes a copy. Triangles without area are dropped, normals made unit.
    /// Throws Error{input}, e.g. "meshes[2].primitives[0]: indices[3] is 24, …", for indices out of
    /// range, arrays of different lengths, what is not finite, and transforms that flatten.
    explicit Scene(const SceneContent& content);
    ~Scene();
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;

    /// A sky takes the place of one that is there; a sun is one more light, named "sun".
    /// Throws Error{input}.
    void add_daylight(const Daylight& daylight);

    std::vector<Instance> instances() const;  ///< those shown, in the world of the scene's file
    std::vector<std::string> lights() const;  ///< names
    /// Index of the first instance of a name. Throws Error{input} if there is none.
    std::uint32_t find_instance(const std::string& name) const;
    /// What reading left out or repaired, as sentences.
    const std::vector<std::string>& warnings() const;

    const SceneImpl& impl() const noexcept { return *impl_; }  // for the library itself

private:
    explicit Scene(std::unique_ptr<SceneImpl> impl);

    std::unique_ptr<SceneImpl> impl_;
};

// --------------------------------------------------------------------------------------- results

/// The density of what is named so.
struct DensityRule {
    std::string pattern;  ///< of names of nodes, meshes or materials, as the shell's: * ? []
    float texels_per_metre = 0.0f;  ///< above 0
};

/// Sizes of the square lightmap, all in texels.
struct AtlasSettings {
    float texels_per_metre = 0.0f;  ///< 0: as dense as fits `size`
    int size = 0;                   ///< fixes the side, 1…16384; 0: as the density asks for
    int max_size = 4096;            ///< largest side; the density is scaled to fit
    int gutter = 2;                 ///< kept free between any two charts, 0…64
    /// Most squares of that side that the map is made of where one is too small, 1…256. All of
    /// them together have 16384 texels a side at most. No chart lies on two of them.
    int pages = 1;
    std::vector<DensityRule> densities;  ///< beside the file's; of two that fit, the later counts
    bool coarse_afar = false;            ///< fewer texels far from cameras and detail
};

/// One primitive of one instance in the lightmap. Vertices are split where charts end.
struct Surface {
    std::uint32_t instance = 0;                ///< index into Scene::instances()
    std::uint32_t primitive = 0;               ///< in its mesh, or in the mesh of the file
    std::vector<std::uint32_t> source_vertex;  ///< [V] the primitive's vertex that it copies
    std::vector<Vec2> lightmap;                ///< [V] coordinates in 0…1, (0, 0) at the top left
    std::vector<std::uint32_t> indices;        ///< [3T] in the primitive's order
    /// [V] which page holds it, or empty: the map has one. Triangles do not mix pages.
    std::vector<std::uint16_t> page;
    float texels_per_metre = 0.0f;  ///< its density
};

/// A lightmap: RGB is H [lx], A is 0 where no surface is. Gutters are filled and seams matched, so
/// that it may be filtered. A double-sided surface shows, chart by chart, its brighter side.
struct Map {
    int width = 0, height = 0;
    std::vector<float> rgba;  ///< [height][width][4], top row first
};

/// A square of the map, for hosts whose textures cannot be as large as that [texels].
struct Page {
    int x = 0, y = 0;  ///< top left
    int side = 0;
};

/// A page by itself. A place of the map is at (lightmap × width − (x, y)) / side there.
/// Throws Error{input} if the page is not inside of the map.
LUMEL_API Map cut_page(const Map& map, const Page& page);

// ------------------------------------------------------------------------------------------ bake

/// Where a bake stands.
struct Progress {
    std::string stage;        ///< "charts", "near field", "solving", …
    double fraction = 0.0;    ///< of the stage, 0…1
    std::uint64_t shots = 0;  ///< shooters so far
    double error = -1.0;      ///< estimated relative error, < 0: not known yet
    double seconds = 0.0;     ///< since the stage began
};

/// Called on the thread that bakes, at each stage and often while solving. False ends the bake
/// early with the best solution so far, or before there is one with Error{stopped}. Must not throw.
using ProgressFunction = std::function<bool(const Progress&)>;

/// Of the light that arrives.
enum class Parts {
    all,
    direct,    ///< straight from emissive surfaces, lamps and sky
    indirect,  ///< what has been reflected on its way
};

struct BakeSettings {
    AtlasSettings atlas;
    /// As `lumel methods` lists them: "links", "stochastic", "glossy", "directions", "progressive",
    /// "gather", "matrix".
    std::string method = "links";
    /// Of the method, by their names on the command line: {{"patches", "512"}}.
    std::map<std::string, std::string> options;
    Parts parts = Parts::all;
    std::uint32_t seed = 1;
    double error = 0.02;      ///< estimated relative error to end at, 0: none
    double seconds = 0.0;     ///< since the bake began, to end solving at; 0: none
    std::uint64_t shots = 0;  ///< to end at, 0: none
};

/// A finished bake. `relightable` is set by method "matrix" with Parts::all, for Relight.
struct Baked {
    Map map;
    std::vector<Surface> surfaces;  ///< by instance, then primitive
    std::vector<Page> pages;        ///< that the map is made of; one, where it is enough
    float texels_per_metre = 0.0f;
    double error = -1.0;  ///< estimated relative error, < 0: not known
    std::uint64_t shots = 0;
    double seconds = 0.0;
    bool interrupted = false;        ///< progress ended it
    std::vector<std::string> notes;  ///< sentences for the user
    std::shared_ptr<const RelightableBake> relightable;
};

/// Lays the scene out and solves for its light. The same map as `lumel bake` writes.
/// Throws Error{input} if a setting is out of its limits, no limit ends the bake, or nothing of
/// the scene can be lit; Error{device}.
LUMEL_API Baked bake(const Device& device, const Scene& scene, const BakeSettings& settings = {},
                     const ProgressFunction& progress = {});

// ------------------------------------------------------------------------------------------ live

/// How light follows a move.
enum class Redistribution {
    incremental,  ///< exact: every patch that shot looks at what moved
    cross,        ///< only what moves looks: much faster where it is small
};

struct LiveSettings {
    AtlasSettings atlas;
    Redistribution redistribution = Redistribution::incremental;
    std::vector<std::uint32_t> movers;  ///< instances that may move; empty: only lamps change
    std::uint32_t seed = 1;
    double residual = 0.0005;  ///< light still to be shot, as a part of all, to rest at
};

/// Where a LiveScene stands.
struct LiveState {
    double residual = 1.0;      ///< light still to be shot, as a part of all
    bool under_way = false;     ///< a move is not wholly redistributed yet
    bool at_rest = false;       ///< update() has nothing left to do
    double milliseconds = 0.0;  ///< that the last update() took
};

/// A scene that stays lit while instances move and lamps change, by shooting on a device.
class LUMEL_API LiveScene {
public:
    /// Lays the scene out; the first updates find its light.
    /// Throws Error{input} if nothing of it can be lit or a mover is no instance; Error{device}.
    LiveScene(const Device& device, const Scene& scene, const LiveSettings& settings);
    ~LiveScene();
    LiveScene(LiveScene&&) noexcept;
    LiveScene& operator=(LiveScene&&) noexcept;

    /// Puts a mover elsewhere (mesh to world, as of Scene::instances()); takes effect in update().
    /// Of several moves before one update(), the last counts. Turns and shifts only. Throws
    /// Error{input}.
    void move(std::uint32_t instance, const Mat4& transform);

    /// An instance emits, or reflects, `factor` times what the scene says; reflectances are kept
    /// from 0 to 1. Throws Error{input} if there is no such instance, or for factors that are
    /// negative or no numbers.
    void set_emission(std::uint32_t instance, const Vec3& factor);
    void set_reflectance(std::uint32_t instance, const Vec3& factor);
    /// The same for a light (index into Scene::lights()) and for the sky.
    void set_light(std::uint32_t light, const Vec3& factor);
    void set_sky(const Vec3& factor);

    /// Works for about this long: moves first, then light that is not shot yet. Does one batch at
    /// least, and takes longer by one batch at most. Infinity: until at rest.
    LiveState update(double budget_ms);
    const LiveState& state() const;  ///< as the last update() left it

    /// The lightmap after the last move that is wholly redistributed, finished as by bake(), which
    /// takes time; lumel/vulkan.h has it as an image on the device, at once.
    Map map() const;
    const std::vector<Surface>& surfaces() const;   ///< by instance, then primitive
    const std::vector<std::string>& notes() const;  ///< of the layout, for the user

    const LiveImpl& impl() const noexcept { return *impl_; }  // for the library itself

private:
    std::unique_ptr<LiveImpl> impl_;
};

/// Where a lamp is.
struct LampPlace {
    std::optional<Vec3> position;   ///< [m] not of directional lights
    std::optional<Vec3> direction;  ///< in which it shines, of any length
};

struct LiveLinksSettings {
    AtlasSettings atlas;
    std::vector<std::uint32_t> movers;  ///< instances that may move
    std::uint32_t rays = 64;            ///< that each lumel keeps: 4, 16, 64 or 256
    bool filter = true;                 ///< of the noise in what is shown
    std::uint32_t seed = 1;
    double residual = 0.0001;  ///< light still to bounce, as a part of all, to rest at
};

/// Where LiveLinks stand.
struct LiveLinksState {
    double residual = 1.0;       ///< light still to bounce, as a part of all
    double dark_residual = 1.0;  ///< the same of lumels between 0.5 and 30 % of the mean, of theirs
    bool under_way = false;      ///< a move is not wholly followed yet
    bool at_rest = false;        ///< update() has nothing left to do
    double milliseconds = 0.0;   ///< that the last update() took
};

/// A scene that stays lit while instances and lamps move, lamps are dimmed and surfaces painted.
/// Every lumel traces its rays once, and what they met is kept: dimming and painting trace nothing,
/// a move only the rays that it starts, ends or stops. At rest the light is that of a scene solved
/// anew, within the residual. Works on the host, needs no Device, and takes about 4 × rays + 100
/// bytes for each lumel, 12 for each of them and each lamp, and up to 250 more with the filter.
class LUMEL_API LiveLinks {
public:
    /// Lays the scene out, traces all links and finds all direct light. The scene is copied.
    /// Throws Error{input} if nothing of it can be lit, a mover is no instance, all of it moves,
    /// it has coloured glass, or a setting is out of its limits; Error{device} if rays cannot be
    /// cast.
    explicit LiveLinks(const Scene& scene, const LiveLinksSettings& settings = {});
    ~LiveLinks();
    LiveLinks(LiveLinks&&) noexcept;
    LiveLinks& operator=(LiveLinks&&) noexcept;

    /// Puts a mover elsewhere (mesh to world, as of Scene::instances()); takes effect in update().
    /// Of several moves before it is followed, the last counts. Turns and shifts only. Throws
    /// Error{input}.
    void move(std::uint32_t instance, const Mat4& transform);
    /// Moves or turns the lamps of that name; what of `place` is not set is as it is. Finds their
    /// light at once. Throws Error{input} if there is none, for positions of directional lights,
    /// and for what is no number.
    void move_lamp(const std::string& name, const LampPlace& place);

    /// All lights of that name, and all surfaces of a material of that name, send `factor` times
    /// what the scene says. Throws Error{input} if there is none, or for factors that are negative
    /// or no numbers.
    void set_lamp(const std::string& name, const Vec3& factor);
    /// The same of the sky. Throws Error{input} if there is none.
    void set_sky(const Vec3& factor);
    /// A material reflects with this base colour, 0…1, times its texture. The first time for each
    /// material takes longer. Throws Error{input}.
    void set_color(const std::string& material, const Vec3& color);

    /// Works for about this long: on light that arrives straight in the new places, which is shown
    /// when it is whole; then on what bounces. Takes longer by a few milliseconds at most.
    /// Infinity: until at rest.
    LiveLinksState update(double budget_ms);
    const LiveLinksState& state() const;  ///< as the last update() left it

    /// The lightmap as update() left it, finished as by bake(), which takes time.
    Map map() const;
    /// H [lx] alone, without gutters and seams, which takes little: RGB, A is 1 where there is a
    /// lumel, else 0; of front sides.
    Map lumels() const;
    const std::vector<Surface>& surfaces() const;   ///< by instance, then primitive
    const std::vector<std::string>& notes() const;  ///< of the layout, for the user

private:
    std::unique_ptr<LinksImpl> impl_;
};

// --------------------------------------------------------------------------------------- relight

/// A baked scene under any light, by one multiply: H = Σ f_s H_s over its sources s. All factors
/// are 1 at first.
class LUMEL_API Relight {
public:
    /// Throws Error{input} if the bake is not relightable; Error{device}.
    Relight(const Device& device, const Baked& baked);
    /// Reads scene.lumelmat, as save() or `lumel bake --solver matrix` wrote it. Its maps have
    /// filled gutters, but seams and buried texels as they are.
    /// Throws Error{input} if it is missing or damaged; Error{device}.
    Relight(const Device& device, const std::string& path);
    ~Relight();
    Relight(Relight&&) noexcept;
    Relight& operator=(Relight&&) noexcept;

    /// Names of the sources: lights, emissive instances, "sky".
    std::vector<std::string> lights() const;
    /// What a source, or all that a material of this name makes shine, sends is `factor` times what
    /// was baked. Throws Error{input}, with the names there are, for another name and for factors
    /// that are negative or no numbers.
    void set_light(const std::string& name, const Vec3& factor);
    /// Moves or turns a lamp; map() then draws its shadow maps anew. What of `place` is not set is
    /// as it was baked. Throws Error{input} for surfaces, the sky and names of several lamps, for
    /// positions of directional lights, and if this was read from a file, which has no scene.
    void move_light(const std::string& name, const LampPlace& place);
    /// The lightmap with factors and places set, in the layout of the bake.
    Map map();
    /// Writes scene.lumelmat. Throws Error{output}.
    void save(const std::string& path) const;

private:
    std::unique_ptr<RelightImpl> impl_;
};

}  // namespace lumel::v0

#endif
