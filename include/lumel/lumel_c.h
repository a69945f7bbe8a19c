/* clang-format off */
/* Lumel for hosts in C, and for other languages that call C: scenes in memory or from files, baked
 * into lightmaps (also of each lamp, and of daylight), directional maps, light probes and glTF files.
 * lumel/lumel.h is the interface for C++; it also has light that stays current while things move.
 *
 * Units    As in lumel/lumel.h: metres; right-handed, +y up; radians; linear Rec. 709; irradiance in
 *          lx, luminance in cd/m², intensity of lamps in cd. Text is UTF-8.
 * Zeros    lumel_settings of zeros asks for the defaults. Elsewhere a comment says what 0 or NULL
 *          means, where it is not plain.
 * Memory   Arguments are copied during the call. What a result points to belongs to it.
 * Errors   Functions return LUMEL_OK or what failed, and lumel_message() has the sentence for the
 *          user. On failure, outputs are left unchanged.
 * Threads  No call may overlap another that uses the same device, scene or bake. Calls block until
 *          they are done and use all CPU cores. Callbacks run on the thread of the call; they must
 *          neither throw nor jump out.
 */
/* clang-format on */
#ifndef LUMEL_LUMEL_C_H
#define LUMEL_LUMEL_C_H

#include <stdint.h>

#define LUMEL_C_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lumel_result {
    LUMEL_OK = 0,
    LUMEL_BAD_INPUT = 1,     /* invalid argument, file or scene */
    LUMEL_BAD_DEVICE = 2,    /* no usable device, or it failed; or too little memory */
    LUMEL_BAD_OUTPUT = 3,    /* a file cannot be written */
    LUMEL_STOPPED = 4,       /* progress ended the bake before it had a solution */
    LUMEL_OUT_OF_MEMORY = 5, /* an allocation failed */
    LUMEL_FAILED = 6         /* a fault of the library */
} lumel_result;

/* Message of this thread's last failed call: location, fault and remedy; "" if none failed. Valid
 * until the thread's next call. */
LUMEL_C_API const char* lumel_message(void);

/* 10000 × major + 100 × minor + patch, of the library. */
LUMEL_C_API int lumel_version(void);

/* Sets the function that receives all messages for the user in this process; NULL: none. Once this
 * has returned, the former function is not called any more. The function must not call this. */
typedef void (*lumel_warning_function)(const char* message, void* user);
LUMEL_C_API void lumel_on_warning(lumel_warning_function function, void* user);

/* ---------------------------------------------------------------------------------------- scene */

typedef struct lumel_texture {
    int width, height;
    const uint8_t* rgba; /* [height][width][4], top row first; colours sRGB-coded, alpha linear */
} lumel_texture;

enum { LUMEL_OPAQUE = 0, LUMEL_MASK = 1, LUMEL_BLEND = 2 };

typedef struct lumel_material {
    const char* name;    /* or NULL */
    float base_color[4]; /* 0…1; RGB is the diffuse reflectance ρ, zeros: black */
    const lumel_texture* base_color_texture; /* multiplies base_color; or NULL */
    float emitted[3];                        /* luminance [cd/m²] */
    const lumel_texture* emitted_texture;    /* multiplies emitted; or NULL */
    int alpha;                               /* LUMEL_OPAQUE, …: meaning of base_color[3] */
    float alpha_cutoff;                      /* for LUMEL_MASK; 0: 0.5 */
    float transmission;                      /* 0…1, transmitted share */
    int double_sided;                        /* 0 or 1 */
} lumel_material;

/* Triangles, front faces counter-clockwise. */
typedef struct lumel_mesh {
    const char* name; /* or NULL */
    uint32_t vertex_count;
    const float* positions; /* [V][3] */
    const float* normals;   /* [V][3], or NULL for flat shading */
    const float* texcoords; /* [V][2] of textures, (0, 0) at the top left; or NULL */
    const float* lightmap;  /* [V][2] your own layout in 0…1, used unless it overlaps; or NULL */
    const float* colors;    /* [V][4] linear, 0…1, multiply base_color; or NULL */
    uint32_t triangle_count;
    const uint32_t* indices; /* [T][3] */
    uint32_t material_count;
    const lumel_material* materials;
    const uint32_t* triangle_materials; /* [T] index into materials, or NULL: all have the first */
} lumel_mesh;

/* A placed mesh. Each instance has its own texels; meshes, materials and textures may be shared. */
typedef struct lumel_instance {
    const char* name; /* or NULL */
    const lumel_mesh* mesh;
    float transform[16]; /* mesh to world, by columns: [12…14] is the place; zeros: the identity */
} lumel_instance;

enum { LUMEL_POINT = 0, LUMEL_SPOT = 1, LUMEL_DIRECTIONAL = 2 };

typedef struct lumel_light {
    const char* name; /* or NULL */
    int kind;         /* LUMEL_POINT, … */
    float color[3];   /* zeros: white */
    float intensity;  /* [cd]; directional: [lx] */
    float position[3];
    float direction[3];           /* of its light, any length; zeros: down. Ignored by points */
    float range;                  /* maximum distance of its light [m]; 0: unlimited */
    float inner_cone, outer_cone; /* half angles of a spot; an outer_cone of 0 is π/4 */
    float radius;                 /* of a spherical source [m]; 0: a point, sharp shadows */
    float angle;                  /* angular radius of a directional light; 0: sharp shadows */
} lumel_light;

/* Latitude-longitude image; row 0 is up, the middle is +x, +z is at three quarters of the width. */
typedef struct lumel_sky {
    int width, height;
    const float* luminance; /* [height][width][3] [cd/m²] */
} lumel_sky;

typedef struct lumel_content {
    uint32_t instance_count;
    const lumel_instance* instances;
    uint32_t light_count;
    const lumel_light* lights;
    const lumel_sky* sky; /* or NULL */
} lumel_content;

typedef struct lumel_scene lumel_scene;

/* Makes a scene from arrays. Messages number meshes, materials and textures as instances first
 * refer to them. Reflectances are capped at 0.95, with a warning. */
LUMEL_C_API lumel_result lumel_make_scene(const lumel_content* content, lumel_scene** scene);
/* Reads a glTF 2.0 file (.gltf or .glb). Its materials are diffuse: method "glossy" needs C++. */
LUMEL_C_API lumel_result lumel_load_scene(const char* path, lumel_scene** scene);
LUMEL_C_API void lumel_free_scene(lumel_scene* scene); /* NULL: nothing */

/* Sky and sun; the first of these that is given becomes the sky: the file, the luminance, the sky
 * of the CIE, the clear sky of the sun. The sun becomes a light. */
enum { LUMEL_NO_SUN = 0, LUMEL_SUN = 1, LUMEL_SUN_OF_SKY = 2 };

typedef struct lumel_daylight {
    const char* sky_file;       /* .exr or .hdr [cd/m²]; or NULL */
    const float* sky_luminance; /* [3] uniform sky [cd/m²]; or NULL */
    int cie_sky;                /* 1…16: standard sky of the CIE, 16 is overcast; 0: none */
    float cie_lux;              /* its illuminance of an open horizontal plane [lx]; 0: 10,000 */
    int has_sun;                /* LUMEL_SUN: of a clear day; LUMEL_SUN_OF_SKY: of cie_sky alone */
    double sun_azimuth;         /* clockwise from north (-z), seen from above */
    double sun_elevation;       /* above the horizon */
    float sky_scale;            /* factor for the sky; 0: 1 */
    double rotation;            /* of both about +y, counter-clockwise from above */
    float ground;               /* albedo below the horizon; 0: none; not for sky images */
} lumel_daylight;
LUMEL_C_API lumel_result lumel_add_daylight(lumel_scene* scene, const lumel_daylight* daylight);

/* ---------------------------------------------------------------------------------------- device
 */

typedef struct lumel_device lumel_device;

/* Opens a Vulkan device. Needed for directional maps and for methods other than "links". pick: its
 * number or part of its name, as the program's `lumel devices` lists them; NULL: the best. */
LUMEL_C_API lumel_result lumel_open_device(const char* pick, lumel_device** device);
LUMEL_C_API void lumel_close_device(lumel_device* device); /* NULL: nothing */

/* ------------------------------------------------------------------------------------------ bake
 */

enum {
    LUMEL_SIDES_AUTOMATIC = 0, /* both if light may reach both */
    LUMEL_SIDES_BOTH = 1,
    LUMEL_SIDES_BRIGHTER = 2,
    LUMEL_SIDES_FRONT = 3
};

enum { LUMEL_ALL_LIGHT = 0, LUMEL_DIRECT_LIGHT = 1, LUMEL_INDIRECT_LIGHT = 2 };

enum {
    LUMEL_NO_DIRECTIONS = 0,
    LUMEL_SH1 = 1, /* 4 coefficients */
    LUMEL_SH2 = 2  /* 9 coefficients */
};

typedef struct lumel_progress {
    const char* stage;
    double fraction; /* of the stage, 0…1 */
    uint64_t shots;
    double error;   /* estimated relative error; < 0: unknown */
    double seconds; /* since the stage began */
} lumel_progress;

/* Returns 1 to go on; 0 ends the bake with the best solution so far, or with LUMEL_STOPPED. */
typedef int (*lumel_progress_function)(const lumel_progress* progress, void* user);

/* Texel density of nodes, meshes or materials whose name matches the pattern (* ? []). */
typedef struct lumel_density {
    const char* pattern;
    float texels_per_metre;
} lumel_density;

/* Joins all lamps whose names fit the pattern (* ?). */
typedef struct lumel_lamp_group {
    const char* name;
    const char* pattern;
} lumel_lamp_group;

/* As lumel::BakeSettings and lumel::AtlasSettings. Without targets and limits those of `lumel bake`
 * hold. */
typedef struct lumel_settings {
    float texels_per_metre; /* 0: the highest density that fits size */
    int size;               /* fixed side [texels]; 0: derived from the density */
    int max_size;           /* 0: 4096 */
    int gutter;             /* between charts [texels]; 0: 2 */
    int pages;              /* maximum number of squares; 0: 1 */
    int sides;              /* LUMEL_SIDES_AUTOMATIC, … */
    int coarse_afar;        /* 0 or 1: fewer texels far from cameras and detail */
    uint32_t density_count;
    const lumel_density* densities;
    const char* method;         /* NULL: "links" */
    const char* const* options; /* its options: name, value, name, value, …, NULL; or NULL */
    int parts;                  /* LUMEL_ALL_LIGHT, … */
    int directional;            /* LUMEL_NO_DIRECTIONS, …; others require a device */
    int per_lamp;               /* 0 or 1: fills lamps of the result; only "links" */
    uint32_t group_count;       /* groups fill lamps without per_lamp, too */
    const lumel_lamp_group* groups;
    const char* weather_file; /* EPW, a year of hours at one place: fills daylight; or NULL */
    uint32_t seed;            /* 0: 1 */
    double error, dark_error, eye_error, visible_noise; /* targets; 0: none */
    double seconds;                                     /* limit; 0: none */
    uint64_t shots;                                     /* limit; 0: none */
    uint64_t max_memory;                                /* [bytes]; 0: all available */
    lumel_progress_function progress;                   /* or NULL */
    void* user;                                         /* for progress */
} lumel_settings;

/* RGB: irradiance [lx] or a coefficient [cd/m²]; A: 0 where no surface is. */
typedef struct lumel_map {
    int width, height;
    const float* rgba; /* [height][width][4], top row first */
} lumel_map;

/* Light of a lamp, or of a group. */
typedef struct lumel_lamp {
    const char* name; /* of the light, of the emissive instance, or of the group; or "sky" */
    const char* kind; /* "sky", "sun", "point", "spot", "surface" or "group" */
    uint32_t member_count;
    const char* const* members; /* names of a group's lamps, or the lamp's own */
    lumel_map map;
    double error;    /* estimated, relative to its own light */
    double color[3]; /* of its light, linear, the largest channel 1 */
} lumel_lamp;

/* Light of sky and sun in one hour, alone; of the sun only after a reflection. */
typedef struct lumel_daylight_map {
    const char* hour; /* "06-21T12": from 12 to 13 o'clock on 21 June, local standard time */
    lumel_map map;
} lumel_daylight_map;

/* An hour with light. */
typedef struct lumel_daylight_hour {
    const char* hour;     /* as in lumel_daylight_map */
    float sun[3];         /* unit direction to the sun in the middle of the hour */
    float lux;            /* illuminance by direct sun on a plane that faces it [lx] */
    double mean;          /* mean illuminance of all surfaces, without direct sun [lx] */
    double error;         /* estimated, relative to the light of the hour */
    const float* weights; /* [map_count], signed */
} lumel_daylight_hour;

/* Daylight over a year: the light of an hour is the sum of the maps with its weights, without
 * direct sun: shade that by `sun` and `lux`. See lumel::DaylightMaps. */
typedef struct lumel_daylight_maps {
    const char* place;          /* name in the weather file */
    double latitude, longitude; /* north and east [rad] */
    double error;               /* of the sums, due to their number of maps: RMS, relative */
    uint32_t map_count;         /* at most 48 */
    const lumel_daylight_map* maps;
    uint32_t hour_count;
    const lumel_daylight_hour* hours; /* in the order of the calendar */
} lumel_daylight_maps;

/* A square of the map: position in it (lightmap × width − (x, y)) / side. */
typedef struct lumel_page {
    int x, y, side; /* [texels] */
} lumel_page;

/* Triangles of one material of one instance in the lightmap. Vertices are split at chart borders.
 */
typedef struct lumel_surface {
    uint32_t instance;
    uint32_t primitive; /* index into the mesh's materials, or into the primitives of the file */
    int back;           /* 1: the back of the surface before, see lumel::Surface */
    uint32_t vertex_count;
    const uint32_t* source_vertex; /* [V] the vertex of the mesh, or of the file's primitive */
    const float* lightmap;         /* [V][2] coordinates in 0…1, (0, 0) at the top left */
    const uint16_t* page;          /* [V] index into pages, or NULL if there is one */
    uint32_t triangle_count;
    const uint32_t* indices; /* [T][3] into these vertices; without triangles of zero area */
    float texels_per_metre;
} lumel_surface;

/* A finished bake. */
typedef struct lumel_baked {
    lumel_map map;
    uint32_t directional_count; /* 0, 4 or 9 */
    const lumel_map* directional;
    uint32_t lamp_count;     /* at most 64 */
    const lumel_lamp* lamps; /* add up to map; a dimmed lamp is its map times a factor */
    const lumel_daylight_maps* daylight; /* NULL without weather_file or any daylight, or if
                                            progress ended the bake before */
    uint32_t surface_count;
    const lumel_surface* surfaces; /* by instance, then primitive, then side */
    uint32_t page_count;
    const lumel_page* pages;
    uint32_t note_count;
    const char* const* notes; /* messages for the user */
    float texels_per_metre;
    double error, eye_error, visible_noise; /* estimated; < 0: unknown */
    uint64_t shots;
    double seconds;
    int interrupted;      /* 1: ended by progress */
    const void* internal; /* the library's own */
} lumel_baked;

/* Bakes a scene. device: NULL for method "links" on the CPU. settings: NULL for the defaults. */
LUMEL_C_API lumel_result lumel_bake(const lumel_device* device, const lumel_scene* scene,
                                    const lumel_settings* settings, const lumel_baked** baked);
LUMEL_C_API void lumel_free_baked(const lumel_baked* baked); /* NULL: nothing */

/* Incoming light at a point: coefficients l² + l + m of real spherical harmonics [cd/m²]. */
typedef struct lumel_probe {
    float coefficients[9][3];
    double noise; /* standard error of the noisiest coefficient's luminance [cd/m²] */
    int inside;   /* 1: inside an object, no light */
} lumel_probe;

/* Light at places [count][3] [m], in a bake of all light; many in one call are faster. samples:
 * rays per probe, at most 2²⁰; 0: 4096. */
LUMEL_C_API lumel_result lumel_probes(const lumel_baked* baked, const float* places, uint32_t count,
                                      uint32_t samples, lumel_probe* probes);

enum {
    LUMEL_KTX2 = 0,   /* half floats in KTX2, and a PNG for loaders that do not read it */
    LUMEL_RGB9E5 = 1, /* shared exponents in KTX2, and the PNG */
    LUMEL_PNG = 2,    /* the PNG alone: 8 bits */
    LUMEL_NO_MAP = 3  /* the coordinates alone */
};

/* Writes a .glb of the scene with its lightmap; see lumel::write_scene. format: LUMEL_KTX2, … */
LUMEL_C_API lumel_result lumel_write_scene(const lumel_baked* baked, const char* path, int format);
/* Writes a .glb with the light in the scene's textures, which any viewer shows; see
 * lumel::write_baked_scene. size: maximum side of the texture [texels]; 0: 2048. */
LUMEL_C_API lumel_result lumel_write_baked_scene(const lumel_baked* baked, const char* path,
                                                 int size);

#ifdef __cplusplus
}
#endif

#endif
