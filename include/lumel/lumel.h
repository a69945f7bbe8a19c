// Lumel: radiosity lightmaps, baked in memory, kept up to date while objects move, or relit.
//
// This header is the whole interface; lumel/vulkan.h adds support for the host's own Vulkan device.
// Start at bake(), LiveScene, LiveLinks or Relight. lumel/lumel_c.h is for hosts in C.
//
// Units    metres; right-handed, +y up; angles in radians; light and colours in linear Rec. 709:
//          irradiance in lx, luminance in cd/m², intensity of lamps in cd.
//          A diffuse surface of reflectance ρ under irradiance H has the luminance ρ H / π.
// Memory   Arguments are copied; results belong to the caller. Objects made with a Device refer to
//          it; the Device must outlive them. Objects are movable; a moved-from object may only be
//          destroyed or assigned to.
// Threads  No call may overlap another that uses the same Device or object. Calls block until they
//          are done and use all CPU cores. Devices of different Vulkan drivers must not be in use
//          at the same time in one process.
// Errors   Functions throw Error on failure, std::bad_alloc if out of memory. After Error{input}
//          everything is as before the call; after Error{device} destroy whatever uses the Device.
//          The library prints nothing; on_warning() passes on what the user should know.
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
/// Version of this header, for comparisons: 10000 × major + 100 × minor + patch.
#define LUMEL_VERSION                                                                              \
    (10000 * LUMEL_VERSION_MAJOR + 100 * LUMEL_VERSION_MINOR + LUMEL_VERSION_PATCH)

#define LUMEL_API __attribute__((visibility("default")))

/// Everything is in namespace lumel; v0 is the version of the binary interface. The library's own
/// sources define LUMEL_BUILDING because they have other names in lumel itself.
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
/// Column-major: element (row, column) is at [4 × column + row].
using Mat4 = std::array<float, 16>;

// Internal types.
struct DeviceImpl;
struct SceneImpl;
struct LiveImpl;
struct LinksImpl;
struct RelightImpl;
struct BakedSolution;
struct HostDevice;  // lumel/vulkan.h

inline constexpr Mat4 kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// LUMEL_VERSION of the library at run time.
LUMEL_API int version() noexcept;

// ---------------------------------------------------------------------------------------- errors

enum class ErrorKind {
    input,    ///< invalid argument, file or scene
    device,   ///< no usable device, or it failed or ran out of memory
    output,   ///< a file cannot be written
    stopped,  ///< progress ended a bake before it had a solution
};

/// The message what() is one sentence for the user: location, fault and remedy.
class LUMEL_API Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& sentence);
    ~Error() override;
    ErrorKind kind() const noexcept { return kind_; }

private:
    ErrorKind kind_;
};

/// Called with a message for the user, in one sentence.
using WarningFunction = std::function<void(const std::string&)>;

/// Sets the function that receives all messages of this process: what files lack, what was
/// repaired, what a bake should have. Scene::warnings(), Baked::notes and the like have those of
/// their own. It runs on the thread of the call that it concerns, before that returns; it must
/// neither throw nor call this. Empty: none. Once this has returned, the former function is not
/// called any more. Thread-safe.
LUMEL_API void on_warning(WarningFunction function);

// ---------------------------------------------------------------------------------------- device

struct DeviceInfo {
    std::string name;
    std::string type;                ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;         ///< "1.3.230"
    std::string driver;              ///< name and version
    std::uint64_t memory_bytes = 0;  ///< size of the largest device-local heap
    bool usable = false;
    std::string reason;  ///< why the device is not usable, else empty
};

/// All Vulkan devices of this machine. Throws Error{device} if there is no Vulkan loader.
LUMEL_API std::vector<DeviceInfo> list_devices();

/// A Vulkan device for computation. use_device() in lumel/vulkan.h wraps a device of the host.
class LUMEL_API Device {
public:
    /// `pick`: index into list_devices() or part of a name. Empty selects the best usable device,
    /// in the order discrete, integrated, virtual, cpu. Throws Error{device} with the devices found
    /// and why each is unsuitable.
    explicit Device(const std::string& pick = "");
    ~Device();
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;

    const DeviceInfo& info() const;

    const DeviceImpl& impl() const noexcept { return *impl_; }  // internal

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

inline constexpr int kNone = -1;  ///< instead of an index

enum class Alpha { opaque, mask, blend };

/// As in glTF 2.0: texture coordinates have (0, 0) at the top left. Textures use
/// Primitive::texcoords, repeat wrapping and bilinear filtering.
struct Material {
    std::string name;
    Vec4 base_color{0.8f, 0.8f, 0.8f, 1.0f};  ///< 0…1; RGB is the diffuse reflectance ρ
    int base_color_texture = kNone;           ///< multiplies base_color
    Vec3 emitted{0.0f, 0.0f, 0.0f};           ///< luminance [cd/m²]
    int emitted_texture = kNone;              ///< multiplies emitted
    float metallic = 0.0f;                   ///< 0…1; this and the next two: method "glossy" only
    float roughness = 1.0f;                  ///< 0…1
    int metallic_roughness_texture = kNone;  ///< linear; blue × metallic, green × roughness
    Alpha alpha = Alpha::opaque;             ///< meaning of the alpha of base_color
    float alpha_cutoff = 0.5f;               ///< for Alpha::mask
    float transmission = 0.0f;  ///< 0…1, transmitted share: light passes without refraction
    bool double_sided = false;
};

/// Triangles of one material, front faces counter-clockwise.
struct Primitive {
    std::vector<Vec3> positions;  ///< [V]
    std::vector<Vec3> normals;    ///< [V], or empty for flat shading
    std::vector<Vec2> texcoords;  ///< [V], or empty
    std::vector<Vec2> lightmap;  ///< [V] your own layout in 0…1, used unless it overlaps; or empty
    std::vector<Vec4> colors;    ///< [V] linear, 0…1, multiply the base colour; or empty
    std::vector<std::uint32_t> indices;  ///< [3T]
    std::uint32_t material = 0;          ///< index into SceneContent::materials
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// A placed mesh. Each instance has its own texels.
struct Instance {
    std::string name;
    std::uint32_t mesh = 0;
    Mat4 transform = kIdentity;  ///< mesh to world
    int node = kNone;            ///< index of its node in the file
};

/// A punctual light, as in KHR_lights_punctual.
struct Light {
    enum class Kind { point, spot, directional } kind = Kind::point;
    std::string name;
    Vec3 color{1.0f, 1.0f, 1.0f};
    float intensity = 1.0f;             ///< [cd]; directional: [lx]
    Vec3 position{0.0f, 0.0f, 0.0f};    ///< [m] ignored if directional
    Vec3 direction{0.0f, -1.0f, 0.0f};  ///< direction of its light, any length; ignored if point
    float range = 0.0f;                 ///< maximum distance of its light [m]; 0: unlimited
    float inner_cone = 0.0f;            ///< half angles of a spot, 0 ≤ inner ≤ outer ≤ π/2
    float outer_cone = 0.785398f;
    float radius = 0.0f;  ///< [m] radius of a spherical source; 0: a point, sharp shadows
    float angle = 0.0f;   ///< angular radius of a directional light; 0: sharp shadows
};

/// Luminance over all directions as a latitude-longitude image. Row 0 is up (+y), the middle of the
/// image is +x, and +z is at three quarters of its width.
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

/// Sky and sun for Scene::add_daylight. The first of these that is given becomes the sky: the file,
/// the luminance, the sky of the CIE, the clear sky of the sun, the scene's own.
struct Daylight {
    struct Sun {
        double azimuth = 0.0;    ///< clockwise from north (-z), seen from above: east (+x) is π/2
        double elevation = 0.0;  ///< above the horizon, -π/2…π/2
    };
    /// A standard sky of the CIE (ISO 15469): 1 to 4 are overcast, 5 is uniform, 6 to 10 are partly
    /// cloudy, 11 to 15 clear; 16 is the traditional overcast sky.
    struct Cie {
        int type = 16;
        float lux = 10'000.0f;   ///< illuminance of an open horizontal plane [lx]
        std::optional<Sun> sun;  ///< of the sky alone; else Daylight::sun. Types 1, 3, 5, 16: none
    };

    std::string sky_file;               ///< .exr or .hdr, latitude-longitude [cd/m²]; or empty
    std::optional<Vec3> sky_luminance;  ///< uniform sky [cd/m²]
    std::optional<Cie> cie;
    std::optional<Sun> sun;  ///< of a clear day
    float sky_scale = 1.0f;  ///< factor for the sky, not for the sun
    float ground = 0.0f;     ///< albedo below the horizon, 0…1; 0: none; ignored for sky images
    double rotation = 0.0;   ///< rotation of sky and sun about +y, counter-clockwise from above
};

/// Material properties to read from a file.
enum class Materials {
    diffuse,  ///< base colour and emission
    glossy,   ///< also metallic, roughness and specular, for method "glossy"
};

/// A checked scene; needs no device. Materials reflect at most 95 % of the light in the brightest
/// channel; a warning names those that would reflect more.
class LUMEL_API Scene {
public:
    /// Reads a glTF 2.0 file (.gltf or .glb) and the files that it names. Throws Error{input} with
    /// the file, the location in it and the reason.
    static Scene load(const std::string& path, Materials materials = Materials::diffuse);
    /// Copies `content`, drops triangles of zero area and normalises normals. Throws Error{input},
    /// e.g. "meshes[2].primitives[0]: indices[3] is 24, …", for indices out of range, arrays of
    /// different lengths, values that are not finite, and transforms without volume.
    explicit Scene(const SceneContent& content);
    ~Scene();
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;

    /// Replaces the sky and adds the sun as a light named "sun". Throws Error{input}.
    void add_daylight(const Daylight& daylight);

    std::vector<Instance> instances() const;  ///< visible ones, world space of the file
    std::vector<std::string> lights() const;  ///< names
    /// Index of the first instance with this name. Throws Error{input} if there is none.
    std::uint32_t find_instance(const std::string& name) const;
    /// Warnings: features ignored or data repaired while loading.
    const std::vector<std::string>& warnings() const;

    const SceneImpl& impl() const noexcept { return *impl_; }  // internal

private:
    explicit Scene(std::unique_ptr<SceneImpl> impl);

    std::unique_ptr<SceneImpl> impl_;
};

// --------------------------------------------------------------------------------------- results

/// Texel density of nodes, meshes or materials whose name matches `pattern`.
struct DensityRule {
    std::string pattern;            ///< shell wildcards * ? []
    float texels_per_metre = 0.0f;  ///< > 0
};

/// Sides of double-sided surfaces in the map.
enum class Sides {
    automatic,  ///< both, with texels of their own, if light may reach both
    both,       ///< both, always
    brighter,   ///< the brighter side on average, per chart
    front,      ///< the front
};

/// Sizes of the square lightmap [texels].
struct AtlasSettings {
    float texels_per_metre = 0.0f;  ///< 0: the highest density that fits `size`
    int size = 0;                   ///< fixed side, 1…16384; 0: derived from the density
    int max_size = 4096;            ///< maximum side; the density is reduced to fit
    int gutter = 2;                 ///< free space between two charts, 0…64
    /// Maximum number of squares of this side, 1…256, used if one is too small. All squares
    /// together have at most 16384 texels a side. No chart is on two of them.
    int pages = 1;
    /// LiveScene, and bake() with method "matrix", have one texel for both sides: automatic means
    /// brighter there, and both is refused. In LiveLinks so do movers with automatic.
    Sides sides = Sides::automatic;
    std::vector<DensityRule> densities;  ///< beside the file's; the last match applies
    bool coarse_afar = false;            ///< fewer texels far from cameras and detail
};

/// One primitive of one instance in the lightmap, or its back. Vertices are split at chart borders.
struct Surface {
    std::uint32_t instance = 0;                ///< index into Scene::instances()
    std::uint32_t primitive = 0;               ///< index in the source mesh or in that of the file
    std::vector<std::uint32_t> source_vertex;  ///< [V] the source primitive's vertex
    std::vector<Vec2> lightmap;                ///< [V] coordinates in 0…1, (0, 0) at the top left
    /// [3T] triangles in the primitive's order, without those of zero area
    std::vector<std::uint32_t> indices;
    /// True for the back of the preceding surface, if any of it has texels of its own: the same
    /// triangles with reversed winding; negate the normals. Draw both with back-face culling, and
    /// double-sided primitives without a back without culling.
    bool back = false;
    /// [V] index into pages, or empty if there is one page. A triangle has one page.
    std::vector<std::uint16_t> page;
    float texels_per_metre = 0.0f;  ///< texel density of this surface
};

/// A lightmap: RGB is H [lx], A is 0 where no surface is. Gutters are filled and seams matched for
/// filtering.
struct Map {
    int width = 0, height = 0;
    std::vector<float> rgba;  ///< [height][width][4], top row first
};

/// A square of the map, for hosts with smaller textures [texels].
struct Page {
    int x = 0, y = 0;  ///< top left
    int side = 0;
};

/// Returns one page. Position in it: (lightmap × width − (x, y)) / side. Throws Error{input} if the
/// page is not inside the map.
LUMEL_API Map cut_page(const Map& map, const Page& page);

// ------------------------------------------------------------------------------------------ bake

/// Status of a bake.
struct Progress {
    std::string stage;        ///< "charts", "near field", "solving", "lamps", "daylight", …
    double fraction = 0.0;    ///< fraction of the stage, 0…1
    std::uint64_t shots = 0;  ///< shooters so far
    double error = -1.0;      ///< estimated relative error; < 0: unknown
    double seconds = 0.0;     ///< since the stage began
};

/// Called on the thread that bakes, at each stage and repeatedly while solving. Returning false
/// ends the bake early: with the best solution so far, or with Error{stopped} if there is none.
/// Must not throw.
using ProgressFunction = std::function<bool(const Progress&)>;

/// Components of the irradiance.
enum class Parts {
    all,
    direct,    ///< from emissive surfaces, lamps and sky without reflection
    indirect,  ///< reflected at least once
};

/// Incoming light over directions, for normal maps.
enum class Directional {
    none,
    sh1,  ///< spherical harmonics of bands 0 and 1: 4 coefficients
    sh2,  ///< also band 2: 9 coefficients
};

/// Joins all lamps whose names fit a pattern.
struct LampGroup {
    std::string name;
    std::string pattern;  ///< * and ? match letters
};

struct BakeSettings {
    AtlasSettings atlas;
    /// An id that `lumel methods` lists: "links", "stochastic", "glossy", "directions",
    /// "progressive", "gather", "matrix".
    std::string method = "links";
    /// Options of the method, by their names on the command line: {{"patches", "512"}}.
    std::map<std::string, std::string> options;
    Parts parts = Parts::all;
    Directional directional = Directional::none;  ///< requires a Device and Parts::all
    bool per_lamp = false;                        ///< fills Baked::lamps; only links
    std::vector<LampGroup> groups;                ///< of lamps that become one map
    /// An EPW file, a year of hours at one place: fills Baked::daylight. Requires Parts::all and
    /// OpenBLAS. Empty: none.
    std::string weather_file;
    std::uint32_t seed = 1;
    // Targets and limits; the first that is reached ends the bake, targets once all are. If none is
    // given, those of `lumel bake`: with links 0.005 of visible noise and an eye_error of 0.05, but
    // at most 96 rays per lumel; with other methods an error of 0.02.
    std::optional<double> error;  ///< target for the estimated relative error; 0: none
    double dark_error = 0.0;      ///< target below a third of the mean light; only links; 0: none
    double eye_error = 0.0;       ///< target relative to the light around; only links; 0: none
    /// Target for the noise that is seen on plain walls, relative to their light; only links; 0:
    /// none.
    double visible_noise = 0.0;
    double seconds = 0.0;          ///< time limit, counted from the start of the bake; 0: none
    std::uint64_t shots = 0;       ///< limit of shots, with links: rays per lumel; 0: none
    std::uint64_t max_memory = 0;  ///< limit of CPU and GPU memory, each [bytes]; 0: all available
};

/// Light of a lamp, or of a group.
struct LampMap {
    std::string name;  ///< of the light, of the emissive instance, or of the group; or "sky"
    std::string kind;  ///< "sky", "sun", "point", "spot", "surface" or "group"
    std::vector<std::string> members;  ///< names of a group's lamps, or the lamp's own
    Map map;
    double error = 0.0;  ///< estimated, relative to its own light
    /// Colour of its light, linear RGB, the largest channel 1, for write_scene(): set it if you
    /// change `map`.
    std::array<double, 3> color{1.0, 1.0, 1.0};
};

/// Light of sky and sun in one hour, alone; of the sun only after a reflection.
struct DaylightMap {
    std::string hour;  ///< "06-21T12": from 12 to 13 o'clock on 21 June, local standard time
    Map map;
};

/// An hour with light.
struct DaylightHour {
    std::string hour;            ///< as in DaylightMap
    Vec3 sun{0.0f, 1.0f, 0.0f};  ///< unit direction to the sun in the middle of the hour
    float lux = 0.0f;            ///< illuminance by direct sun on a plane that faces it [lx]
    double mean = 0.0;           ///< mean illuminance of all surfaces, without direct sun [lx]
    double error = 0.0;          ///< estimated, relative to the light of the hour
    std::vector<float> weights;  ///< [K] of DaylightMaps::maps, signed
};

/// Daylight over a year, whatever lights the scene has: the light of an hour is the sum of K maps
/// with its weights. Direct sun is in no map, because a sum of a few maps cannot have its edges:
/// shade it by `sun` and `lux`.
struct DaylightMaps {
    std::string place;                       ///< name in the weather file
    double latitude = 0.0, longitude = 0.0;  ///< north and east [rad]
    double error = 0.0;  ///< of the sums, due to their number of maps: RMS over all hours, relative
    std::vector<DaylightMap> maps;    ///< [K] of the hours that tell most of the others, at most 48
    std::vector<DaylightHour> hours;  ///< in the order of the calendar
};

/// A finished bake.
struct Baked {
    Map map;
    /// [4 or 9] maps of coefficient l² + l + m of the incoming radiance [cd/m²], in real harmonics
    /// orthonormal over the sphere, world axes. Irradiance for a normal n: H(n) = Σ A_l c_lm
    /// Y_lm(n) with A = π, 2π/3, π/4.
    std::vector<Map> directional;
    /// Light is linear in its lamps: these add up to `map`, and a dimmed or coloured lamp is its
    /// map times a factor per channel. At most 64.
    std::vector<LampMap> lamps;
    /// With BakeSettings::weather_file; empty if `progress` ended the bake before, and if no
    /// daylight reaches a surface.
    std::optional<DaylightMaps> daylight;
    std::vector<Surface> surfaces;  ///< by instance, then primitive, then side
    std::vector<Page> pages;        ///< pages of the map, at least one
    float texels_per_metre = 0.0f;
    double error = -1.0;      ///< estimated relative error; < 0: unknown
    double eye_error = -1.0;  ///< relative to the light around; < 0: unknown
    /// Of plain walls, relative to their light: 95 % of charts, by the roots of their areas, have
    /// less; < 0: unknown.
    double visible_noise = -1.0;
    std::uint64_t shots = 0;
    double seconds = 0.0;
    bool interrupted = false;        ///< ended by progress
    bool relightable = false;        ///< Relight can use it: method "matrix", Parts::all
    std::vector<std::string> notes;  ///< messages for the user
    /// For Relight, probes(), write_scene() and write_baked_scene(): the scene with its light,
    /// about 300 bytes per lumel and the scene's file, textures and triangles. Reset it to free
    /// them.
    std::shared_ptr<const BakedSolution> solution;
};

/// Builds the atlas and solves for the light; returns the same map as `lumel bake` writes on the
/// same device. Throws Error{input} if a setting is out of range, no limit ends the bake, no
/// surface can be lit, the weather file cannot be used, or OpenBLAS is missing that method "matrix"
/// and daylight need; Error{device}, also if memory does not suffice: the Device remains usable if
/// that is known before the solve.
LUMEL_API Baked bake(const Device& device, const Scene& scene, const BakeSettings& settings = {},
                     const ProgressFunction& progress = {});
/// Bakes on the CPU, without Vulkan. Throws Error{input} also for methods other than "links", for
/// rays of a device, and for directional maps.
LUMEL_API Baked bake(const Scene& scene, const BakeSettings& settings = {},
                     const ProgressFunction& progress = {});

/// Incoming light at a point in the air, as spherical harmonics.
struct Probe {
    std::array<Vec3, 9> coefficients{};  ///< as in Baked::directional [cd/m²]
    double noise = 0.0;   ///< standard error of the noisiest coefficient's luminance [cd/m²]
    bool inside = false;  ///< inside an object: no light
};

/// Light at `places` [m] in a bake of all light; runs on the CPU. samples: rays per probe, more
/// where noise is above 0.5 % of band 0, at most 2²⁰. Many places in one call are faster. Throws
/// Error{input} if the bake has no solution, or of one part of the light only, or a place is not
/// finite.
LUMEL_API std::vector<Probe> probes(const Baked& baked, const std::vector<Vec3>& places,
                                    std::uint32_t samples = 4096);

/// The lightmap in a glTF file.
enum class LightmapFormat {
    ktx2,    ///< half floats in KTX2, and a PNG for loaders that do not read it
    rgb9e5,  ///< three mantissas and a shared exponent in KTX2, and the PNG
    png,     ///< the PNG alone: 8 bits, linear, bright texels clipped
    none,    ///< no lightmap inside, only its coordinates
};

/// Writes the scene with Baked::map to a .glb file, as `lumel bake` writes scene.glb: all that the
/// scene's file had when it was read, with the lightmap bound by MOZ_lightmap. Of a scene made in
/// memory, meshes, materials, textures and lamps, with node i for instance i, but not the sky.
/// Lamps are baked and therefore hidden, except in a bake of indirect light. A scene without camera
/// gets one. Baked::lamps are added for viewers that dim lamps, such as lumel-three. Viewers may
/// refuse transforms with shear. Throws Error{input} if the bake has no solution or a map has
/// another size; Error{output}.
LUMEL_API void write_scene(const std::string& path, const Baked& baked,
                           LightmapFormat format = LightmapFormat::ktx2);
/// Writes the scene to a .glb file that any viewer shows lit, as `lumel bake` writes
/// scene-baked.glb: the light of the solution, whatever Baked::map holds, in 8-bit textures of at
/// most `size` texels a side. Throws as write_scene().
LUMEL_API void write_baked_scene(const std::string& path, const Baked& baked, int size = 2048);

// ------------------------------------------------------------------------------------------ live

/// Update of the light after a move.
enum class Redistribution {
    incremental,  ///< exact: all patches that shot render views of moved objects
    cross,        ///< views from movable objects only: much faster if they are small
};

struct LiveSettings {
    AtlasSettings atlas;
    Redistribution redistribution = Redistribution::incremental;
    std::vector<std::uint32_t> movers;  ///< movable instances; empty: only lamps change
    std::uint32_t seed = 1;
    double residual = 0.0005;  ///< convergence threshold for LiveState::residual
};

/// Status of a LiveScene.
struct LiveState {
    double residual = 1.0;      ///< unshot light relative to all light
    bool under_way = false;     ///< a move is not completely redistributed yet
    bool at_rest = false;       ///< converged: update() has no work left
    double milliseconds = 0.0;  ///< duration of the last update()
};

/// Keeps a scene lit while instances move and lamps change, by shooting on a GPU.
class LUMEL_API LiveScene {
public:
    /// Builds the atlas; the light is computed by update(). Throws Error{input} if no surface can
    /// be lit or a mover is no instance; Error{device}.
    LiveScene(const Device& device, const Scene& scene, const LiveSettings& settings);
    ~LiveScene();
    LiveScene(LiveScene&&) noexcept;
    LiveScene& operator=(LiveScene&&) noexcept;

    /// Sets the transform of a mover (mesh to world, as in Scene::instances()); update() applies
    /// it. The last of several moves before an update() counts. Requires a rigid motion. Throws
    /// Error{input}.
    void move(std::uint32_t instance, const Mat4& transform);

    /// Scales the emission or reflectance of an instance relative to the scene; reflectances are
    /// clamped to 0…1. Throws Error{input} if there is no such instance or a factor is negative or
    /// not finite.
    void set_emission(std::uint32_t instance, const Vec3& factor);
    void set_reflectance(std::uint32_t instance, const Vec3& factor);
    /// Scales a light (index into Scene::lights()) or the sky, likewise.
    void set_light(std::uint32_t light, const Vec3& factor);
    void set_sky(const Vec3& factor);

    /// Runs for about `budget_ms`: applies moves first, then shoots. Runs at least one batch and
    /// exceeds the budget by at most one batch. Infinity: until converged.
    LiveState update(double budget_ms);
    const LiveState& state() const;  ///< after the last update()

    /// The lightmap after the last completely redistributed move, finished as by bake(), which
    /// takes time. lumel/vulkan.h returns it as an image on the GPU, without delay.
    Map map() const;
    const std::vector<Surface>& surfaces() const;   ///< by instance, then primitive
    const std::vector<std::string>& notes() const;  ///< atlas warnings, for the user

    const LiveImpl& impl() const noexcept { return *impl_; }  // internal

private:
    std::unique_ptr<LiveImpl> impl_;
};

/// Position and direction of a lamp.
struct LampPlace {
    std::optional<Vec3> position;   ///< [m] not for directional lights
    std::optional<Vec3> direction;  ///< direction of its light, any length
};

struct LiveLinksSettings {
    AtlasSettings atlas;
    std::vector<std::uint32_t> movers;  ///< movable instances
    std::uint32_t rays = 64;            ///< stored rays per lumel: 4, 16, 64 or 256
    bool filter = true;                 ///< filters ray noise for display
    std::uint32_t seed = 1;
    double residual = 0.0001;  ///< convergence threshold for both residuals
};

/// Status of LiveLinks.
struct LiveLinksState {
    double residual = 1.0;       ///< residual indirect light, relative to all light
    double dark_residual = 1.0;  ///< lumels at 0.5…30 % of the mean, relative to theirs
    bool under_way = false;      ///< a move is not completely retraced yet
    bool at_rest = false;        ///< converged: update() has no work left
    double milliseconds = 0.0;   ///< duration of the last update()
};

/// Keeps a scene lit while instances and lamps move, lamps are dimmed and albedos change. Every
/// lumel traces its rays once and stores their hits. Dimming and albedo changes trace no rays; a
/// move retraces only the rays that start on the object, ended on it or now hit it. Converged light
/// equals that of a new solution within the residual. Runs on the CPU without a Device. Takes about
/// 4 × rays + 100 bytes per lumel, 12 per lumel and lamp, and up to 250 per lumel for the filter.
class LUMEL_API LiveLinks {
public:
    /// Builds the atlas, traces all links and computes direct light. Throws Error{input} if no
    /// surface can be lit, a mover is no instance, all instances move, there is coloured glass, or
    /// a setting is out of range; Error{device} if rays cannot be traced.
    explicit LiveLinks(const Scene& scene, const LiveLinksSettings& settings = {});
    ~LiveLinks();
    LiveLinks(LiveLinks&&) noexcept;
    LiveLinks& operator=(LiveLinks&&) noexcept;

    /// Sets the transform of a mover (mesh to world, as in Scene::instances()); update() applies
    /// it. The last of several pending moves counts. Requires a rigid motion. Throws Error{input}.
    void move(std::uint32_t instance, const Mat4& transform);
    /// Moves or turns all lamps of this name and updates their light at once. Members of `place`
    /// without a value do not change. Throws Error{input} if there is no such lamp, for
    /// positions of directional lights, and for values that are not finite.
    void move_lamp(const std::string& name, const LampPlace& place);

    /// Scales all lights of this name and the emission of materials of this name, relative to the
    /// scene. Throws Error{input} if there are none, or a factor is negative or not finite.
    void set_lamp(const std::string& name, const Vec3& factor);
    /// Scales the sky relative to the scene. Throws Error{input} if there is no sky.
    void set_sky(const Vec3& factor);
    /// Sets the base colour of a material, 0…1, which its texture multiplies. The first call for
    /// each material takes longer. Throws Error{input}.
    void set_color(const std::string& material, const Vec3& color);

    /// Runs for about `budget_ms`: updates direct light, which is shown when it is complete, then
    /// indirect light. Exceeds the budget by at most a few milliseconds. Infinity: until converged.
    LiveLinksState update(double budget_ms);
    const LiveLinksState& state() const;  ///< after the last update()
    /// Solves the scene as it is now by the method of bake(), with all edits, to this estimated
    /// relative error, or with 384 rays per lumel at 2 % and four times as many at half of that,
    /// and returns the error reached. map() and lumels() then contain this light until the next
    /// edit. Takes as long as a bake. Throws Error{input} unless the error is above 0, or if the
    /// light of a closed room is never absorbed.
    double bake(double error = 0.02);

    /// The lightmap after the last update() or bake(), finished as by bake(), which takes time.
    Map map() const;
    /// H [lx] without gutters and seams, in little time: RGB; A is 1 at lumels, else 0. Where two
    /// sides share a texel, that of the front.
    Map lumels() const;
    const std::vector<Surface>& surfaces() const;   ///< by instance, then primitive, then side
    const std::vector<std::string>& notes() const;  ///< atlas warnings, for the user

private:
    std::unique_ptr<LinksImpl> impl_;
};

// --------------------------------------------------------------------------------------- relight

/// A baked scene under any light, by one matrix product: H = Σ f_s H_s over its sources s. All
/// factors f_s are initially 1.
class LUMEL_API Relight {
public:
    /// Throws Error{input} if the bake is not relightable or has no solution; Error{device}.
    Relight(const Device& device, const Baked& baked);
    /// Reads scene.lumelmat, written by save() or `lumel bake --solver matrix`. Its maps have
    /// filled gutters; seams and buried texels are not corrected. Throws Error{input} if the file
    /// is missing or damaged; Error{device}.
    Relight(const Device& device, const std::string& path);
    ~Relight();
    Relight(Relight&&) noexcept;
    Relight& operator=(Relight&&) noexcept;

    /// Names of the sources: lights, emissive instances, "sky".
    std::vector<std::string> lights() const;
    /// Scales a source, or all emission of a material of this name, relative to the bake. Throws
    /// Error{input}, with the valid names, for an unknown name and for factors that are negative or
    /// not finite.
    void set_light(const std::string& name, const Vec3& factor);
    /// Moves or turns a lamp; map() renders its shadow maps again. Members of `place` without a
    /// value are as baked. Throws Error{input} for surfaces, the sky, ambiguous names, positions of
    /// directional lights, and if this was read from a file, which has no scene.
    void move_light(const std::string& name, const LampPlace& place);
    /// The lightmap for the current factors and lamp positions, in the atlas of the bake.
    Map map();
    /// Writes scene.lumelmat. Throws Error{output}.
    void save(const std::string& path) const;

private:
    std::unique_ptr<RelightImpl> impl_;
};

}  // namespace lumel::v0

#endif
