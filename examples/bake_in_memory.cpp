// A host that makes a room of its own, bakes it, and dims its lamp without baking again.
//
//     bake_in_memory

#include <algorithm>
#include <cstdio>
#include <string>

#include <lumel/lumel.h>

namespace {

/// A rectangle of unit sides about the origin, facing +z.
lumel::Mesh rectangle(std::uint32_t material)
{
    lumel::Primitive primitive;
    primitive.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    return {.name = "rectangle", .primitives = {primitive}};
}

/// Scaled to a size [m] and put at a place, with columns for x, y (up its face) and z (its front).
lumel::Instance placed(const std::string& name, std::uint32_t mesh, float size,
                       const lumel::Vec3& x, const lumel::Vec3& y, const lumel::Vec3& z,
                       const lumel::Vec3& at)
{
    return {.name = name,
            .mesh = mesh,
            .transform = {size * x[0], size * x[1], size * x[2], 0, size * y[0], size * y[1],
                          size * y[2], 0, z[0], z[1], z[2], 0, at[0], at[1], at[2], 1}};
}

/// A cube of 2 m, seen from inside, with a lamp below its ceiling.
lumel::Scene room()
{
    lumel::SceneContent content;
    content.materials = {
        {.name = "white", .base_color = {0.7f, 0.7f, 0.7f, 1}},
        {.name = "red", .base_color = {0.7f, 0.1f, 0.1f, 1}},
        {.name = "lamp", .base_color = {0, 0, 0, 1}, .emitted = {1000, 1000, 1000}},
    };
    content.meshes = {rectangle(0), rectangle(1), rectangle(2)};
    constexpr lumel::Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    constexpr lumel::Vec3 left{-1, 0, 0}, down{0, -1, 0}, back{0, 0, -1};
    content.instances = {
        placed("floor", 0, 2, x, back, y, {0, 0, 0}),
        placed("ceiling", 0, 2, x, z, down, {0, 2, 0}),
        placed("back", 0, 2, x, y, z, {0, 1, -1}),
        placed("front", 0, 2, left, y, back, {0, 1, 1}),
        placed("left", 1, 2, back, y, x, {-1, 1, 0}),
        placed("right", 0, 2, z, y, left, {1, 1, 0}),
        placed("lamp", 2, 0.5f, x, z, down, {0, 1.95f, 0}),
    };
    return lumel::Scene(content);
}

/// Largest irradiance of green light in a map [lx].
float brightest(const lumel::Map& map)
{
    float most = 0.0f;
    for (std::size_t i = 0; i < map.rgba.size(); i += 4)
        most = std::max(most, map.rgba[i + 1]);
    return most;
}

void bake()
{
    const lumel::Device device;
    lumel::BakeSettings settings;
    settings.atlas.size = 64;
    settings.method = "matrix";  // which keeps the light of sources apart
    const lumel::Baked baked =
        lumel::bake(device, room(), settings, [](const lumel::Progress& now) {
            std::fprintf(stderr, "\r%-20s %3.0f %%", now.stage.c_str(), 100.0 * now.fraction);
            return true;  // go on
        });
    std::fprintf(stderr, "\n");
    // A renderer now draws each of baked.surfaces with baked.map at its lightmap coordinates.
    std::printf("%d x %d texels, %zu surfaces, %.1f s: up to %.0f lx\n", baked.map.width,
                baked.map.height, baked.surfaces.size(), baked.seconds, brightest(baked.map));

    lumel::Relight relight(device, baked);
    relight.set_light("lamp", {0.5f, 0.5f, 0.5f});
    std::printf("with the lamp dimmed to a half: up to %.0f lx\n", brightest(relight.map()));
}

}  // namespace

int main()
try {
    bake();
    return 0;
} catch (const lumel::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
