/* A host in C that makes a room of its own, bakes it on the processor, and writes pictures of the
 * lightmap, also with a dimmed lamp, the lit room as glTF, and the light in its middle.
 *
 *     bake_from_c [FOLDER]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <lumel/lumel_c.h>

/* Ends the program with the library's sentence if a call failed. */
static void check(lumel_result result)
{
    if (result == LUMEL_OK)
        return;
    fprintf(stderr, "error: %s\n", lumel_message());
    exit(1);
}

static int tell(const lumel_progress* now, void* user)
{
    (void)user;
    fprintf(stderr, "\r%-20s %3.0f %%", now->stage, 100.0 * now->fraction);
    return 1; /* go on */
}

static void warn(const char* message, void* user)
{
    (void)user;
    fprintf(stderr, "warning: %s\n", message);
}

/* The six sides of a cube of 2 m, seen from inside: four corners and two triangles each. */
enum { SIDES = 6, CORNERS = 4 * SIDES, TRIANGLES = 2 * SIDES };
static float positions[CORNERS][3];
static uint32_t indices[TRIANGLES][3];
static uint32_t material_of[TRIANGLES];

static void make_side(int side, int axis, float at)
{
    const int right = at < 0 ? (axis + 1) % 3 : (axis + 2) % 3, up = 3 - axis - right;
    for (int corner = 0; corner < 4; ++corner) {
        float* position = positions[4 * side + corner];
        position[axis] = at;
        position[right] = corner == 1 || corner == 2 ? 1.0f : -1.0f;
        position[up] = corner >= 2 ? 1.0f : -1.0f;
    }
    for (int k = 0; k < 3; ++k) {
        indices[2 * side][k] = (uint32_t)(4 * side + k);
        indices[2 * side + 1][k] = (uint32_t)(4 * side + (k == 0 ? 0 : k + 1));
    }
}

static lumel_scene* make_room(void)
{
    static const lumel_material materials[] = {
        {.name = "white", .base_color = {0.7f, 0.7f, 0.7f, 1}},
        {.name = "red", .base_color = {0.7f, 0.1f, 0.1f, 1}},
    };
    for (int axis = 0; axis < 3; ++axis) {
        make_side(2 * axis, axis, -1.0f);
        make_side(2 * axis + 1, axis, 1.0f);
    }
    material_of[0] = material_of[1] = 1; /* the wall at x = -1 */
    const lumel_mesh mesh = {.name = "room",
                             .vertex_count = CORNERS,
                             .positions = positions[0],
                             .triangle_count = TRIANGLES,
                             .indices = indices[0],
                             .material_count = 2,
                             .materials = materials,
                             .triangle_materials = material_of};
    const lumel_instance instance = {.name = "room", .mesh = &mesh};
    const lumel_light lamps[] = {
        {.name = "bulb", .intensity = 100.0f, .position = {0, 0.8f, 0}, .radius = 0.05f},
        {.name = "candle",
         .color = {1, 0.5f, 0.2f},
         .intensity = 20.0f,
         .position = {0.5f, -0.6f, 0.5f},
         .radius = 0.02f},
    };
    const lumel_content content = {
        .instance_count = 1, .instances = &instance, .light_count = 2, .lights = lamps};
    lumel_scene* scene;
    check(lumel_make_scene(&content, &scene));
    return scene;
}

/* Writes the map as a picture in which `white` lx are white. */
static void write_picture(const char* path, const lumel_map* map, float white)
{
    FILE* file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(1);
    }
    fprintf(file, "P6 %d %d 255\n", map->width, map->height);
    for (long i = 0; i < (long)map->width * map->height; ++i)
        for (int c = 0; c < 3; ++c) {
            const float light = fminf(map->rgba[4 * i + c] / white, 1.0f);
            fputc((int)(255.0f * powf(light, 1.0f / 2.2f) + 0.5f), file);
        }
    fclose(file);
}

/* Writes the light with one lamp dimmed to a quarter: light is linear in its lamps. */
static void write_dimmed(const char* path, const lumel_baked* baked, const lumel_lamp* lamp)
{
    const long values = 4L * baked->map.width * baked->map.height;
    float* rgba = malloc((size_t)values * sizeof *rgba);
    if (!rgba) {
        perror(path);
        exit(1);
    }
    for (long i = 0; i < values; ++i)
        rgba[i] = baked->map.rgba[i] - 0.75f * lamp->map.rgba[i];
    const lumel_map dimmed = {baked->map.width, baked->map.height, rgba};
    write_picture(path, &dimmed, 400.0f);
    free(rgba);
}

int main(int count, char** arguments)
{
    const char* folder = count > 1 ? arguments[1] : ".";
    lumel_on_warning(warn, NULL);
    lumel_scene* scene = make_room();
    const lumel_settings settings = {.size = 128, .per_lamp = 1, .progress = tell};
    const lumel_baked* baked;
    check(lumel_bake(NULL, scene, &settings, &baked));
    printf("\n%d x %d texels, %u surfaces, %.1f s, error %.1f %%\n", baked->map.width,
           baked->map.height, (unsigned)baked->surface_count, baked->seconds, 100.0 * baked->error);

    /* A renderer draws each surface with the map at its lightmap coordinates. */
    for (uint32_t s = 0; s < baked->surface_count; ++s)
        printf("surface %u: %u vertices, %u triangles of material %u\n", (unsigned)s,
               (unsigned)baked->surfaces[s].vertex_count,
               (unsigned)baked->surfaces[s].triangle_count, (unsigned)baked->surfaces[s].primitive);

    for (uint32_t k = 0; k < baked->lamp_count; ++k)
        printf("lamp %s: %s, error %.1f %%\n", baked->lamps[k].name, baked->lamps[k].kind,
               100.0 * baked->lamps[k].error);

    const float middle[3] = {0, 0, 0};
    lumel_probe probe;
    check(lumel_probes(baked, middle, 1, 0, &probe));
    const double y00 = 0.2821; /* harmonic 0: 1 / sqrt(4 pi) */
    printf("mean radiance in the middle: %.1f %.1f %.1f cd/m2\n", y00 * probe.coefficients[0][0],
           y00 * probe.coefficients[0][1], y00 * probe.coefficients[0][2]);

    char path[4096];
    snprintf(path, sizeof path, "%s/room.ppm", folder);
    write_picture(path, &baked->map, 400.0f);
    snprintf(path, sizeof path, "%s/dimmed.ppm", folder);
    write_dimmed(path, baked, &baked->lamps[0]);
    snprintf(path, sizeof path, "%s/room.glb", folder);
    check(lumel_write_scene(baked, path, LUMEL_KTX2));
    lumel_free_baked(baked);
    lumel_free_scene(scene);
    return 0;
}
