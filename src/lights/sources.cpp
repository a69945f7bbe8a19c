// [Arv95] J. Arvo. Stratified Sampling of Spherical Triangles. SIGGRAPH 1995.
// [TCE05] J. Talbot, D. Cline, P. Egbert. Importance Resampling for Global Illumination. EGSR 2005.

#include "lights/sources.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atlas/near/near_field.h"
#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Uniform emitters of at most this many triangles, as a box has, use exact polygon form factors.
constexpr std::size_t kMaxPolygons = 12;
/// Larger emitters are split until each part has at most kMaxOfMesh triangles or a bounding box
/// with sides of at most kSmallMesh × the diagonal of the scene.
constexpr std::size_t kMaxOfMesh = 64;
constexpr float kSmallMesh = 0.02f;
/// Other emitters of at most kMaxOfMesh triangles use form factors closer than this × their radius:
/// few of the triangles then send most of the light.
constexpr float kNearMesh = 0.5f;
/// Candidate triangles, of which one is chosen by its light here. [TCE05]
constexpr std::uint32_t kCandidates = 4;
/// Triangles larger than this solid angle [sr], or longer than this × their distance, are sampled
/// by solid angle: area would place too few points on the near part. [Arv95]
constexpr float kWideTriangle = 0.25f, kLongTriangle = 2.0f;
/// Samples per axis for the mean emission of a textured triangle.
constexpr int kMeanSide = 6;
/// Parts of the sky brighter than this multiple of its mean become a source, if they have more than
/// this share of its light.
constexpr double kBright = 8.0, kBrightShare = 0.03;
/// Unit normals closer than this [rad] differ only by rounding.
constexpr float kSameNormal = 1e-4f;
/// Half angle [rad] or ratio of radius to distance below which a source is small.
constexpr float kSmallAngle = 0.02f;

/// Maps the unit square uniformly to the barycentrics of corners 1 and 2.
glm::vec2 on_triangle(const glm::vec2& at)
{
    const float root = std::sqrt(at.x);
    return {root * (1.0f - at.y), root * at.y};
}

/// Spherical triangle of unit corners: solid angle and uniform sampling. [Arv95]
class SphericalTriangle {
public:
    SphericalTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) : a_(a), b_(b)
    {
        const glm::dvec3 ab = glm::cross(a, b), bc = glm::cross(b, c), ca = glm::cross(c, a);
        const auto corner_angle = [](const glm::dvec3& in, const glm::dvec3& out) {
            return std::atan2(glm::length(glm::cross(in, out)), -glm::dot(in, out));
        };
        alpha_ = corner_angle(ca, ab);
        area_ =
            std::max(alpha_ + corner_angle(ab, bc) + corner_angle(bc, ca) - std::numbers::pi, 0.0);
        toward_c_ = glm::normalize(c - glm::dot(c, a) * a);
    }

    double area() const { return area_; }

    glm::vec3 direction(const glm::vec2& at) const
    {
        const double part = double(at.x) * area_ - alpha_;
        const double s = std::sin(part), t = std::cos(part);
        const double cos_alpha = std::cos(alpha_), sin_alpha = std::sin(alpha_);
        const double u = t - cos_alpha, v = s + sin_alpha * glm::dot(a_, b_);
        const double q = std::clamp(
            ((v * t - u * s) * cos_alpha - v) / ((v * s + u * t) * sin_alpha), -1.0, 1.0);
        const glm::dvec3 c = q * a_ + std::sqrt(1.0 - q * q) * toward_c_;
        const double along = glm::dot(c, b_), z = 1.0 - double(at.y) * (1.0 - along);
        const glm::dvec3 aside = c - along * b_;
        const double length = glm::length(aside);
        if (!(length > 0.0))
            return glm::vec3(b_);
        return glm::vec3(
            glm::normalize(z * b_ + std::sqrt(std::max(1.0 - z * z, 0.0)) / length * aside));
    }

private:
    glm::dvec3 a_, b_, toward_c_;
    double alpha_, area_;
};

float power_per_area(const MaterialSample& look)
{
    return kPi * look.opacity * float(luminance(look.emitted));
}

}  // namespace

LightSources::LightSources(const Scene& scene, const Surfaces& surfaces, float extent,
                           LightSelection selection)
    : scene_(&scene),
      surfaces_(&surfaces),
      extent_(extent),
      selection_(std::move(selection))
{
    find();
}

void LightSources::find()
{
    bright_ = {};
    bright_sampler_.reset();
    bright_power_ = 0.0;
    most_ = selection_.sky ? kInfinite : 0.0f;
    if (selection_.sky)
        cut_sky();
    place();
}

void LightSources::place()
{
    sources_.clear();
    triangles_.clear();
    if (selection_.surfaces)
        add_surfaces(*surfaces_);
    if (selection_.lamps)
        add_lights();
    if (bright_power_ > 0.0)
        sources_.push_back({.kind = Kind::sky, .power = bright_power_});
}

LightSources::SourceInfo LightSources::origin(std::size_t index) const
{
    const Source& source = sources_[index];
    if (source.kind == Kind::sky)
        return {.part = Part::sky};
    if (source.kind == Kind::lamp || source.kind == Kind::sun)
        return {.part = Part::light,
                .index = source.first,
                .centre = source.centre,
                .radius = source.radius,
                .box = source.box,
                .sun = source.kind == Kind::sun ? &scene_->lights[source.first] : nullptr};
    const std::size_t surface = triangles_[source.first].surface;
    return {.part = Part::material,
            .index = std::uint32_t(surfaces_->all()[surface].source->material),
            .instance = surfaces_->instance(surface),
            .centre = source.centre,
            .radius = source.radius,
            .box = source.box};
}

void LightSources::add_surfaces(const Surfaces& surfaces)
{
    for (std::size_t s = 0; s < surfaces.all().size(); ++s)
        add_surface(surfaces, s);
    // Running sums of power within each source.
    running_.resize(triangles_.size());
    for (Source& source : sources_) {
        double sum = 0.0;
        source.box = {glm::vec3(kInfinite), glm::vec3(-kInfinite)};
        for (std::uint32_t t = source.first; t < source.last; ++t) {
            running_[t] = sum += double(triangles_[t].power);
            for (const glm::vec3& corner : triangles_[t].corner) {
                source.box.low = glm::min(source.box.low, corner);
                source.box.high = glm::max(source.box.high, corner);
            }
        }
        for (std::uint32_t t = source.first; t < source.last; ++t)
            running_[t] /= sum;
        source.power = sum * (source.double_sided ? 2.0 : 1.0);
        source.centre = source.box.centre();
        source.radius = source.box.radius();
        find_normal(source);
    }
}

void LightSources::find_normal(Source& source) const
{
    const Triangle& first = triangles_[source.first];
    const bool is_flat = std::all_of(
        triangles_.begin() + source.first, triangles_.begin() + source.last,
        [&](const Triangle& triangle) {
            return glm::distance(triangle.normal, first.normal) < kSameNormal &&
                   std::abs(glm::dot(first.normal, triangle.corner[0] - first.corner[0])) <
                       kSameNormal * source.radius;
        });
    if (is_flat && !source.double_sided)
        source.normal = first.normal;
}

/// True if the selection has the surfaces of an instance.
bool LightSources::counts(std::uint32_t instance) const
{
    const std::vector<std::uint32_t>& chosen = selection_.instances;
    return chosen.empty() || std::find(chosen.begin(), chosen.end(), instance) != chosen.end();
}

/// Adds the emissive triangles of a surface, as one source or as several compact groups.
void LightSources::add_surface(const Surfaces& surfaces, std::size_t index)
{
    const PlacedSurface& surface = surfaces.all()[index];
    if (!surface.may_emit || !counts(surfaces.instance(index)))
        return;
    const std::size_t begin = triangles_.size();
    const Primitive& primitive = *surface.source;
    for (std::uint32_t t = 0; t < primitive.indices.size() / 3; ++t) {
        Triangle triangle{.surface = index, .index = t, .swapped = surface.mirrored};
        for (std::uint32_t k = 0; k < 3; ++k)
            triangle.corner[k] = glm::vec3(
                *surface.transform *
                glm::vec4(primitive.positions[primitive.indices[3 * std::size_t(t) + k]], 1.0f));
        if (triangle.swapped)
            std::swap(triangle.corner[1], triangle.corner[2]);
        const glm::vec3 across = glm::cross(triangle.corner[1] - triangle.corner[0],
                                            triangle.corner[2] - triangle.corner[0]);
        triangle.area = 0.5f * glm::length(across);
        const auto& [a, b, c] = triangle.corner;
        triangle.longest_edge = longest_edge(a, b, c);
        triangle.box = {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
        triangle.reach = triangle.longest_edge;
        for (const glm::vec3& corner : triangle.corner)
            triangle.reach = std::max(triangle.reach, largest_coordinate(corner));
        float mean = 0.0f;
        if (surface.uniform)
            mean = power_per_area(surface.look);
        else
            for (int k = 0; k < kMeanSide * kMeanSide; ++k) {
                const glm::vec2 at =
                    (glm::vec2(k % kMeanSide, k / kMeanSide) + 0.5f) / float(kMeanSide);
                mean += power_per_area(surfaces.look_at(surface, t, on_triangle(at))) /
                        float(kMeanSide * kMeanSide);
            }
        triangle.power = triangle.area * mean;
        if (!(triangle.power > 0.0f))
            continue;
        triangle.normal = across / (2.0f * triangle.area);
        triangles_.push_back(triangle);
    }

    // Splits large ones at the median along the longest side.
    struct Range {
        std::size_t first, last;
    };
    const float small = kSmallMesh * extent_;
    std::vector<Range> open{{begin, triangles_.size()}};
    while (!open.empty()) {
        const Range range = open.back();
        open.pop_back();
        if (range.first == range.last)
            continue;
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        for (std::size_t t = range.first; t < range.last; ++t) {
            low = glm::min(low, triangles_[t].corner[0]);
            high = glm::max(high, triangles_[t].corner[0]);
        }
        const glm::vec3 size = high - low;
        const std::size_t count = range.last - range.first;
        if (count > kMaxOfMesh && std::max({size.x, size.y, size.z}) > small) {
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const std::size_t middle = range.first + count / 2;
            const auto at = triangles_.begin();
            std::nth_element(at + std::ptrdiff_t(range.first), at + std::ptrdiff_t(middle),
                             at + std::ptrdiff_t(range.last),
                             [&](const Triangle& a, const Triangle& b) {
                                 return a.corner[0][axis] < b.corner[0][axis];
                             });
            open.push_back({middle, range.last});
            open.push_back({range.first, middle});
            continue;
        }
        sources_.push_back(
            {.kind = surface.uniform && count <= kMaxPolygons ? Kind::polygons : Kind::mesh,
             .first = std::uint32_t(range.first),
             .last = std::uint32_t(range.last),
             .double_sided = surface.double_sided,
             .uniform = surface.uniform,
             .emission = kPi * surface.look.opacity * surface.look.emitted});
    }
}

void LightSources::add_lights()
{
    for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) {
        const PunctualLight& light = scene_->lights[l];
        if (!shines(light))
            continue;
        const bool sun = light.kind == PunctualLight::Kind::directional;
        double brightest = luminance(light.color) * double(light.intensity);
        if (light.profile >= 0) {
            const std::vector<float>& candela =
                scene_->profiles[std::size_t(light.profile)].candela;
            brightest *= double(*std::max_element(candela.begin(), candela.end()));
        }
        const glm::vec3 centre(light.transform[3]);
        sources_.push_back({.kind = sun ? Kind::sun : Kind::lamp,
                            .small = sun ? light.angle < kSmallAngle : light.radius == 0.0f,
                            .first = l,
                            .power = brightest,
                            .centre = centre,
                            .radius = light.radius,
                            .box = Box{centre, centre}.grown(light.radius)});
    }
}

/// Separates the part of the sky far above the mean as a source.
void LightSources::cut_sky()
{
    const Sky& sky = scene_->sky;
    if (sky.empty())
        return;
    double mean = 0.0, above = 0.0, angle = 0.0;
    const auto each = [&](const auto& visit) {
        for (int row = 0; row < sky.height; ++row)
            for (int column = 0; column < sky.width; ++column)
                visit(std::size_t(row) * std::size_t(sky.width) + std::size_t(column),
                      double(sky_texel_angle(sky, row)));
    };
    each([&](std::size_t texel, double of_texel) {
        mean += of_texel * luminance(sky.radiance[texel]);
        angle += of_texel;
    });
    const double most = kBright * mean / angle;
    each([&](std::size_t texel, double of_texel) {
        above += of_texel * std::max(luminance(sky.radiance[texel]) - most, 0.0);
    });
    if (!(above > kBrightShare * mean))
        return;
    most_ = float(most);
    bright_ = sky;
    for (glm::vec3& radiance : bright_.radiance) {
        const double bright = luminance(radiance);
        radiance *= bright > most ? float(1.0 - most / bright) : 0.0f;
    }
    bright_sampler_.emplace(bright_);
    bright_power_ = above;
}

glm::vec3 LightSources::dim_sky(const glm::vec3& direction) const
{
    const glm::vec3 radiance = sky_radiance(scene_->sky, direction);
    const float bright = float(luminance(radiance));
    return bright > most_ ? radiance * (most_ / bright) : radiance;
}

/// Form factor of each triangle of a source; returns their sum.
float LightSources::form_factors(const Source& source, const RayOrigin& start,
                                 float* of_triangles) const
{
    float sum = 0.0f;
    for (std::uint32_t t = source.first; t < source.last; ++t) {
        const Triangle& triangle = triangles_[t];
        const float height = glm::dot(triangle.normal, start.position - triangle.corner[0]);
        float factor = 0.0f;
        if (source.double_sided || height > 0.0f)
            factor = signed_form_factor(start.position, start.normal, triangle.corner, 3);
        sum += of_triangles[t - source.first] =
            source.double_sided ? std::abs(factor) : std::max(factor, 0.0f);
    }
    return sum;
}

SourceSample LightSources::sample(std::size_t index, const RayOrigin& start,
                                  const glm::vec2& at) const
{
    SourceSample sample = sample_of(sources_[index], start, at);
    sample.source = std::uint32_t(index);
    return sample;
}

SourceSample LightSources::sample_of(const Source& source, const RayOrigin& start,
                                     const glm::vec2& at) const
{
    switch (source.kind) {
    case Kind::polygons:
        return by_form_factor(source, start, at);
    case Kind::mesh:
        return is_near(source, start) ? by_form_factor(source, start, at)
                                      : by_power(source, start, at);
    case Kind::lamp:
        return from_lamp(scene_->lights[source.first], start, at);
    case Kind::sun:
        return from_sun(scene_->lights[source.first], start, at);
    case Kind::sky:
        return from_sky(start, at);
    }
    return {};
}

bool LightSources::is_wide(const Triangle& triangle, const glm::vec3& from)
{
    const float distance2 = triangle.box.distance2(from);
    return triangle.area > kWideTriangle * distance2 ||
           triangle.longest_edge * triangle.longest_edge >
               kLongTriangle * kLongTriangle * distance2;
}

bool LightSources::is_near(const Source& source, const RayOrigin& start) const
{
    const float near = kNearMesh * source.radius;
    return source.last - source.first <= kMaxOfMesh &&
           source.box.distance2(start.position) < near * near;
}

SourceSample LightSources::from_triangle(const Source& source, const Triangle& triangle,
                                         float chance, const RayOrigin& start,
                                         const glm::vec2& at) const
{
    const glm::vec3 edge_u = triangle.corner[1] - triangle.corner[0];
    const glm::vec3 edge_v = triangle.corner[2] - triangle.corner[0];
    const float height = glm::dot(triangle.normal, triangle.corner[0] - start.position);
    SourceSample sample;
    float density = 0.0f;  // per solid angle
    glm::vec2 place;
    const auto towards = [&](int k) {
        return glm::normalize(glm::dvec3(triangle.corner[k]) - glm::dvec3(start.position));
    };
    std::optional<SphericalTriangle> sphere;
    if (is_wide(triangle, start.position))
        sphere.emplace(towards(0), towards(1), towards(2));
    if (sphere && sphere->area() > 0.0) {
        sample.direction = sphere->direction(at);
        density = 1.0f / float(sphere->area());
        const float along = glm::dot(triangle.normal, sample.direction);
        sample.distance = along != 0.0f ? height / along : 0.0f;
        const glm::vec3 p =
            start.position + sample.distance * sample.direction - triangle.corner[0];
        const float uu = glm::dot(edge_u, edge_u), uv = glm::dot(edge_u, edge_v),
                    vv = glm::dot(edge_v, edge_v), pu = glm::dot(p, edge_u),
                    pv = glm::dot(p, edge_v);
        const float determinant = uu * vv - uv * uv;
        place = {(vv * pu - uv * pv) / determinant, (uu * pv - uv * pu) / determinant};
    } else {
        place = on_triangle(at);
        const glm::vec3 offset =
            triangle.corner[0] + place.x * edge_u + place.y * edge_v - start.position;
        const float squared = glm::dot(offset, offset);
        sample.distance = std::sqrt(squared);
        sample.direction = offset / sample.distance;
        const float there = std::abs(glm::dot(triangle.normal, sample.direction));
        density = there > 0.0f ? squared / (there * triangle.area) : 0.0f;
    }
    sample.ray_offset = ray_offset_for(std::max(triangle.reach, sample.distance));
    if (!(sample.distance > 0.0f) || !(density > 0.0f) || (height > 0.0f && !source.double_sided))
        return {};
    glm::vec3 emission = source.emission;
    if (!source.uniform) {
        if (triangle.swapped)
            std::swap(place.x, place.y);
        const MaterialSample look = surfaces_->look_at(
            surfaces_->all()[triangle.surface], triangle.index, glm::clamp(place, 0.0f, 1.0f));
        emission = kPi * look.opacity * look.emitted;
    }
    sample.irradiance = emission * (start.cosine(sample.direction) / (kPi * density * chance));
    return sample;
}

/// Samples a triangle by its form factor.
SourceSample LightSources::by_form_factor(const Source& source, const RayOrigin& start,
                                          glm::vec2 at) const
{
    float factors[kMaxOfMesh];
    const float sum = form_factors(source, start, factors);
    if (!(sum > 0.0f))
        return {.open = glm::vec3(0.0f)};
    float mark = at.x * sum;
    const std::uint32_t count = source.last - source.first;
    std::uint32_t t = 0;
    while (t + 1 < count && mark >= factors[t])
        mark -= factors[t++];
    SourceSample sample;
    if (factors[t] > 0.0f) {
        at.x = std::clamp(mark / factors[t], 0.0f, 0x1.fffffep-1f);
        sample = from_triangle(source, triangles_[source.first + t], factors[t] / sum, start, at);
    }
    if (source.uniform && is_above_surface(source, start))
        sample.open = sum * source.emission;
    return sample;
}

/// True if all of the source that the interpolated normal faces is above the surface; form factors
/// use that normal alone.
bool LightSources::is_above_surface(const Source& source, const RayOrigin& start) const
{
    const glm::vec3 apart = start.geometric - start.normal;
    if (glm::dot(apart, apart) < kSameNormal * kSameNormal)
        return true;
    const auto above = [&](const glm::vec3& corner) {
        return glm::dot(start.geometric, corner - start.position) >= 0.0f;
    };
    return std::all_of(triangles_.begin() + source.first, triangles_.begin() + source.last,
                       [&](const Triangle& triangle) {
                           return std::all_of(std::begin(triangle.corner),
                                              std::end(triangle.corner), above);
                       });
}

/// Samples points on triangles by power, then one of them by its light here. [TCE05]
SourceSample LightSources::by_power(const Source& source, const RayOrigin& start,
                                    const glm::vec2& at) const
{
    const auto first = running_.begin() + source.first, last = running_.begin() + source.last;
    const auto bits = std::uint32_t(at.x * 0x1p16f) << 16 | std::uint32_t(at.y * 0x1p16f);
    SourceSample chosen;
    float sum = 0.0f, of_chosen = 0.0f;
    for (std::uint32_t k = 0; k < kCandidates; ++k) {
        const float mark = (at.x + float(k)) / float(kCandidates);
        const auto found = std::min(std::upper_bound(first, last, double(mark)), last - 1);
        const Triangle& triangle = triangles_[std::size_t(found - running_.begin())];
        const float chance =
            float(double(triangle.power) * (source.double_sided ? 2.0 : 1.0) / source.power);
        const std::uint32_t own = PathSamples::hash(bits, k);
        const glm::vec2 place(PathSamples::to_unit(own),
                              PathSamples::to_unit(PathSamples::hash(own, 1)));
        const SourceSample candidate = from_triangle(source, triangle, chance, start, place);
        const float weight = float(luminance(candidate.irradiance));
        sum += weight;
        if (weight > 0.0f && PathSamples::to_unit(PathSamples::hash(own, 2)) * sum < weight) {
            chosen = candidate;
            of_chosen = weight;
        }
    }
    if (of_chosen > 0.0f)
        chosen.irradiance *= sum / (of_chosen * float(kCandidates));
    return chosen;
}

/// A ball of radius R and intensity I(ω) has the radiance I / (π R²) and covers a cone of sin α = R
/// / d.
SourceSample LightSources::from_lamp(const PunctualLight& light, const RayOrigin& start,
                                     const glm::vec2& at) const
{
    const glm::vec3 offset = glm::vec3(light.transform[3]) - start.position;
    const float squared = glm::dot(offset, offset), distance = std::sqrt(squared);
    if (!(distance > light.radius))
        return {};
    const glm::vec3 axis = offset / distance;
    SourceSample sample{.direction = axis, .distance = distance};
    float spread = 1.0f;  // ratio of the cone's solid angle to π sin² α
    if (light.radius > 0.0f) {
        const float sine = light.radius / distance;
        const float cosine = std::sqrt(1.0f - sine * sine);
        spread = 2.0f / (1.0f + cosine);
        sample.direction = frame_about(axis) * in_cone(at, std::asin(sine));
        const float along = glm::dot(offset, sample.direction);
        const float inside = light.radius * light.radius - (squared - along * along);
        sample.distance = along - std::sqrt(std::max(inside, 0.0f));
    }
    sample.ray_offset = ray_offset_for(
        std::max(largest_coordinate(glm::vec3(light.transform[3])), sample.distance));
    const float window = range_window(light, sample.distance);
    const float cosine = start.cosine(sample.direction);
    if (window > 0.0f && cosine > 0.0f)
        sample.irradiance = intensity_towards(*scene_, light, -sample.direction) *
                            (window * spread * cosine / squared);
    return sample;
}

/// A disc of half angle α has the radiance lux / (π sin² α).
SourceSample LightSources::from_sun(const PunctualLight& light, const RayOrigin& start,
                                    const glm::vec2& at) const
{
    const glm::vec3 axis = glm::normalize(glm::vec3(light.transform[2]));
    SourceSample sample{.direction = axis, .distance = kInfinite};
    float spread = 1.0f;
    if (light.angle > 0.0f) {
        sample.direction = frame_about(axis) * in_cone(at, light.angle);
        spread = 2.0f / (1.0f + std::cos(light.angle));
    }
    sample.irradiance = light.color * (light.intensity * spread * start.cosine(sample.direction));
    return sample;
}

SourceSample LightSources::from_sky(const RayOrigin& start, const glm::vec2& at) const
{
    const SkySample sky = bright_sampler_->sample(at);
    SourceSample sample{.direction = sky.direction, .distance = kInfinite};
    if (sky.density > 0.0f)
        sample.irradiance = sky.radiance * (start.cosine(sky.direction) / sky.density);
    return sample;
}

}  // namespace lumel
