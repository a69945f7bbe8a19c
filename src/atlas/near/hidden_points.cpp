#include "atlas/near/hidden_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "atlas/lumels/sides.h"
#include "atlas/near/hemisphere.h"
#include "atlas/near/hit_lumels.h"
#include "atlas/near/sequence.h"

namespace lumel {

namespace {

/// Minimum cosine of rays to the surface: openings below it are cracks.
constexpr float kMinCosine = 0.17f;
/// A surface closer than this above a lumel, relative to its size, lies on it.
constexpr float kContact = 0.01f;

/// Rays that hit backs nearby, relative to the number of points, from which on fronts are doubted.
constexpr double kManyBacks = 2.0;
/// Directions at most along which a point that is shut in sees fronts.
constexpr int kFewFronts = int(kDirections) / 4;
/// Maximum distance of backs nearby, relative to the lumel's size.
constexpr float kFar = 16.0f;
/// Of walks in closed geometry.
constexpr std::uint32_t kMostReflections = 16;
/// Solids in contact, one behind the other, that a ray passes.
constexpr int kMostContacts = 16;

}  // namespace

InnerSides::InnerSides(const Scene& scene, const Atlas& atlas)
    : atlas_(&atlas),
      first_surface_(first_surfaces(atlas, scene.instances.size()))
{
}

bool InnerSides::has(const Lumel& lumel) const
{
    return is_inner(lumel.chart, !is_back(lumel));
}

bool InnerSides::has(const RayHit& hit) const
{
    if (atlas_->inner.empty())
        return false;
    const Surface& surface = atlas_->surfaces[first_surface_[hit.instance] + hit.primitive];
    return is_inner(surface.chart[hit.triangle], hit.front);
}

bool InnerSides::is_inner(std::uint32_t chart, bool front) const
{
    return chart < atlas_->inner.size() && atlas_->inner[chart][front ? 0 : 1];
}

void HiddenPoints::operator()(std::span<const LumelPoint> points, std::span<bool> hidden)
{
    std::fill(hidden.begin(), hidden.end(), true);
    left_.resize(points.size());
    std::iota(left_.begin(), left_.end(), 0u);
    in_doubt_.clear();
    const std::size_t backs = find_open(points, hidden);
    is_near_back_ = is_near_back_ || double(backs) >= kManyBacks * double(points.size());
    if (is_near_back_)
        find_shut_in(points, hidden);
}

void HiddenPoints::look_for_backs(std::span<const LumelPoint> points)
{
    rays_.clear();
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        rays_.push_back(ray_from(points[k], direction_about(points[k].normal, sample(k))));
        rays_.back().far = nearby();
    }
    hits_.resize(rays_.size());
    look_.rays.closest(rays_, hits_);
    bool meets_back = std::ranges::any_of(
        hits_, [&](const RayHit& hit) { return !std::isinf(hit.distance) && is_back(hit); });
    for (std::size_t r = 0; r < rays_.size() && !meets_back; ++r)
        meets_back = !std::isinf(hits_[r].distance) && is_contact(rays_[r], hits_[r]);
    if (!meets_back)
        return;
    std::array<bool, kCornersOfPiece> hidden{};
    in_doubt_.resize(points.size());
    std::iota(in_doubt_.begin(), in_doubt_.end(), 0u);
    find_shut_in(points, std::span(hidden).first(points.size()));
    is_near_back_ = std::ranges::count(hidden, true) > 0;
}

std::size_t HiddenPoints::find_open(std::span<const LumelPoint> points, std::span<bool> hidden)
{
    std::size_t backs = 0;
    const std::uint32_t first = last_;
    for (std::uint32_t k = 0; k < kDirections && !left_.empty(); ++k) {
        const std::uint32_t direction = k == 0 ? first : k <= first ? k - 1 : k;
        if ((tried_ >> direction & 1u) == 0)
            continue;
        cast(points, direction);
        for (std::size_t r = 0; r < left_.size(); ++r) {
            const RayHit& hit = hits_[r];
            backs += hit.distance <= nearby() && is_back(hit) ? 1 : 0;
            if (!is_open(points[left_[r]].normal, rays_[r], hit))
                continue;
            hidden[left_[r]] = false;
            last_ = direction;
            successful_ |= 1u << direction;
            if (!std::isinf(hit.distance))
                in_doubt_.push_back(left_[r]);
        }
        std::erase_if(left_, [&](std::uint32_t p) { return !hidden[p]; });
    }
    return backs;
}

void HiddenPoints::find_shut_in(std::span<const LumelPoint> points, std::span<bool> hidden)
{
    left_.swap(in_doubt_);
    std::vector<Directions> fronts(points.size(), 0);
    std::vector<char> meets_back(points.size(), 0);
    // Whether the first front that a point meets is at a contact; else no further one is asked.
    std::vector<std::optional<bool>> meets_contacts(points.size());
    for (std::uint32_t direction = 0; direction < kDirections && !left_.empty(); ++direction) {
        cast(points, direction);
        for (std::size_t r = 0; r < left_.size(); ++r) {
            const std::uint32_t p = left_[r];
            RayHit& hit = hits_[r];
            if (std::isinf(hit.distance)) {
                fronts[p] = kAllDirections;
                continue;
            }
            if (!is_back(hit)) {
                if (!meets_contacts[p])
                    meets_contacts[p] = is_contact(rays_[r], hit);
                if (*meets_contacts[p])
                    pass_contacts(rays_[r], hit);
            }
            if (std::isinf(hit.distance))
                continue;
            if (is_open(points[p].normal, rays_[r], hit))
                fronts[p] |= 1u << direction;
            else if (is_back(hit) && !meets_back[p])
                meets_back[p] = !is_contact(rays_[r], hit);
        }
        std::erase_if(left_,
                      [&](std::uint32_t p) { return std::popcount(fronts[p]) > kFewFronts; });
    }
    for (const std::uint32_t p : left_)
        hidden[p] = meets_back[p] && all_end_at_backs(points[p], fronts[p]);
}

bool HiddenPoints::all_end_at_backs(const LumelPoint& point, Directions fronts) const
{
    for (std::uint32_t direction = 0; direction < kDirections; ++direction)
        if ((fronts >> direction & 1u) != 0 && !ends_at_back(point, direction))
            return false;
    return true;
}

void HiddenPoints::cast(std::span<const LumelPoint> points, std::uint32_t direction)
{
    const glm::vec2 st = sample(direction);
    rays_.clear();
    glm::vec3 normal(0.0f), along(0.0f);
    for (const std::uint32_t p : left_) {
        if (points[p].normal != normal) {
            normal = points[p].normal;
            along = direction_about(normal, st);
        }
        rays_.push_back(ray_from(points[p], along));
    }
    hits_.resize(rays_.size());
    look_.rays.closest(rays_, hits_);
}

bool HiddenPoints::is_contact(const RaySpan& ray, const RayHit& hit) const
{
    const bool back = is_back(hit);
    return look_.rays.any_at(ray.origin + hit.distance * ray.direction, hit.ray_offset,
                             ray.direction,
                             [&](const RayHit& other) { return is_back(other) != back; });
}

void HiddenPoints::pass_contacts(RaySpan ray, RayHit& hit) const
{
    for (int n = 0;
         n < kMostContacts && !std::isinf(hit.distance) && !is_back(hit) && is_contact(ray, hit);
         ++n) {
        ray.near = hit.distance + 2.0f * hit.ray_offset;
        if (!look_.rays.closest(ray, hit))
            hit.distance = std::numeric_limits<float>::infinity();
    }
}

glm::vec2 HiddenPoints::sample(std::uint32_t direction) const
{
    glm::vec2 st = sobol_pair(direction, hash_two(std::uint32_t(lumel_), 1));
    st.x *= 1.0f - kMinCosine * kMinCosine;  // the squared sine
    return st;
}

RaySpan HiddenPoints::ray_from(const LumelPoint& point, const glm::vec3& along) const
{
    return ray_out(point.position + look_.world[lumel_].ray_offset * point.normal, along,
                   kBlendSeed);
}

bool HiddenPoints::is_back(const RayHit& hit) const
{
    return is_double_sided(look_.scene, hit) ? inner_.has(hit) : !hit.front;
}

float HiddenPoints::nearby() const
{
    return kFar * look_.world[lumel_].size;
}

bool HiddenPoints::ends_at_back(const LumelPoint& point, std::uint32_t direction) const
{
    RaySpan ray = ray_from(point, direction_about(point.normal, sample(direction)));
    for (std::uint32_t n = 0; n <= kMostReflections; ++n) {
        RayHit hit;
        if (!look_.rays.closest(ray, hit))
            return false;
        if (is_back(hit))
            return true;
        const glm::vec3 normal = hit.front ? hit.normal : -hit.normal;
        const glm::vec3 from = ray.origin + hit.distance * ray.direction + hit.ray_offset * normal;
        const glm::vec2 st = sobol_pair(direction, hash_two(std::uint32_t(lumel_), 2 + n));
        ray = ray_out(from, direction_about(normal, st), kBlendSeed);
    }
    return false;
}

bool HiddenPoints::is_open(const glm::vec3& normal, const RaySpan& ray, const RayHit& hit) const
{
    if (std::isinf(hit.distance))
        return true;
    return !is_back(hit) &&
           hit.distance * glm::dot(ray.direction, normal) >= kContact * look_.world[lumel_].size;
}

}  // namespace lumel
