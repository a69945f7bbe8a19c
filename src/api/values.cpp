#include "api/values.h"

#include <glm/gtc/type_ptr.hpp>

#include "api/translate.h"
#include "atlas/lumels/sides.h"
#include "base/core/error.h"

namespace lumel::v0 {
namespace {

constexpr int kLargestAtlas = 16384;  // [texels] largest image side of common devices
constexpr int kLargestGutter = 64;    // [texels]

void check_range(int value, int least, int most, const std::string& name)
{
    if (value < least || value > most)
        throw lumel::Error(lumel::ErrorKind::input, "AtlasSettings::" + name,
                           "is " + std::to_string(value) + ", but must lie between " +
                               std::to_string(least) + " and " + std::to_string(most));
}

lumel::Sides sides_of(Sides sides)
{
    switch (sides) {
    case Sides::both:
        return lumel::Sides::both;
    case Sides::brighter:
        return lumel::Sides::brighter;
    case Sides::front:
        return lumel::Sides::front;
    default:
        return lumel::Sides::automatic;
    }
}

Surface surface_of(const lumel::Scene& scene, const Atlas& atlas, const lumel::Surface& from)
{
    const lumel::Mesh& mesh = scene.meshes[std::size_t(scene.instances[from.instance].mesh)];
    Surface surface;
    surface.instance = from.instance;
    surface.primitive = std::uint32_t(mesh.primitives[from.primitive].source_primitive);
    surface.source_vertex = from.source_vertex;
    surface.indices = from.indices;
    for (const glm::vec2& place : from.texcoord)
        surface.lightmap.push_back({place.x / float(atlas.width), place.y / float(atlas.height)});
    if (atlas.pages.count > 1)
        surface.page = pages_of_vertices(atlas.pages, from);
    surface.texels_per_metre = from.texels_per_metre;
    return surface;
}

}  // namespace

glm::vec2 to_glm(const Vec2& v)
{
    return {v[0], v[1]};
}

glm::vec3 to_glm(const Vec3& v)
{
    return {v[0], v[1], v[2]};
}

glm::vec4 to_glm(const Vec4& v)
{
    return {v[0], v[1], v[2], v[3]};
}

glm::mat4 to_glm(const Mat4& m)
{
    return glm::make_mat4(m.data());
}

Mat4 place_in_file(const glm::mat4& place, const glm::dvec3& origin)
{
    glm::mat4 there = place;
    there[3] = glm::vec4(glm::dvec4(place[3]) + glm::dvec4(origin, 0.0));
    return from_glm(there);
}

glm::mat4 place_in_scene(const Mat4& place, const glm::mat4& given, const glm::dvec3& origin)
{
    if (origin == glm::dvec3(0.0))
        return to_glm(place);
    const Mat4 start = place_in_file(given, origin);
    if (place == start)
        return given;
    const auto centred = [&](const Mat4& far) {
        glm::dmat4 near(to_glm(far));
        near[3] -= glm::dvec4(origin, 0.0);
        return near;
    };
    return glm::mat4(centred(place) * glm::inverse(centred(start)) * glm::dmat4(given));
}

Mat4 from_glm(const glm::mat4& m)
{
    Mat4 result;
    std::copy_n(glm::value_ptr(m), result.size(), result.begin());
    return result;
}

glm::vec3 checked_factor(const Vec3& factor, const std::string& what)
{
    if (!is_finite(factor) || *std::min_element(factor.begin(), factor.end()) < 0.0f)
        throw lumel::Error(lumel::ErrorKind::input, what,
                           "the factor must be three numbers of 0 or more");
    return to_glm(factor);
}

AtlasOptions checked_options(const AtlasSettings& settings)
{
    const float density = settings.texels_per_metre;
    if (!std::isfinite(density) || density < 0.0f)
        throw lumel::Error(lumel::ErrorKind::input, "AtlasSettings::texels_per_metre",
                           "must be a number of 0 or more");
    check_range(settings.size, 0, kLargestAtlas, "size");
    check_range(settings.max_size, 1, kLargestAtlas, "max_size");
    check_range(settings.gutter, 0, kLargestGutter, "gutter");
    check_range(settings.pages, 1, kMaxPages, "pages");
    AtlasOptions options{.texels_per_metre = density,
                         .size = settings.size,
                         .max_size = settings.max_size,
                         .pages = settings.pages,
                         .gutter = settings.gutter,
                         .sides = sides_of(settings.sides),
                         .coarse_afar = settings.coarse_afar};
    for (const DensityRule& rule : settings.densities) {
        if (!std::isfinite(rule.texels_per_metre) || !(rule.texels_per_metre > 0.0f))
            throw lumel::Error(lumel::ErrorKind::input, "AtlasSettings::densities",
                               "must be numbers above 0, unlike that of '" + rule.pattern + "'");
        options.densities.push_back({rule.pattern, rule.texels_per_metre});
    }
    return options;
}

std::vector<Page> pages_of(const Atlas& atlas)
{
    std::vector<Page> pages;
    for (int page = 0; page < atlas.pages.count; ++page) {
        const glm::ivec2 corner = atlas.pages.corner(page);
        pages.push_back({.x = corner.x, .y = corner.y, .side = atlas.pages.side});
    }
    return pages;
}

Map cut_page(const Map& map, const Page& page)
{
    return translated([&] {
        if (page.side < 1 || page.x < 0 || page.y < 0 || page.x > map.width - page.side ||
            page.y > map.height - page.side)
            throw lumel::Error(lumel::ErrorKind::input, "page", "is not inside of the map");
        constexpr std::size_t kChannels = 4;
        Map part{.width = page.side, .height = page.side, .rgba = {}};
        for (int y = page.y; y < page.y + page.side; ++y) {
            const std::size_t first =
                (std::size_t(y) * std::size_t(map.width) + std::size_t(page.x)) * kChannels;
            const auto row = map.rgba.begin() + std::ptrdiff_t(first);
            part.rgba.insert(part.rgba.end(), row,
                             row + std::ptrdiff_t(std::size_t(page.side) * kChannels));
        }
        return part;
    });
}

Map map_of(Image&& image)
{
    return {.width = image.width, .height = image.height, .rgba = std::move(image.values)};
}

std::vector<Surface> surfaces_of(const lumel::Scene& scene, const Atlas& atlas)
{
    std::vector<Surface> surfaces;
    for (const lumel::Surface& from : atlas.surfaces) {
        surfaces.push_back(surface_of(scene, atlas, from));
        if (!has_own_back(atlas, from))
            continue;
        surfaces.push_back(surface_of(scene, atlas, back_of(atlas, from)));
        surfaces.back().back = true;
    }
    return surfaces;
}

}  // namespace lumel::v0
